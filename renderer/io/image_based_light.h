// SPDX-License-Identifier: MIT
// EXT_lights_image_based: the environment that a file brings along, as six faces of a cube.
#pragma once

#include <array>

#include "renderer/io/asset_images.h"
#include "renderer/io/json_document.h"

namespace candela {

// The faces +X, −X, +Y, −Y, +Z, −Z as seen from inside the cube: +Y up in those at the sides, −Z up in +Y, +Z up in −Y.
// Square, all of one size.
using CubeFaces = std::array<ImageRgb32f, 6>;

// Radiance of the cube in the unit direction w of its own frame: bilinear within a face, clamped at its edges.
// The extension stores OpenGL's faces turned left for right, which makes them right-handed.
Vec3 radiance_of(const CubeFaces& faces, const Vec3& w);

// Linear radiance of a stored face: sRGB; where alpha is below 1, RGBD (the colour over alpha).
ImageRgb32f decode_face(const ImageRgba8& stored);

// The light of the active scene as an equirectangular picture, turned and scaled as the file says, into
// scene.environment. A face that cannot be had leaves the scene without, with a warning.
void load_image_based_light(LoadContext& context, const Json& document, AssetImages& images, Scene& scene);

}  // namespace candela
