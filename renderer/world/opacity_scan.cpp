// SPDX-License-Identifier: MIT
#include "renderer/world/opacity_scan.h"

#include "renderer/scene/animation.h"

namespace candela {

namespace {

ImageAlpha alpha_of(const ImageRgba8& image) {
    const bool transparent =
        std::any_of(image.pixels().begin(), image.pixels().end(), [](const Rgba8& p) { return p.a != 255; });
    return transparent ? ImageAlpha::transparent : ImageAlpha::opaque;
}

bool same_images(const Scene& a, const Scene& b) {
    return std::equal(a.images.begin(), a.images.end(), b.images.begin(), b.images.end(),
                      [](const SceneImage& x, const SceneImage& y) { return x.pixels == y.pixels; });
}

}  // namespace

OpacityScan::OpacityScan(World& world, const World* before)
    : world_(world), animated_(world.materials.size(), 0), transmission_animated_(world.materials.size(), 0) {
    const Scene& scene = *world.scene;
    if (before != nullptr && same_images(scene, *before->scene)) {
        world.image_alpha = before->image_alpha;
    } else {
        world.image_alpha.assign(scene.images.size(), ImageAlpha::unknown);
    }
    for (const std::shared_ptr<const Animation>& animation : scene.animations) {
        for (const AnimationChannel& channel : animation->channels) {
            if (channel.property->owner != AnimatedProperty::Owner::material) continue;
            animated_.at(channel.object) = 1;
            if (channel.property->pointer.find("transmissionFactor") != std::string_view::npos)
                transmission_animated_.at(channel.object) = 1;
        }
    }
}

bool OpacityScan::texture_may_have_alpha(TextureId id) {
    const ImageId image = world_.scene->textures[id.value].image;
    if (!image.valid()) return false;
    const SceneImage& source = world_.scene->images[image.value];
    if (source.alpha != ImageAlpha::unknown) return source.alpha == ImageAlpha::transparent;
    // Of a picture that is still to come nothing is known.
    if (!source.pixels) return true;
    ImageAlpha& known = world_.image_alpha[image.value];
    if (known == ImageAlpha::unknown) known = alpha_of(*source.pixels);
    return known == ImageAlpha::transparent;
}

bool OpacityScan::may_be_transparent(const Primitive& primitive) {
    if (lets_light_through(primitive.material, primitive)) return true;
    return std::any_of(primitive.variants.begin(), primitive.variants.end(),
                       [&](const VariantMaterial& each) { return lets_light_through(each.material, primitive); });
}

bool OpacityScan::lets_light_through(MaterialId id, const Primitive& primitive) {
    const size_t index = id.valid() ? id.value : world_.materials.size() - 1;
    const Material& material = world_.materials[index];
    // What is animated may come to be transparent, and the tree should not have to be built for that.
    if (material.is_thin_glass() || transmission_animated_[index] != 0) return true;
    if (animated_[index] != 0 && material.transmission.factor > 0.0f) return true;
    if (material.alpha_mode == AlphaMode::opaque) return false;
    if (animated_[index] != 0) return true;
    const float limit = material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 1.0f;
    if (material.base_color_factor.a < limit) return true;
    if (material.base_color.valid() && texture_may_have_alpha(material.base_color.texture)) return true;
    return std::any_of(primitive.colors.begin(), primitive.colors.end(),
                       [](const Vec4& color) { return color.a < 1.0f; });
}

}  // namespace candela
