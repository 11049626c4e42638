// SPDX-License-Identifier: MIT
#include "app/viewer/ui.h"

#include <imgui.h>

#include <filesystem>

namespace candela {

namespace {

constexpr const char* font_paths[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                      "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf"};
constexpr float font_points = 15.0f;

// Warm accent on dark grey, everything on a grid of four points.
void apply_theme(float scale) {
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 6;
    style.FrameRounding = 4;
    style.GrabRounding = 4;
    style.PopupRounding = 4;
    style.WindowBorderSize = 0;
    style.WindowPadding = {12, 12};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 8};
    style.ScrollbarSize = 12;
    const ImVec4 accent(0.91f, 0.64f, 0.24f, 1.0f), panel(0.09f, 0.09f, 0.10f, 0.94f), field(0.22f, 0.22f, 0.24f, 1.0f),
        field_active(0.30f, 0.30f, 0.33f, 1.0f);
    ImVec4* colors = style.Colors;
    colors[ImGuiCol_WindowBg] = colors[ImGuiCol_PopupBg] = panel;
    colors[ImGuiCol_FrameBg] = colors[ImGuiCol_Button] = colors[ImGuiCol_Header] = field;
    colors[ImGuiCol_FrameBgHovered] = colors[ImGuiCol_ButtonHovered] = colors[ImGuiCol_HeaderHovered] = field_active;
    colors[ImGuiCol_FrameBgActive] = colors[ImGuiCol_ButtonActive] = colors[ImGuiCol_HeaderActive] = field_active;
    colors[ImGuiCol_SliderGrab] = colors[ImGuiCol_SliderGrabActive] = colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_PlotHistogram] = accent;
    colors[ImGuiCol_Text] = {0.93f, 0.93f, 0.92f, 1.0f};
    colors[ImGuiCol_TextDisabled] = {0.60f, 0.60f, 0.58f, 1.0f};
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

void map_keys(ImGuiIO& io) {
    const std::pair<ImGuiKey, Key> keys[] = {{ImGuiKey_Tab, Key::tab},
                                             {ImGuiKey_LeftArrow, Key::left},
                                             {ImGuiKey_RightArrow, Key::right},
                                             {ImGuiKey_UpArrow, Key::up},
                                             {ImGuiKey_DownArrow, Key::down},
                                             {ImGuiKey_Home, Key::home},
                                             {ImGuiKey_End, Key::end},
                                             {ImGuiKey_Delete, Key::delete_key},
                                             {ImGuiKey_Backspace, Key::backspace},
                                             {ImGuiKey_Enter, Key::enter},
                                             {ImGuiKey_Escape, Key::escape},
                                             {ImGuiKey_Space, Key::space},
                                             {ImGuiKey_A, Key::a},
                                             {ImGuiKey_C, Key::c},
                                             {ImGuiKey_V, Key::v},
                                             {ImGuiKey_X, Key::x}};
    for (const auto& [theirs, ours] : keys)
        io.KeyMap[theirs] = static_cast<int>(ours);
}

}  // namespace

Ui::Ui(const GlContext& context) : imgui_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(imgui_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    map_keys(io);
    size_.pixels = context.framebuffer_extent();
    size_.points = Vec2(size_.pixels);
    build_fonts();
    renderer_ = std::make_unique<UiRenderer>(context);
}

Ui::~Ui() {
    renderer_.reset();
    ImGui::DestroyContext(imgui_);
}

void Ui::build_fonts() {
    // Glyphs are drawn at the size they have in pixels, and scaled back to points.
    ImGuiIO& io = ImGui::GetIO();
    const float pixels_per_point = size_.points.x > 0 ? static_cast<float>(size_.pixels.x) / size_.points.x : 1.0f;
    io.Fonts->Clear();
    const ImWchar ranges[] = {0x20, 0xff, 0x2010, 0x2026, 0x2190, 0x21ff, 0x2212, 0x2212, 0x2248, 0x2248, 0};
    ImFont* font = nullptr;
    for (const char* path : font_paths) {
        // ImGui aborts on a missing file.
        std::error_code error;
        if (font != nullptr || !std::filesystem::is_regular_file(path, error)) continue;
        font = io.Fonts->AddFontFromFileTTF(path, std::round(font_points * size_.content_scale), nullptr, ranges);
        // The atlas keeps a pointer to the ranges until it is built.
        io.Fonts->Build();
    }
    if (font == nullptr) {
        ImFontConfig config;
        config.SizePixels = std::round(13 * size_.content_scale);
        io.Fonts->AddFontDefault(&config);
        io.Fonts->Build();
    }
    io.FontGlobalScale = 1 / pixels_per_point;
    apply_theme(size_.content_scale / pixels_per_point);
    built_scale_ = size_.content_scale;
}

void Ui::handle(const InputEvent& event) {
    ImGui::SetCurrentContext(imgui_);
    ImGuiIO& io = ImGui::GetIO();
    if (const auto* moved = std::get_if<MouseMoved>(&event)) {
        io.MousePos = {moved->point.x, moved->point.y};
    } else if (const auto* button = std::get_if<MousePressed>(&event)) {
        const auto index = static_cast<size_t>(button->button);
        mouse_down_[index] = button->pressed;
        mouse_pressed_since_frame_[index] |= button->pressed;
    } else if (const auto* scroll = std::get_if<Scrolled>(&event)) {
        io.MouseWheelH += scroll->steps.x;
        io.MouseWheel += scroll->steps.y;
    } else if (const auto* key = std::get_if<KeyPressed>(&event)) {
        io.KeysDown[static_cast<size_t>(key->key)] = key->pressed;
        io.KeyShift = key->modifiers.shift;
        io.KeyCtrl = key->modifiers.ctrl;
        io.KeyAlt = key->modifiers.alt;
    } else if (const auto* text = std::get_if<TextTyped>(&event)) {
        io.AddInputCharacter(text->code_point);
    } else if (const auto* size = std::get_if<WindowResized>(&event)) {
        size_ = *size;
    }
}

bool Ui::wants_mouse() const {
    ImGui::SetCurrentContext(imgui_);
    return ImGui::GetIO().WantCaptureMouse;
}

bool Ui::wants_keyboard() const {
    ImGui::SetCurrentContext(imgui_);
    return ImGui::GetIO().WantTextInput;
}

void Ui::begin_frame(double now_s) {
    ImGui::SetCurrentContext(imgui_);
    if (built_scale_ != size_.content_scale) {
        build_fonts();
        renderer_->upload_fonts();
    }
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {size_.points.x, size_.points.y};
    if (size_.points.x > 0 && size_.points.y > 0) {
        io.DisplayFramebufferScale = {static_cast<float>(size_.pixels.x) / size_.points.x,
                                      static_cast<float>(size_.pixels.y) / size_.points.y};
    }
    io.DeltaTime = std::clamp(static_cast<float>(now_s - last_frame_s_), 1e-4f, 0.5f);
    last_frame_s_ = now_s;
    // A click that began and ended since the last frame still counts.
    for (size_t i = 0; i < 3; ++i) {
        io.MouseDown[i] = mouse_down_[i] || mouse_pressed_since_frame_[i];
        mouse_pressed_since_frame_[i] = false;
    }
    ImGui::NewFrame();
}

void Ui::end_frame_and_draw() {
    ImGui::SetCurrentContext(imgui_);
    ImGui::Render();
    renderer_->draw(*ImGui::GetDrawData());
}

}  // namespace candela
