// SPDX-License-Identifier: MIT
#include "app/viewer/view_text.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <sstream>

namespace candela {

namespace {

constexpr size_t longest_text = 4096;
constexpr size_t most_shown = 24;

std::string vector_text(const Vec3& v) {
    return fmt::format("{},{},{}", v.x, v.y, v.z);
}

// What is wrong with the text.
struct NoView {
    std::string why;
};

// The first words, so that one sees what was pasted.
std::string beginning(const std::string& text) {
    std::string out;
    for (const char c : text.substr(0, most_shown))
        out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    // A character is not cut in two.
    while (text.size() > most_shown && !out.empty() && (static_cast<unsigned char>(text[out.size()]) & 0xC0) == 0x80)
        out.pop_back();
    return text.size() > out.size() ? out + "…" : out;
}

// "1,2,3" or "1": so many numbers, and nothing else.
template <size_t N>
std::array<float, N> numbers(const std::string& option, const std::string& text) {
    std::array<float, N> out{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (size_t i = 0; i < N; ++i) {
        const auto parsed = std::from_chars(at, end, out[i]);
        at = parsed.ptr;
        const bool ends_well = i + 1 < N ? at != end && *at == ',' : at == end;
        if (parsed.ec != std::errc() || !std::isfinite(out[i]) || !ends_well)
            throw NoView{fmt::format("{} {}: that is not {}", option, beginning(text),
                                     N == 1 ? "a number" : "three numbers with commas between")};
        ++at;
    }
    return out;
}

class Options {
  public:
    explicit Options(const std::string& text) {
        constexpr const char* known[] = {"--eye",   "--target", "--up",         "--fov",      "--aperture",
                                         "--focus", "--blades", "--projection", "--exposure", "--tonemap"};
        std::istringstream words(text);
        for (std::string word; words >> word;) {
            const size_t equals = word.find('=');
            const std::string name = word.substr(0, equals);
            if (std::find(std::begin(known), std::end(known), name) == std::end(known))
                throw NoView{fmt::format("it has \"{}\", which is no option of a view", beginning(word))};
            std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
            if (equals == std::string::npos && !(words >> value)) throw NoView{name + " has no value"};
            if (!values_.emplace(name, value).second) throw NoView{name + " stands there twice"};
        }
    }

    const std::string* find(const std::string& name) const {
        const auto found = values_.find(name);
        return found == values_.end() ? nullptr : &found->second;
    }
    std::optional<Vec3> vector(const char* name) const {
        const std::string* text = find(name);
        if (text == nullptr) return std::nullopt;
        const auto v = numbers<3>(name, *text);
        return Vec3(v[0], v[1], v[2]);
    }
    std::optional<float> number(const char* name, float low, float high) const {
        const std::string* text = find(name);
        if (text == nullptr) return std::nullopt;
        const float value = numbers<1>(name, *text)[0];
        if (!(value >= low && value <= high))
            throw NoView{fmt::format("{} {} is not {} to {}", name, *text, low, high)};
        return value;
    }
    template <typename Value>
    std::optional<Value> word(const char* name, std::initializer_list<Value> values) const {
        const std::string* text = find(name);
        if (text == nullptr) return std::nullopt;
        for (const Value value : values) {
            if (*text == name_of(value)) return value;
        }
        throw NoView{fmt::format("{} {} is not known", name, beginning(*text))};
    }

  private:
    std::map<std::string, std::string> values_;
};

Bookmark bookmark_from(const Options& options, const Bookmark& base) {
    const std::optional<Vec3> eye = options.vector("--eye"), target = options.vector("--target");
    if (!eye || !target) throw NoView{"it has no --eye and --target"};
    if (*eye == *target) throw NoView{"--eye and --target are the same point"};
    Bookmark out = base;
    Camera& camera = out.view.camera;
    camera.world_from_camera = look_at(*eye, *target, options.vector("--up").value_or(Vec3(0, 1, 0)));
    out.view.pivot = *target;
    const float distance = pivot_distance(out.view);
    // A view without a word about its lens is a pinhole's, as on the command line.
    camera.projection =
        options.word("--projection", {Projection::perspective, Projection::orthographic, Projection::panorama})
            .value_or(Projection::perspective);
    camera.yfov_radians =
        glm::radians(options.number("--fov", 0.1f, 179.0f).value_or(glm::degrees(camera.yfov_radians)));
    camera.ortho_half_height_m = distance * std::tan(0.5f * camera.yfov_radians);
    camera.aperture_diameter_m = options.number("--aperture", 0.0f, 1e6f).value_or(0.0f);
    camera.focus_distance_m = options.number("--focus", 1e-6f, 1e12f).value_or(distance);
    camera.aperture_blades = static_cast<uint32_t>(options.number("--blades", 0.0f, 64.0f).value_or(0.0f));
    out.tone.exposure_ev = options.number("--exposure", -20.0f, 20.0f).value_or(base.tone.exposure_ev);
    out.tone.curve = options.word("--tonemap", {ToneCurve::linear, ToneCurve::neutral, ToneCurve::aces, ToneCurve::agx})
                         .value_or(base.tone.curve);
    for (int column = 0; column < 4; ++column) {
        if (!is_finite(Vec3(camera.world_from_camera[column]))) throw NoView{"it looks nowhere"};
    }
    return out;
}

}  // namespace

std::string text_of(const Bookmark& bookmark) {
    const Camera& camera = bookmark.view.camera;
    const float distance = pivot_distance(bookmark.view);
    const bool orthographic = camera.projection == Projection::orthographic;
    // An orthographic picture spans what the perspective one does at the target.
    const float fov_radians = orthographic ? 2 * std::atan(camera.ortho_half_height_m / distance) : camera.yfov_radians;
    std::string out = fmt::format("--eye {} --target {} --up {} --fov {}", vector_text(camera.position()),
                                  vector_text(camera.position() + distance * camera.forward()),
                                  vector_text(Vec3(camera.world_from_camera[1])), glm::degrees(fov_radians));
    if (camera.projection != Projection::perspective)
        out += fmt::format(" --projection {}", name_of(camera.projection));
    if (camera.aperture_diameter_m > 0)
        out += fmt::format(" --aperture {} --focus {}", camera.aperture_diameter_m, camera.focus_distance_m);
    if (camera.aperture_blades > 0) out += fmt::format(" --blades {}", camera.aperture_blades);
    return out + fmt::format(" --exposure {} --tonemap {}", bookmark.tone.exposure_ev, name_of(bookmark.tone.curve));
}

std::optional<Bookmark> view_from_text(const std::string& text, const Bookmark& base, std::string& problem) {
    problem.clear();
    try {
        if (text.find_first_not_of(" \t\r\n") == std::string::npos) throw NoView{"it is empty"};
        if (text.size() > longest_text) throw NoView{"it is far too long"};
        return bookmark_from(Options(text), base);
    } catch (const NoView& reason) {
        problem = "the clipboard holds no view: " + reason.why + "; Ctrl+C copies one";
        return std::nullopt;
    }
}

}  // namespace candela
