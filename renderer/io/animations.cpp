// SPDX-License-Identifier: MIT
#include "renderer/io/animations.h"

#include <set>
#include <unordered_map>

#include <nlohmann/json.hpp>

#include "renderer/scene/animated_materials.h"
#include "renderer/scene/animation.h"

namespace candela {
namespace {

using Owner = AnimatedProperty::Owner;

class AnimationLoader {
  public:
    AnimationLoader(LoadContext& context, const Json& document, AccessorReader& accessors, Scene& scene)
        : context_(context), document_(document), accessors_(accessors), scene_(scene) {}

    std::shared_ptr<const Animation> load(const Json& source, const std::string& where);

  private:
    using Times = std::shared_ptr<const std::vector<float>>;

    std::optional<PropertyMatch> find_target(const Json& target, const std::string& where);
    std::optional<PropertyMatch> resolve(const std::string& pointer, const std::string& where);
    size_t owner_count(Owner owner) const;
    uint32_t animated_uv(const PropertyMatch& match);
    std::optional<uint32_t> morph_target_count(const PropertyMatch& match) const;
    std::optional<AnimationSampler> load_sampler(const Json& source, const std::string& where, uint32_t width,
                                                 bool is_weights);
    Times times(uint32_t accessor, const std::string& where);
    std::vector<float> numbers(uint32_t accessor, uint32_t width, const std::string& where);

    LoadContext& context_;
    const Json& document_;
    AccessorReader& accessors_;
    Scene& scene_;
    std::unordered_map<uint32_t, Times> times_of_accessor_;
};

size_t AnimationLoader::owner_count(Owner owner) const {
    switch (owner) {
        case Owner::node:
            return scene_.nodes.size();
        case Owner::mesh:
            return scene_.meshes.size();
        case Owner::material:
        case Owner::texture_transform:
            return scene_.materials.size();
        case Owner::light:
            return scene_.lights.size();
        case Owner::camera:
            return scene_.file_cameras.size();
    }
    return 0;
}

std::optional<PropertyMatch> AnimationLoader::resolve(const std::string& pointer, const std::string& where) {
    const std::optional<PropertyMatch> match = find_animated_property(pointer);
    if (!match) {
        context_.warn(where,
                      "nothing that can be animated is at " + pointer.substr(0, 200) + "; the channel is left out");
        return std::nullopt;
    }
    if (match->object >= owner_count(match->property->owner)) {
        context_.fail(where, pointer.substr(0, 200) + " points to nothing: there are only " +
                                 std::to_string(owner_count(match->property->owner)));
    }
    return match;
}

std::optional<PropertyMatch> AnimationLoader::find_target(const Json& target, const std::string& where) {
    const std::string& path = target["path"].get_ref<const std::string&>();
    if (path == "pointer") {
        const auto extensions = target.find("extensions");
        const auto extension = extensions == target.end() ? target.end() : extensions->find("KHR_animation_pointer");
        if (extensions == target.end() || extension == extensions->end()) {
            context_.warn(where, "has the path \"pointer\" but no KHR_animation_pointer; the channel is left out");
            return std::nullopt;
        }
        return resolve((*extension)["pointer"].get<std::string>(), where + "/extensions/KHR_animation_pointer/pointer");
    }
    if (path != "translation" && path != "rotation" && path != "scale" && path != "weights") {
        context_.warn(where + "/path", "\"" + path.substr(0, 40) + "\" is not a path of glTF; the channel is left out");
        return std::nullopt;
    }
    // Without a node the target is some extension's, and to be ignored (glTF 2.0, section 3.11).
    const auto node = target.find("node");
    if (node == target.end()) {
        context_.warn(where, "names no node; the channel is left out");
        return std::nullopt;
    }
    return resolve("/nodes/" + std::to_string(node->get<uint32_t>()) + "/" + path, where);
}

// Where the transform of that texture is kept in parts, which are the file's to begin with.
uint32_t AnimationLoader::animated_uv(const PropertyMatch& match) {
    for (uint32_t i = 0; i < scene_.animated_uvs.size(); ++i) {
        const AnimatedUv& known = scene_.animated_uvs[i];
        if (known.material.value == match.object && known.slot == match.texture_slot) return i;
    }
    AnimatedUv& added = scene_.animated_uvs.emplace_back();
    added.material = MaterialId{match.object};
    added.slot = match.texture_slot;
    const Json::json_pointer place(pointer_to("/materials", match.object) +
                                   std::string(animated_texture_slots()[match.texture_slot].pointer) +
                                   "/extensions/KHR_texture_transform");
    if (document_.contains(place)) {
        const Json& parts = document_[place];
        added.transform.rotation_radians = parts.value("rotation", 0.0);
        for (size_t i = 0; i < 2; ++i) {
            const auto c = static_cast<int>(i);
            if (parts.contains("offset")) added.transform.offset[c] = parts["offset"][i].get<double>();
            if (parts.contains("scale")) added.transform.scale[c] = parts["scale"][i].get<double>();
        }
    }
    return static_cast<uint32_t>(scene_.animated_uvs.size() - 1);
}

std::optional<uint32_t> AnimationLoader::morph_target_count(const PropertyMatch& match) const {
    size_t count = 0;
    if (match.property->owner == Owner::node) {
        count = scene_.nodes[match.object].morph_weights.size();
    } else {
        for (const Node& node : scene_.nodes) {
            if (node.mesh.value == match.object) count = node.morph_weights.size();
        }
    }
    if (count == 0) return std::nullopt;
    return static_cast<uint32_t>(count);
}

// Null where the keys are in no order.
AnimationLoader::Times AnimationLoader::times(uint32_t accessor, const std::string& where) {
    const auto known = times_of_accessor_.find(accessor);
    if (known != times_of_accessor_.end()) return known->second;
    auto values = std::make_shared<std::vector<float>>(accessors_.read_scalars(accessor, where));
    Times out = values;
    const bool finite = std::all_of(values->begin(), values->end(), [](float t) { return std::isfinite(t); });
    if (!finite || !std::is_sorted(values->begin(), values->end())) {
        context_.warn(where, pointer_to("/accessors", accessor) +
                                 (finite ? " holds times that go back" : " holds times that are not finite") +
                                 "; the channels that use it are left out");
        out = nullptr;
    } else if (std::adjacent_find(values->begin(), values->end()) != values->end()) {
        context_.warn(where, pointer_to("/accessors", accessor) + " holds the same time twice; the last key counts");
    }
    times_of_accessor_[accessor] = out;
    return out;
}

template <typename Element>
std::vector<float> flatten(const std::vector<Element>& elements) {
    std::vector<float> out;
    out.reserve(elements.size() * static_cast<size_t>(Element::length()));
    for (const Element& element : elements) {
        for (int c = 0; c < Element::length(); ++c)
            out.push_back(element[c]);
    }
    return out;
}

std::vector<float> AnimationLoader::numbers(uint32_t accessor, uint32_t width, const std::string& where) {
    switch (width) {
        case 2:
            return flatten(accessors_.read_vec2(accessor, where));
        case 3:
            return flatten(accessors_.read_vec3(accessor, where));
        case 4:
            return flatten(accessors_.read_vec4(accessor, where));
        default:
            return accessors_.read_scalars(accessor, where);
    }
}

// width: numbers of one value.
std::optional<AnimationSampler> AnimationLoader::load_sampler(const Json& source, const std::string& where,
                                                              uint32_t width, bool is_weights) {
    AnimationSampler out;
    out.width = width;
    const std::string interpolation = source.value("interpolation", std::string("LINEAR"));
    if (interpolation == "STEP") {
        out.interpolation = Interpolation::step;
    } else if (interpolation == "CUBICSPLINE") {
        out.interpolation = Interpolation::cubic_spline;
    } else if (interpolation != "LINEAR") {
        context_.warn(where + "/interpolation", "\"" + interpolation.substr(0, 40) + "\" is unknown; LINEAR is used");
    }
    out.times_s = times(source["input"].get<uint32_t>(), where + "/input");
    const auto output = source["output"].get<uint32_t>();
    out.values = numbers(output, is_weights ? 1 : width, where + "/output");
    if (!out.times_s) return std::nullopt;
    const size_t values_per_key = out.interpolation == Interpolation::cubic_spline ? 3 : 1;
    const size_t needed = out.times_s->size() * values_per_key * width;
    if (out.values.size() != needed) {
        const std::string counts = "has " + std::to_string(out.values.size() / (is_weights ? 1 : width)) +
                                   " elements, but " + std::to_string(out.times_s->size()) + " keys need " +
                                   std::to_string(needed / (is_weights ? 1 : width));
        if (out.values.size() < needed) {
            context_.warn(where + "/output", counts + "; the channel is left out");
            return std::nullopt;
        }
        context_.warn(where + "/output", counts + "; the others are ignored");
        out.values.resize(needed);
    }
    if (!std::all_of(out.values.begin(), out.values.end(), [](float v) { return std::isfinite(v); })) {
        context_.warn(where + "/output", "holds values that are not finite; the channel is left out");
        return std::nullopt;
    }
    return out;
}

std::shared_ptr<const Animation> AnimationLoader::load(const Json& source, const std::string& where) {
    auto animation = std::make_shared<Animation>();
    animation->name = source.value("name", std::string());
    const Json& samplers = source["samplers"];
    const Json& channels = source["channels"];
    std::set<std::string> driven;
    for (size_t c = 0; c < channels.size(); ++c) {
        context_.check_cancel();
        const std::string place = pointer_to(where + "/channels", c);
        const auto sampler = static_cast<uint64_t>(channels[c]["sampler"].get<int64_t>());
        if (sampler >= samplers.size()) {
            context_.fail(place + "/sampler", "points to " + where + "/samplers/" + std::to_string(sampler) +
                                                  ", but there are only " + std::to_string(samplers.size()));
        }
        const std::optional<PropertyMatch> match = find_target(channels[c]["target"], place + "/target");
        if (!match) continue;
        AnimationChannel channel;
        channel.property = match->property;
        channel.object = match->object;
        const bool is_weights = match->property->width == 0;
        const std::optional<uint32_t> width =
            is_weights ? morph_target_count(*match) : std::optional(match->property->width);
        if (!width) {
            context_.warn(place + "/target", "drives the weights of a mesh without morph targets; it is left out");
            continue;
        }
        std::optional<AnimationSampler> keys =
            load_sampler(samplers[sampler], pointer_to(where + "/samplers", sampler), *width, is_weights);
        if (!keys) continue;
        keys->is_rotation = match->property->is_rotation;
        if (match->property->owner == Owner::texture_transform) channel.object = animated_uv(*match);
        channel.sampler = std::move(*keys);
        if (!driven.insert(pointer_of(channel, scene_)).second) {
            context_.warn(place + "/target", "is driven by another channel already; this one is left out");
            continue;
        }
        if (match->property->owner == Owner::node && match->property->width >= 3 &&
            scene_.nodes[match->object].is_matrix) {
            context_.warn(place + "/target", "drives a node whose transform is a matrix; its parts are used");
        }
        animation->duration_s = std::max(animation->duration_s, channel.sampler.times_s->back());
        animation->channels.push_back(std::move(channel));
    }
    return animation;
}

}  // namespace

void load_animations(LoadContext& context, const Json& document, AccessorReader& accessors, Scene& scene) {
    const auto animations = document.find("animations");
    if (animations == document.end()) return;
    AnimationLoader loader(context, document, accessors, scene);
    for (size_t a = 0; a < animations->size(); ++a)
        scene.animations.push_back(loader.load((*animations)[a], pointer_to("/animations", a)));
}

}  // namespace candela
