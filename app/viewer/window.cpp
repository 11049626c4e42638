// SPDX-License-Identifier: MIT
#include "app/viewer/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <map>
#include <utility>

namespace candela {

namespace {

std::string last_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description != nullptr ? description : "unknown";
}

// Nobody pastes more than this into a viewer.
constexpr size_t longest_paste = 1 << 16;

Key key_of(int glfw_key) {
    static const std::map<int, Key> named = {{GLFW_KEY_SPACE, Key::space},
                                             {GLFW_KEY_COMMA, Key::comma},
                                             {GLFW_KEY_PERIOD, Key::period},
                                             {GLFW_KEY_LEFT_BRACKET, Key::left_bracket},
                                             {GLFW_KEY_RIGHT_BRACKET, Key::right_bracket},
                                             {GLFW_KEY_ESCAPE, Key::escape},
                                             {GLFW_KEY_ENTER, Key::enter},
                                             {GLFW_KEY_KP_ENTER, Key::enter},
                                             {GLFW_KEY_TAB, Key::tab},
                                             {GLFW_KEY_BACKSPACE, Key::backspace},
                                             {GLFW_KEY_DELETE, Key::delete_key},
                                             {GLFW_KEY_LEFT, Key::left},
                                             {GLFW_KEY_RIGHT, Key::right},
                                             {GLFW_KEY_UP, Key::up},
                                             {GLFW_KEY_DOWN, Key::down},
                                             {GLFW_KEY_HOME, Key::home},
                                             {GLFW_KEY_END, Key::end},
                                             {GLFW_KEY_F5, Key::f5},
                                             {GLFW_KEY_F12, Key::f12},
                                             {GLFW_KEY_LEFT_SHIFT, Key::shift},
                                             {GLFW_KEY_RIGHT_SHIFT, Key::shift}};
    if (const auto found = named.find(glfw_key); found != named.end()) return found->second;
    if (glfw_key >= GLFW_KEY_A && glfw_key <= GLFW_KEY_Z) return static_cast<Key>('A' + glfw_key - GLFW_KEY_A);
    if (glfw_key >= GLFW_KEY_0 && glfw_key <= GLFW_KEY_9) return static_cast<Key>('0' + glfw_key - GLFW_KEY_0);
    if (glfw_key >= GLFW_KEY_KP_0 && glfw_key <= GLFW_KEY_KP_9) return static_cast<Key>('0' + glfw_key - GLFW_KEY_KP_0);
    return Key::none;
}

Modifiers modifiers_of(int bits) {
    return {(bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0, (bits & GLFW_MOD_ALT) != 0};
}

}  // namespace

struct Window::Handle {
    GLFWwindow* window = nullptr;
    std::vector<InputEvent> events;

    ~Handle() {
        if (window != nullptr) glfwDestroyWindow(window);
        glfwTerminate();
    }
    static Handle& of(GLFWwindow* window) { return *static_cast<Handle*>(glfwGetWindowUserPointer(window)); }

    // Size, pixels and scale as they are now.
    void push_size() {
        WindowResized size;
        int width = 0, height = 0;
        glfwGetWindowSize(window, &width, &height);
        size.points = Vec2(width, height);
        glfwGetFramebufferSize(window, &width, &height);
        size.pixels = Vec2u(width, height);
        float unused = 1;
        glfwGetWindowContentScale(window, &size.content_scale, &unused);
        events.emplace_back(size);
    }

    void install_callbacks() {
        glfwSetWindowUserPointer(window, this);
        glfwSetCursorPosCallback(
            window, [](GLFWwindow* w, double x, double y) { of(w).events.emplace_back(MouseMoved{Vec2(x, y)}); });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int bits) {
            if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
            of(w).events.emplace_back(
                MousePressed{static_cast<MouseButton>(button), action == GLFW_PRESS, modifiers_of(bits)});
        });
        glfwSetScrollCallback(
            window, [](GLFWwindow* w, double x, double y) { of(w).events.emplace_back(Scrolled{Vec2(x, y)}); });
        glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int bits) {
            // The clipboard comes before the key that asks for it.
            if (key == GLFW_KEY_V && action == GLFW_PRESS && (bits & GLFW_MOD_CONTROL) != 0) {
                const char* text = glfwGetClipboardString(w);
                of(w).events.emplace_back(
                    TextPasted{std::string(text != nullptr ? text : "").substr(0, longest_paste)});
            }
            of(w).events.emplace_back(KeyPressed{key_of(key), action != GLFW_RELEASE, modifiers_of(bits)});
        });
        glfwSetCharCallback(
            window, [](GLFWwindow* w, unsigned code_point) { of(w).events.emplace_back(TextTyped{code_point}); });
        glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
            FilesDropped drop{{paths, paths + count}, {}};
            drop.modifiers.shift =
                glfwGetKey(w, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS || glfwGetKey(w, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
            of(w).events.emplace_back(std::move(drop));
        });
        glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).push_size(); });
        glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { of(w).push_size(); });
        glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).events.emplace_back(WindowExposed{}); });
        glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { of(w).events.emplace_back(CloseRequested{}); });
    }
};

Window::Window(Vec2u extent, const std::string& title, bool scaled) {
    if (glfwInit() != GLFW_TRUE)
        throw GlError("there is no display to open a window on (" + last_error() + "); candela render needs none");
    handle_ = std::make_unique<Handle>();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, scaled ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "candela");
    handle_->window =
        glfwCreateWindow(static_cast<int>(extent.x), static_cast<int>(extent.y), title.c_str(), nullptr, nullptr);
    if (handle_->window == nullptr) {
        throw GlError("the display offers no OpenGL 3.3 window (" + last_error() +
                      "); try LIBGL_ALWAYS_SOFTWARE=1, or candela render");
    }
    glfwSetWindowSizeLimits(handle_->window, 64, 64, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(handle_->window);
    glfwSwapInterval(1);
    gl_ = load_gl_functions([](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); });
    handle_->install_callbacks();
    handle_->push_size();
}

Window::~Window() = default;

Vec2u Window::framebuffer_extent() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(handle_->window, &width, &height);
    return {width, height};
}

std::vector<InputEvent> Window::wait_for_events(double timeout_s) {
    if (timeout_s > 0) {
        glfwWaitEventsTimeout(timeout_s);
    } else {
        glfwPollEvents();
    }
    return std::exchange(handle_->events, {});
}

void Window::swap_buffers() {
    glfwSwapBuffers(handle_->window);
}

void Window::set_clipboard(const std::string& text) {
    glfwSetClipboardString(handle_->window, text.c_str());
}

Vec2u Window::extent() const {
    int width = 0, height = 0;
    glfwGetWindowSize(handle_->window, &width, &height);
    return {width, height};
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(handle_->window, title.c_str());
}

}  // namespace candela
