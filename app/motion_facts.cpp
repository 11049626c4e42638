// SPDX-License-Identifier: MIT
#include "app/motion_facts.h"

#include <fmt/format.h>

#include <map>

#include "renderer/scene/animation.h"
#include "renderer/scene/deform.h"

namespace candela {

namespace {

using OrderedJson = nlohmann::ordered_json;

const char* word_for(Interpolation interpolation) {
    switch (interpolation) {
        case Interpolation::step:
            return "STEP";
        case Interpolation::linear:
            return "LINEAR";
        case Interpolation::cubic_spline:
            return "CUBICSPLINE";
    }
    return "";
}

OrderedJson describe(const Scene& scene, const Animation& animation) {
    OrderedJson channels = OrderedJson::array();
    for (const AnimationChannel& channel : animation.channels) {
        OrderedJson one = {{"drives", pointer_of(channel, scene)},
                           {"interpolation", word_for(channel.sampler.interpolation)},
                           {"keys", channel.sampler.times_s->size()}};
        if (channel.property->owner == AnimatedProperty::Owner::node) one["name"] = scene.nodes[channel.object].name;
        channels.push_back(std::move(one));
    }
    return {{"name", animation.name}, {"duration_s", animation.duration_s}, {"channels", std::move(channels)}};
}

size_t target_count(const Mesh& mesh) {
    size_t count = 0;
    for (const Primitive& primitive : mesh.primitives) {
        if (primitive.deformation) count = std::max(count, primitive.deformation->targets.size());
    }
    return count;
}

// How many different things of each kind the channels drive: "3 nodes (rotation, translation), 1 material".
std::string summary(const OrderedJson& channels) {
    std::map<std::string, std::pair<std::map<std::string, int>, std::map<std::string, int>>> kinds;
    for (const OrderedJson& channel : channels) {
        const auto pointer = channel["drives"].get<std::string>();
        const bool is_light = pointer.starts_with("/extensions/KHR_lights_punctual/lights/");
        const size_t kind_end = is_light ? pointer.find("/lights/") + 7 : pointer.find('/', 1);
        const size_t object_end = pointer.find('/', kind_end + 1);
        auto& [objects, properties] = kinds[is_light ? "lights" : pointer.substr(1, kind_end - 1)];
        ++objects[pointer.substr(0, object_end)];
        ++properties[pointer.substr(pointer.rfind('/') + 1)];
    }
    std::string out;
    for (const auto& [kind, driven] : kinds) {
        std::string names;
        for (const auto& [name, count] : driven.second)
            names += (names.empty() ? "" : ", ") + name;
        out += fmt::format("{}{} {} ({})", out.empty() ? "" : ", ", driven.first.size(), kind, names);
    }
    return out;
}

std::string title(const OrderedJson& named, const char* kind, size_t index) {
    const auto name = named["name"].get<std::string>();
    return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} \"{}\"", kind, name);
}

// A heading and a line for each, as many as the limit allows.
template <typename Line>
void print_list(const char* heading, const OrderedJson& list, size_t limit, const Line& line) {
    if (!list.empty()) fmt::print("{}\n", heading);
    for (size_t i = 0; i < list.size() && i < limit; ++i)
        fmt::print("  {}: {}\n", i, line(list[i], i));
    if (list.size() > limit) fmt::print("  and {} more; -v lists them\n", list.size() - limit);
}

}  // namespace

void describe_motion(const Scene& scene, OrderedJson& out) {
    out["animations"] = OrderedJson::array();
    for (const std::shared_ptr<const Animation>& animation : scene.animations)
        out["animations"].push_back(describe(scene, *animation));
    out["skins"] = OrderedJson::array();
    for (uint32_t s = 0; s < scene.skins.size(); ++s) {
        OrderedJson nodes = OrderedJson::array();
        for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
            if (scene.nodes[n].skin.value == s) nodes.push_back(n);
        }
        out["skins"].push_back(
            {{"name", scene.skins[s]->name}, {"joints", scene.skins[s]->joints.size()}, {"nodes", std::move(nodes)}});
    }
    out["morph_targets"] = OrderedJson::array();
    for (size_t m = 0; m < scene.meshes.size() - scene.posed_mesh_count; ++m) {
        const size_t count = target_count(*scene.meshes[m]);
        if (count == 0) continue;
        OrderedJson weights = OrderedJson::array();
        for (const Node& node : scene.nodes) {
            if (node.mesh.value == m) weights.push_back(node.morph_weights);
        }
        out["morph_targets"].push_back(
            {{"mesh", m}, {"name", scene.meshes[m]->name}, {"targets", count}, {"node_weights", std::move(weights)}});
    }
}

void print_motion(const OrderedJson& facts, size_t limit) {
    print_list("animations", facts["animations"], limit, [](const OrderedJson& animation, size_t i) {
        const OrderedJson& channels = animation["channels"];
        return fmt::format("{}, {:.4g} s, {} channels, drives {}", title(animation, "animation", i),
                           animation["duration_s"].get<double>(), channels.size(),
                           channels.empty() ? "nothing" : summary(channels));
    });
    print_list("skins", facts["skins"], limit, [](const OrderedJson& skin, size_t i) {
        return fmt::format("{}, {} joints, on {} nodes", title(skin, "skin", i), skin["joints"].get<size_t>(),
                           skin["nodes"].size());
    });
    print_list("morph targets", facts["morph_targets"], limit, [](const OrderedJson& morph, size_t) {
        return fmt::format("{}, {} targets", title(morph, "mesh", morph["mesh"].get<size_t>()),
                           morph["targets"].get<size_t>());
    });
}

}  // namespace candela
