// SPDX-License-Identifier: MIT
#include "renderer/scene/color_mips.h"

#include "renderer/math/parallel.h"

namespace candela {

std::array<const TextureRef*, 5> color_textures(const Material& m) {
    return {&m.base_color, &m.emissive, &m.specular.color, &m.sheen.color, &m.diffuse_transmission.color};
}

std::vector<std::optional<MipColors>> wanted_mips(const Scene& scene) {
    // An image counts as opaque where no material lets its alpha decide.
    std::vector<std::optional<MipColors>> out(scene.images.size());
    for (const Material& material : scene.materials) {
        for (const TextureRef* ref : color_textures(material)) {
            if (!ref->valid()) continue;
            const Texture& texture = scene.textures[ref->texture.value];
            if (!texture.image.valid() || texture.mip_filter == MipFilter::none) continue;
            const bool is_opaque = material.alpha_mode == AlphaMode::opaque || ref != &material.base_color;
            std::optional<MipColors>& known = out[texture.image.value];
            if (!is_opaque || !known) known = is_opaque ? MipColors::plain : MipColors::alpha_weighted;
        }
    }
    return out;
}

void make_color_mips(Scene& scene) {
    const std::vector<std::optional<MipColors>> wanted = wanted_mips(scene);
    parallel_for_each(wanted.size(), 1, [&](size_t i) {
        SceneImage& image = scene.images[i];
        if (!wanted[i] || !image.pixels || image.smaller) return;
        image.smaller = std::make_shared<const std::vector<ImageRgba8>>(make_mip_chain(*image.pixels, *wanted[i]));
    });
}

}  // namespace candela
