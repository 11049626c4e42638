// SPDX-License-Identifier: MIT
#include "app/viewer/recording.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/exit_status.h"

namespace candela {

namespace {

constexpr const char* first_line = "candela recording 1";
constexpr double longest_time_s = 1e7;
constexpr float farthest_point = 1e6f;
constexpr uint32_t largest_window = 16384;
constexpr unsigned key_limit = 512;

constexpr std::pair<Key, const char*> key_names[] = {{Key::none, "none"},         {Key::space, "space"},
                                                     {Key::comma, "comma"},       {Key::period, "period"},
                                                     {Key::left_bracket, "["},    {Key::right_bracket, "]"},
                                                     {Key::escape, "escape"},     {Key::enter, "enter"},
                                                     {Key::tab, "tab"},           {Key::backspace, "backspace"},
                                                     {Key::delete_key, "delete"}, {Key::left, "left"},
                                                     {Key::right, "right"},       {Key::up, "up"},
                                                     {Key::down, "down"},         {Key::home, "home"},
                                                     {Key::end, "end"},           {Key::f5, "f5"},
                                                     {Key::f12, "f12"},           {Key::shift, "shift"}};
constexpr const char* button_names[] = {"left", "right", "middle"};

bool is_letter_or_digit(unsigned code) {
    return (code >= 'A' && code <= 'Z') || (code >= '0' && code <= '9');
}

// A letter is itself, what has no name is its number behind a #.
std::string name_of(Key key) {
    for (const auto& [each, name] : key_names) {
        if (each == key) return name;
    }
    const auto code = static_cast<unsigned>(key);
    if (is_letter_or_digit(code)) return std::string(1, static_cast<char>(std::tolower(static_cast<int>(code))));
    return fmt::format("#{}", code);
}

std::string quoted(const std::string& word) {
    const bool plain = !word.empty() && word.find_first_of(" \t\r\n\"\\#") == std::string::npos;
    if (plain) return word;
    std::string out = "\"";
    for (const char c : word) {
        if (c == '\n') {
            out += "\\n";
        } else {
            if (c == '"' || c == '\\') out += '\\';
            out += c;
        }
    }
    return out + '"';
}

std::string words_of(const Modifiers& modifiers) {
    return fmt::format("{}{}{}", modifiers.shift ? " shift" : "", modifiers.ctrl ? " ctrl" : "",
                       modifiers.alt ? " alt" : "");
}

struct EventWriter {
    std::string operator()(const MouseMoved& e) const { return fmt::format("move {} {}", e.point.x, e.point.y); }
    std::string operator()(const MousePressed& e) const {
        return fmt::format("{} {}{}", e.pressed ? "press" : "release", button_names[static_cast<size_t>(e.button)],
                           words_of(e.modifiers));
    }
    std::string operator()(const Scrolled& e) const { return fmt::format("scroll {} {}", e.steps.x, e.steps.y); }
    std::string operator()(const KeyPressed& e) const {
        return fmt::format("{} {}{}", e.pressed ? "key" : "keyup", name_of(e.key), words_of(e.modifiers));
    }
    std::string operator()(const TextTyped& e) const { return fmt::format("text {}", e.code_point); }
    std::string operator()(const TextPasted& e) const { return "paste " + quoted(e.text); }
    std::string operator()(const FilesDropped& e) const {
        std::string out = e.modifiers.shift ? "drop-shift" : "drop";
        for (const std::string& path : e.paths)
            out += " " + quoted(path);
        return out;
    }
    std::string operator()(const WindowResized& e) const {
        return fmt::format("resize {} {} {} {} {}", e.points.x, e.points.y, e.pixels.x, e.pixels.y, e.content_scale);
    }
    std::string operator()(const WindowExposed&) const { return "expose"; }
    std::string operator()(const SceneFileChanged&) const { return "file-changed"; }
    std::string operator()(const CloseRequested&) const { return "close"; }
};

// The words of one line, taken one after the other; whatever is wrong names the line.
class Line {
  public:
    Line(const std::string& path, size_t number, const std::string& text) : path_(path), number_(number) {
        for (size_t i = 0; i < text.size();) {
            if (text[i] == ' ' || text[i] == '\t' || text[i] == '\r') {
                ++i;
                continue;
            }
            words_.emplace_back();
            std::string& word = words_.back();
            if (text[i] != '"') {
                while (i < text.size() && text[i] != ' ' && text[i] != '\t' && text[i] != '\r')
                    word += text[i++];
                continue;
            }
            for (++i; i < text.size() && text[i] != '"'; ++i) {
                const bool escaped = text[i] == '\\' && i + 1 < text.size();
                if (escaped) ++i;
                word += escaped && text[i] == 'n' ? '\n' : text[i];
            }
            if (i == text.size()) fail("a quotation mark is missing");
            ++i;
        }
    }

    [[noreturn]] void fail(const std::string& reason) const {
        throw CommandError(ExitStatus::unreadable_scene, fmt::format("{}:{}: {}", path_, number_, reason));
    }
    bool at_end() const { return next_ == words_.size(); }
    std::string word(const char* what) {
        if (at_end()) fail(fmt::format("{} is missing at the end of the line", what));
        return words_[next_++];
    }
    void expect(const char* wanted) {
        const std::string found = word(wanted);
        if (found != wanted) fail(fmt::format("'{}' stands where '{}' belongs", found, wanted));
    }
    template <typename Number>
    Number number(const char* what, Number low, Number high) {
        const std::string text = word(what);
        Number value{};
        const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
        if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || !(value >= low && value <= high))
            fail(fmt::format("'{}' is no {} from {} to {}", text, what, low, high));
        return value;
    }
    Vec2 point(const char* what) {
        const float x = number(what, -farthest_point, farthest_point);
        return {x, number(what, -farthest_point, farthest_point)};
    }
    Vec2u extent(const char* what) {
        const uint32_t width = number(what, 1u, largest_window);
        return {width, number(what, 1u, largest_window)};
    }
    Modifiers modifiers() {
        Modifiers out;
        while (!at_end()) {
            const std::string name = word("a modifier");
            bool& held = name == "shift" ? out.shift : name == "ctrl" ? out.ctrl : out.alt;
            if (name != "shift" && name != "ctrl" && name != "alt")
                fail(fmt::format("'{}' is none of shift, ctrl, alt", name));
            held = true;
        }
        return out;
    }
    Key key() {
        const std::string name = word("a key");
        for (const auto& [each, its_name] : key_names) {
            if (name == its_name) return each;
        }
        if (name.size() == 1) {
            const auto code = static_cast<unsigned>(std::toupper(static_cast<unsigned char>(name[0])));
            if (is_letter_or_digit(code)) return static_cast<Key>(code);
        }
        unsigned code = 0;
        const char* end = name.data() + name.size();
        if (name[0] == '#') {
            const auto parsed = std::from_chars(name.data() + 1, end, code);
            if (parsed.ec == std::errc() && parsed.ptr == end && code < key_limit) return static_cast<Key>(code);
        }
        fail(fmt::format("'{}' is no key", name));
    }
    MouseButton button() {
        const std::string name = word("a button");
        for (size_t i = 0; i < std::size(button_names); ++i) {
            if (name == button_names[i]) return static_cast<MouseButton>(i);
        }
        fail(fmt::format("'{}' is none of left, right, middle", name));
    }
    std::vector<std::string> rest() {
        std::vector<std::string> out(words_.begin() + static_cast<std::ptrdiff_t>(next_), words_.end());
        next_ = words_.size();
        return out;
    }

  private:
    const std::string& path_;
    size_t number_;
    std::vector<std::string> words_;
    size_t next_ = 0;
};

InputEvent parse_event(const std::string& kind, Line& line) {
    if (kind == "move") return MouseMoved{line.point("position")};
    if (kind == "press" || kind == "release") {
        const MouseButton button = line.button();
        return MousePressed{button, kind == "press", line.modifiers()};
    }
    if (kind == "scroll") return Scrolled{line.point("number of steps")};
    if (kind == "key" || kind == "keyup") {
        const Key key = line.key();
        return KeyPressed{key, kind == "key", line.modifiers()};
    }
    if (kind == "text") return TextTyped{line.number("code point", 0u, 0x10ffffu)};
    if (kind == "paste") return TextPasted{line.word("a text")};
    if (kind == "drop" || kind == "drop-shift") {
        FilesDropped drop{line.rest(), {}};
        drop.modifiers.shift = kind == "drop-shift";
        if (drop.paths.empty()) line.fail("no file is named");
        return drop;
    }
    if (kind == "resize") {
        WindowResized size;
        size.points = line.point("size");
        if (!(size.points.x > 0 && size.points.y > 0)) line.fail("a window has no such size");
        size.pixels = line.extent("number of pixels");
        size.content_scale = line.number("scale", 0.25f, 16.0f);
        return size;
    }
    if (kind == "expose") return WindowExposed{};
    if (kind == "file-changed") return SceneFileChanged{};
    if (kind == "close") return CloseRequested{};
    line.fail(fmt::format("'{}' is no event", kind));
}

RecordedFrame parse_frame(Line& line, size_t number, const std::vector<RecordedFrame>& before) {
    RecordedFrame out;
    out.line = number;
    const uint64_t first = before.empty() ? 0 : before.back().number + 1;
    out.number = line.number("frame number", first, std::numeric_limits<uint64_t>::max() - 1);
    line.expect("at");
    out.time_s = line.number("time", before.empty() ? 0.0 : before.back().time_s, longest_time_s);
    line.expect("samples");
    out.samples = line.number("number of samples", 0u, std::numeric_limits<uint32_t>::max());
    line.expect("loads");
    out.loads =
        line.number("number of loads", before.empty() ? 0u : before.back().loads, std::numeric_limits<uint32_t>::max());
    if (!line.at_end()) {
        line.expect("drawn");
        out.drawn = true;
    }
    return out;
}

}  // namespace

std::string header_text(const std::vector<std::string>& arguments, Vec2u window) {
    std::string out = std::string(first_line) + "\narguments";
    for (const std::string& word : arguments)
        out += " " + quoted(word);
    return out + fmt::format("\nwindow {} {}\n", window.x, window.y);
}

std::string frame_text(const RecordedFrame& frame) {
    std::string out = fmt::format("frame {} at {} samples {} loads {}{}\n", frame.number, frame.time_s, frame.samples,
                                  frame.loads, frame.drawn ? " drawn" : "");
    for (const InputEvent& event : frame.events)
        out += "  " + std::visit(EventWriter{}, event) + "\n";
    return out;
}

Recording parse_recording(std::istream& text, const std::string& path) {
    Recording out;
    out.path = path;
    size_t number = 1;
    std::string content;
    if (!std::getline(text, content) || Line(path, number, content).rest() != Line(path, number, first_line).rest())
        Line(path, number, "").fail(fmt::format("a recording begins with the line '{}'", first_line));
    while (std::getline(text, content)) {
        ++number;
        Line line(path, number, content);
        if (line.at_end()) continue;
        const std::string kind = line.word("");
        if (kind[0] == '#') continue;
        if (kind == "arguments") {
            if (out.arguments_line != 0) line.fail("there are arguments already");
            out.arguments = line.rest();
            out.arguments_line = number;
        } else if (kind == "window") {
            if (out.window.x != 0) line.fail("there is a window already");
            out.window = line.extent("number of pixels");
        } else if (kind == "frame") {
            if (out.window.x == 0 || out.arguments_line == 0)
                line.fail("a line of arguments and one of the window come before the first frame");
            out.frames.push_back(parse_frame(line, number, out.frames));
        } else if (out.frames.empty()) {
            line.fail(fmt::format("'{}' comes before the first frame", kind));
        } else {
            out.frames.back().events.push_back(parse_event(kind, line));
        }
        if (!line.at_end()) line.fail(fmt::format("'{}' is too much", line.word("")));
    }
    if (out.window.x == 0 || out.arguments_line == 0)
        Line(path, number, "").fail("the file ends without a line of arguments and one of the window");
    return out;
}

Recording read_recording(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::error_code error;
    if (!file || std::filesystem::is_directory(path, error))
        throw CommandError(ExitStatus::unreadable_scene, path + ": there is no such recording");
    return parse_recording(file, path);
}

}  // namespace candela
