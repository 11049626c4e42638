// SPDX-License-Identifier: MIT
#include "app/viewer/remembered_settings.h"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/viewer/configuration_file.h"

namespace candela {

namespace {

using nlohmann::json;

constexpr size_t most_recent = 10;
constexpr size_t largest_file = 1 << 18;
constexpr float largest_exposure_ev = 20;
constexpr unsigned smallest_window = 64, largest_window = 16384;
constexpr ToneCurve curves[] = {ToneCurve::linear, ToneCurve::neutral, ToneCurve::aces, ToneCurve::agx};

const json* member(const json& object, const char* name) {
    const auto found = object.find(name);
    return found == object.end() ? nullptr : &*found;
}

float number(const json& value, const char* name, float low, float high) {
    const double found = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!(found >= static_cast<double>(low) && found <= static_cast<double>(high)))
        throw BrokenFile{fmt::format("{} is no number from {} to {}", name, low, high)};
    return static_cast<float>(found);
}

bool truth(const json& value, const char* name) {
    if (!value.is_boolean()) throw BrokenFile{fmt::format("{} is neither true nor false", name)};
    return value.get<bool>();
}

template <typename Value, typename Values>
Value one_of(const json& value, const char* name, const Values& values) {
    for (const Value each : values) {
        if (value.is_string() && value.get_ref<const std::string&>() == name_of(each)) return each;
    }
    throw BrokenFile{fmt::format("{} is none of its words", name)};
}

// Members that are not known are a newer version's.
RememberedSettings settings_from(const json& document) {
    if (!document.is_object()) throw BrokenFile{"it is no JSON object"};
    RememberedSettings out;
    if (const json* v = member(document, "exposure_ev"))
        out.tone.exposure_ev = number(*v, "exposure_ev", -largest_exposure_ev, largest_exposure_ev);
    if (const json* v = member(document, "tone_curve")) out.tone.curve = one_of<ToneCurve>(*v, "tone_curve", curves);
    if (const json* v = member(document, "theme"))
        out.style.theme = one_of<Theme>(*v, "theme", std::array{Theme::dark, Theme::light});
    if (const json* v = member(document, "ui_scale"))
        out.style.scale = number(*v, "ui_scale", smallest_ui_scale, largest_ui_scale);
    if (const json* v = member(document, "panels")) out.panels = truth(*v, "panels");
    if (const json* v = member(document, "statistics")) out.statistics = truth(*v, "statistics");
    if (const json* v = member(document, "window")) {
        if (!v->is_array() || v->size() != 2) throw BrokenFile{"window is no pair of numbers"};
        const auto side = [&](size_t i) {
            return static_cast<unsigned>(number((*v)[i], "window", smallest_window, largest_window));
        };
        out.window = Vec2u(side(0), side(1));
    }
    if (const json* v = member(document, "recent")) {
        if (!v->is_array()) throw BrokenFile{"recent is no list"};
        for (const json& each : *v) {
            if (!each.is_string()) throw BrokenFile{"recent lists what is no path"};
            if (out.recent.size() < most_recent) out.recent.push_back(each.get<std::string>());
        }
    }
    return out;
}

}  // namespace

std::filesystem::path settings_path() {
    return configuration_path("settings.json");
}

RememberedSettings read_settings(const std::filesystem::path& path, std::string& warning) {
    warning.clear();
    try {
        const std::optional<std::string> text = read_configuration(path, largest_file);
        if (!text) return {};
        const json document = json::parse(*text, nullptr, false);
        if (document.is_discarded()) throw BrokenFile{"it is no JSON"};
        return settings_from(document);
    } catch (const BrokenFile& broken) {
        warning = words_of(path, broken);
        return {};
    }
}

void write_settings(const std::filesystem::path& path, const RememberedSettings& settings) {
    json document = {{"exposure_ev", settings.tone.exposure_ev},
                     {"tone_curve", name_of(settings.tone.curve)},
                     {"theme", name_of(settings.style.theme)},
                     {"ui_scale", settings.style.scale},
                     {"panels", settings.panels},
                     {"statistics", settings.statistics}};
    if (settings.window) document["window"] = {settings.window->x, settings.window->y};
    document["recent"] = settings.recent;
    write_configuration(path, document.dump(2) + "\n", "the settings");
}

RememberedSettings with_changes(const RememberedSettings& stored, const RememberedSettings& at_start,
                                const RememberedSettings& now) {
    RememberedSettings out = stored;
    const auto take = [&](auto&& of) {
        if (of(now) != of(at_start)) of(out) = of(now);
    };
    take([](auto& s) -> auto& { return s.tone.exposure_ev; });
    take([](auto& s) -> auto& { return s.tone.curve; });
    take([](auto& s) -> auto& { return s.style.theme; });
    take([](auto& s) -> auto& { return s.style.scale; });
    take([](auto& s) -> auto& { return s.panels; });
    take([](auto& s) -> auto& { return s.statistics; });
    take([](auto& s) -> auto& { return s.window; });
    return out;
}

void add_recent(std::vector<std::string>& recent, const std::string& scene) {
    std::error_code error;
    const std::string path = std::filesystem::absolute(scene, error).lexically_normal().string();
    // The file is text: what no text names is not remembered.
    if (error || !is_utf8(path)) return;
    recent.erase(std::remove(recent.begin(), recent.end(), path), recent.end());
    recent.insert(recent.begin(), path);
    if (recent.size() > most_recent) recent.resize(most_recent);
}

std::vector<std::string> words_of(const RememberedSettings& settings) {
    const RememberedSettings usual;
    std::vector<std::string> out;
    const auto add = [&](const char* option, std::string value) {
        out.emplace_back(option);
        out.push_back(std::move(value));
    };
    if (settings.tone.exposure_ev != usual.tone.exposure_ev)
        add("--exposure", fmt::format("{}", settings.tone.exposure_ev));
    if (settings.tone.curve != usual.tone.curve) add("--tonemap", std::string(name_of(settings.tone.curve)));
    if (settings.style.theme != usual.style.theme) add("--theme", name_of(settings.style.theme));
    if (settings.style.scale != usual.style.scale) add("--ui-scale", fmt::format("{}", settings.style.scale));
    if (settings.panels || settings.statistics) {
        add("--open", settings.panels && settings.statistics ? "panels,statistics"
                      : settings.panels                      ? "panels"
                                                             : "statistics");
    }
    return out;
}

}  // namespace candela
