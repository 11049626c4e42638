// SPDX-License-Identifier: MIT
// Panels drawn through OSMesa: clipping, HiDPI, blending, and a button that a scripted mouse presses.
#include "app/gl/ui_renderer.h"

#include <imgui.h>

#include "app/gl/display.h"
#include "app/gl/osmesa_context.h"

namespace candela {
namespace {

struct ImGuiScope {
    ImGuiScope(float width, float height, float scale) {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {width, height};
        io.DisplayFramebufferScale = {scale, scale};
        io.DeltaTime = 1.0f / 60;
    }
    ~ImGuiScope() { ImGui::DestroyContext(); }
};

// A red rectangle whose clip rectangle cuts off its right half.
void draw_clipped_rectangle() {
    ImGui::NewFrame();
    ImDrawList* list = ImGui::GetForegroundDrawList();
    list->PushClipRect({10, 10}, {20, 30});
    list->AddRectFilled({10, 10}, {30, 30}, IM_COL32(255, 0, 0, 255));
    list->PopClipRect();
    list->AddRectFilled({40, 10}, {50, 20}, IM_COL32(255, 255, 255, 128));
    ImGui::Render();
}

class UiRendererTest : public testing::TestWithParam<int> {};

TEST_P(UiRendererTest, ClipsAndBlendsAtEveryScale) {
    const int scale = GetParam();
    const OsmesaContext context({64u * scale, 48u * scale});
    const ImGuiScope scope(64, 48, static_cast<float>(scale));
    Display display(context);
    UiRenderer ui(context);
    display.draw({});
    const Rgba8 background = read_back(context)(0, 0);
    draw_clipped_rectangle();
    ui.draw(*ImGui::GetDrawData());
    const ImageRgba8 drawn = read_back(context);
    const auto at = [&](double x, double y) { return drawn(static_cast<int>(x * scale), static_cast<int>(y * scale)); };
    EXPECT_EQ(at(12, 12), Rgba8(255, 0, 0, 255));
    EXPECT_EQ(at(18, 28), Rgba8(255, 0, 0, 255));
    EXPECT_EQ(at(22, 12), background);
    EXPECT_EQ(at(12, 32), background);
    EXPECT_EQ(at(12, 8), background);
    EXPECT_NEAR(at(45, 15).r, (255 + background.r) / 2, 2);
    EXPECT_EQ(context.gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

INSTANTIATE_TEST_SUITE_P(Scales, UiRendererTest, testing::Values(1, 2));

TEST(UiRenderer, TextIsDrawnAndAButtonCanBePressed) {
    const OsmesaContext context({200, 100});
    const ImGuiScope scope(200, 100, 1);
    Display display(context);
    UiRenderer ui(context);
    bool pressed = false;
    ImVec2 button_middle;
    for (int step = 0; step < 5; ++step) {
        ImGuiIO& io = ImGui::GetIO();
        if (step >= 2) io.MousePos = button_middle;
        io.MouseDown[0] = step == 3;
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration);
        pressed |= ImGui::Button("press");
        button_middle = {(ImGui::GetItemRectMin().x + ImGui::GetItemRectMax().x) / 2,
                         (ImGui::GetItemRectMin().y + ImGui::GetItemRectMax().y) / 2};
        ImGui::End();
        ImGui::Render();
    }
    display.draw({});
    ui.draw(*ImGui::GetDrawData());
    EXPECT_TRUE(pressed);
    const ImageRgba8 drawn = read_back(context);
    const auto bright =
        std::count_if(drawn.pixels().begin(), drawn.pixels().end(), [](const Rgba8& p) { return p.r > 200; });
    EXPECT_GT(bright, 20) << "no glyphs";
}

}  // namespace
}  // namespace candela
