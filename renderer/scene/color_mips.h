// SPDX-License-Identifier: MIT
// Which images a picture reads as colours, and their smaller levels.
#pragma once

#include <array>

#include "renderer/image/mip_chain.h"
#include "renderer/scene/scene.h"

namespace candela {

// The uses whose texels are colours, which enter light transport as factors: their mean over an area is what the area
// looks like. Not so for normals, roughness or opacity. Some may be invalid.
std::array<const TextureRef*, 5> color_textures(const Material& material);

// By image: which smaller levels it should have, if any. A material whose alpha counts makes them alpha-weighted.
std::vector<std::optional<MipColors>> wanted_mips(const Scene& scene);

// Gives each image that materials read as a colour, through a sampler with mip levels, its smaller levels, unless it
// has them; several images at a time.
void make_color_mips(Scene& scene);

}  // namespace candela
