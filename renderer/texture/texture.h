// SPDX-License-Identifier: MIT
// Filtered texture lookup with wrap modes, made once from the scene's images.
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
    TextureFilter filter = TextureFilter::linear;
};

// One view per texture of the scene; a texture without an image gets a null view that reads as white.
std::vector<TextureView> make_texture_views(const Scene& scene);

// Bilinear (or nearest) lookup; uv (0,0) is the top left corner of the image. Values are as stored, 0..1.
Vec4 lookup_linear(const TextureView& texture, const Vec2& uv) noexcept;
// The same with RGB decoded from sRGB before filtering; alpha stays linear.
Vec4 lookup_srgb(const TextureView& texture, const Vec2& uv) noexcept;
// Only the alpha channel.
float lookup_alpha(const TextureView& texture, const Vec2& uv) noexcept;

}  // namespace candela
