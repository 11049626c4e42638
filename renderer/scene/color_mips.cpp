// SPDX-License-Identifier: MIT
#include "renderer/scene/color_mips.h"

#include <tbb/parallel_for.h>

#include "renderer/image/mip_chain.h"

namespace candela {

std::array<const TextureRef*, 5> color_textures(const Material& m) {
    return {&m.base_color, &m.emissive, &m.specular.color, &m.sheen.color, &m.diffuse_transmission.color};
}

void make_color_mips(Scene& scene) {
    // An image counts as opaque where no material lets its alpha decide.
    enum : uint8_t { unused, opaque, transparent };
    std::vector<uint8_t> use(scene.images.size(), unused);
    for (const Material& material : scene.materials) {
        for (const TextureRef* ref : color_textures(material)) {
            if (!ref->valid()) continue;
            const Texture& texture = scene.textures[ref->texture.value];
            if (!texture.image.valid() || texture.mip_filter == MipFilter::none) continue;
            const bool is_opaque = material.alpha_mode == AlphaMode::opaque || ref != &material.base_color;
            uint8_t& known = use[texture.image.value];
            known = std::max<uint8_t>(known, is_opaque ? opaque : transparent);
        }
    }
    tbb::parallel_for(size_t{0}, use.size(), [&](size_t i) {
        SceneImage& image = scene.images[i];
        if (use[i] == unused || !image.pixels || image.smaller) return;
        const MipColors colors = use[i] == opaque ? MipColors::plain : MipColors::alpha_weighted;
        image.smaller = std::make_shared<const std::vector<ImageRgba8>>(make_mip_chain(*image.pixels, colors));
    });
}

}  // namespace candela
