// SPDX-License-Identifier: MIT
// Filtered texture lookup with wrap modes, made once from the scene's images.
//
// Colours under a footprint. A picture of few samples should not depend on which texel each of them happens to meet,
// and a picture of many must show the texture as it is, not a blurred copy. So every sample looks at the mean of the
// texels that it stands for (a level of the mip chain), and what it stands for shrinks: of n samples each stands for
// 1/n of the pixel, and since sample i does not know n, it takes (i+1)^(-3/2) of the pixel's area. The blur of a sample
// is of second order in its width, so the mean of n samples is off by O(1/n), while their noise falls no faster than
// about n^(-3/4) at texel edges: the error's share of blur vanishes in the limit, and once a sample stands for less
// than a texel it reads level 0 itself. Between two levels one is chosen at random with the weights of trilinear
// filtering. What enters the light transport other than as a factor (normals, roughness, opacity and the like) is not
// filtered: the mean of a function is not the function of the mean.
#pragma once

#include <span>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/scene/scene.h"

namespace candela {

// A view of an image owned by the Scene, ready for lookup.
struct TextureView {
    const Rgba8* pixels = nullptr;  // rows from the top
    int width = 0, height = 0;
    WrapMode wrap_u = WrapMode::repeat;
    WrapMode wrap_v = WrapMode::repeat;
    TextureFilter mag_filter = TextureFilter::linear;
    TextureFilter min_filter = TextureFilter::linear;
    MipFilter mip_filter = MipFilter::linear;
    // Levels 1, 2, … of the image; empty where it is only read at level 0.
    std::span<const ImageRgba8> smaller;
};

// The part of a texture that a lookup stands for.
struct TextureFootprint {
    float uv_area = 0;  // of the pixel, where uv runs from 0 to 1 over the image; 0: a point
    float share = 1;    // of that area for this sample
    float u_level = 0;  // uniform in [0, 1): chooses between levels
};

// One view per texture of the scene; a texture without an image gets a null view that reads as white.
std::vector<TextureView> make_texture_views(const Scene& scene);

// Bilinear (or nearest) lookup; uv (0,0) is the top left corner of the image. Values are as stored, 0..1.
Vec4 lookup_linear(const TextureView& texture, const Vec2& uv) noexcept;
// The same with RGB decoded from sRGB before filtering, over a footprint; alpha stays linear.
Vec4 lookup_srgb(const TextureView& texture, const Vec2& uv, const TextureFootprint& footprint = {}) noexcept;
// Only the alpha channel.
float lookup_alpha(const TextureView& texture, const Vec2& uv) noexcept;

}  // namespace candela
