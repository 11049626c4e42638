// SPDX-License-Identifier: MIT
#include "app/viewer/ui.h"

#include <imgui.h>

#include <filesystem>

#include "app/viewer/palette.h"

namespace candela {

namespace {

constexpr const char* font_paths[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                      "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf"};
constexpr float font_points = 15.0f;

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

Ui::Ui(const GlContext& context, const UiStyle& style) : imgui_(ImGui::CreateContext()), style_(style) {
    ImGui::SetCurrentContext(imgui_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    map_keys(io);
    // What is pasted comes as an event, so that a recorded session has it.
    io.ClipboardUserData = this;
    io.GetClipboardTextFn = [](void* ui) { return static_cast<Ui*>(ui)->pasted_.c_str(); };
    io.SetClipboardTextFn = [](void* ui, const char* text) { static_cast<Ui*>(ui)->copied_ = text; };
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
    const float scale = size_.content_scale * style_.scale;
    const float pixels_per_point = size_.points.x > 0 ? static_cast<float>(size_.pixels.x) / size_.points.x : 1.0f;
    io.Fonts->Clear();
    const ImWchar ranges[] = {0x20, 0xff, 0x2010, 0x2026, 0x2190, 0x21ff, 0x2212, 0x2212, 0x2248, 0x2248, 0};
    ImFont* font = nullptr;
    for (const char* path : font_paths) {
        // ImGui aborts on a missing file.
        std::error_code error;
        if (font != nullptr || !std::filesystem::is_regular_file(path, error)) continue;
        font = io.Fonts->AddFontFromFileTTF(path, std::round(font_points * scale), nullptr, ranges);
        // The atlas keeps a pointer to the ranges until it is built.
        io.Fonts->Build();
    }
    if (font == nullptr) {
        ImFontConfig config;
        config.SizePixels = std::round(13 * scale);
        io.Fonts->AddFontDefault(&config);
        io.Fonts->Build();
    }
    io.FontGlobalScale = 1 / pixels_per_point;
    built_pixels_per_point_ = pixels_per_point;
    built_scale_ = scale;
    apply_theme(style_.theme, scale / pixels_per_point);
}

void Ui::set_style(const UiStyle& style) {
    if (style == style_) return;
    ImGui::SetCurrentContext(imgui_);
    style_ = style;
    // Of another scale the fonts are built with the next frame, and the sizes with them.
    apply_theme(style_.theme, built_scale_ / built_pixels_per_point_);
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
        const auto index = static_cast<size_t>(key->key);
        // Tab goes from field to field only where there is one: else it is the key of the panels.
        const bool pressed = key->pressed && (key->key != Key::tab || io.WantTextInput);
        key_down_[index] = pressed;
        key_pressed_since_frame_[index] |= pressed;
        io.KeyShift = key->modifiers.shift;
        io.KeyCtrl = key->modifiers.ctrl;
        io.KeyAlt = key->modifiers.alt;
    } else if (const auto* text = std::get_if<TextTyped>(&event)) {
        io.AddInputCharacter(text->code_point);
    } else if (const auto* paste = std::get_if<TextPasted>(&event)) {
        pasted_ = paste->text;
    } else if (const auto* size = std::get_if<WindowResized>(&event)) {
        size_ = *size;
    }
}

bool Ui::wants_mouse() const {
    ImGui::SetCurrentContext(imgui_);
    return ImGui::GetIO().WantCaptureMouse;
}

bool Ui::is_editing() const {
    ImGui::SetCurrentContext(imgui_);
    return ImGui::IsAnyItemActive() || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

bool Ui::wants_text() const {
    ImGui::SetCurrentContext(imgui_);
    return ImGui::GetIO().WantTextInput;
}

bool Ui::wants_keyboard() const {
    ImGui::SetCurrentContext(imgui_);
    return ImGui::GetIO().WantTextInput;
}

void Ui::begin_frame(double now_s) {
    ImGui::SetCurrentContext(imgui_);
    const float pixels_per_point = size_.points.x > 0 ? static_cast<float>(size_.pixels.x) / size_.points.x : 1.0f;
    if (built_scale_ != size_.content_scale * style_.scale || built_pixels_per_point_ != pixels_per_point) {
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
    io.ConfigFlags = navigates_ ? ImGuiConfigFlags_NavEnableKeyboard : 0;
    // A click that began and ended since the last frame still counts, and so does a key.
    for (size_t i = 0; i < 3; ++i) {
        io.MouseDown[i] = mouse_down_[i] || mouse_pressed_since_frame_[i];
        mouse_pressed_since_frame_[i] = false;
    }
    for (size_t i = 0; i < key_down_.size(); ++i)
        io.KeysDown[i] = key_down_[i] || std::exchange(key_pressed_since_frame_[i], false);
    ImGui::NewFrame();
}

void Ui::end_frame_and_draw() {
    ImGui::SetCurrentContext(imgui_);
    ImGui::Render();
    renderer_->draw(*ImGui::GetDrawData());
}

}  // namespace candela
