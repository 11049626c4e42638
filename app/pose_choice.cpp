// SPDX-License-Identifier: MIT
#include "app/pose_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "app/exit_status.h"
#include "renderer/scene/animation.h"
#include "renderer/scene/pose.h"

namespace candela {

std::string animation_title(const Scene& scene, uint32_t animation) {
    const std::string& name = scene.animations[animation]->name;
    return name.empty() ? fmt::format("animation {}", animation) : name;
}

std::optional<uint32_t> choose_animation(const RenderOptions& options, const Scene& rest) {
    if (options.animation.empty() && !options.at_seconds && !options.frames) return std::nullopt;
    const auto count = static_cast<uint32_t>(rest.animations.size());
    if (count == 0) {
        throw CommandError(ExitStatus::wrong_usage,
                           fmt::format("{}: has no animations; leave --animation, --at and --frames out", rest.source));
    }
    if (options.animation.empty()) return 0u;
    for (uint32_t i = 0; i < count; ++i) {
        if (rest.animations[i]->name == options.animation) return i;
    }
    uint32_t index = 0;
    const char* end = options.animation.data() + options.animation.size();
    const auto parsed = std::from_chars(options.animation.data(), end, index);
    if (parsed.ec == std::errc() && parsed.ptr == end && index < count) return index;
    std::vector<std::string> names;
    for (uint32_t i = 0; i < count; ++i)
        names.push_back(fmt::format("{} \"{}\"", i, rest.animations[i]->name));
    throw CommandError(ExitStatus::wrong_usage, fmt::format("--animation {}: is none of the scene's animations: {}",
                                                            options.animation, fmt::join(names, ", ")));
}

std::shared_ptr<const Scene> scene_at(const std::shared_ptr<const Scene>& rest, std::optional<uint32_t> animation,
                                      double time_s, std::vector<std::string>& warnings, const Scene* like) {
    if (!animation) return rest;
    std::vector<NodeId> left_out;
    auto posed = posed_scene(rest, *animation, static_cast<float>(time_s), &left_out, like);
    for (const NodeId node : left_out) {
        warnings.push_back(
            fmt::format("/nodes/{}: at {} s its transform or the shape of its mesh is not finite; it is not shown",
                        node.value, time_s));
    }
    return posed;
}

}  // namespace candela
