// SPDX-License-Identifier: MIT
#include "renderer/scene/without_pictures.h"

namespace candela {

Scene without_pictures(const Scene& scene) {
    Scene out = scene;
    for (Material& m : out.materials) {
        // White as a normal or a direction would tilt the surface.
        m.normal = m.clearcoat.normal = m.anisotropy.texture = TextureRef{};
        // Where a picture says what is metal, most is not; most of a picture of lamps is dark.
        if (m.metallic_roughness.valid()) m.metallic_factor = 0.0f;
        if (m.emissive.valid()) m.emissive_factor = Vec3(0);
        // Of specular and glossiness white would be a mirror.
        if (m.specular_glossiness_texture.valid()) {
            m.specular.color_factor = Vec3(0.04f);
            m.roughness_factor = 1.0f;
        }
        // Layers that a picture restricts are left out; what decides on bodies and on trees stays.
        if (m.clearcoat.texture.valid()) m.clearcoat.factor = 0.0f;
        if (m.sheen.color.valid()) m.sheen.color_factor = Vec3(0);
        if (m.iridescence.texture.valid()) m.iridescence.factor = 0.0f;
    }
    return out;
}

}  // namespace candela
