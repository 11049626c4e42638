// SPDX-License-Identifier: MIT
// Pictures that belong together: their names, and the views of a turntable.
#pragma once

#include <string>

#include "renderer/scene/camera.h"

namespace candela {

// "walk_0012.png" of "walk.png"
std::string numbered(const std::string& path, uint32_t number);

// Of picture `number` of a full turn of `count`: about +Y through the pivot, counter-clockwise seen from above. Picture
// 0 is the camera as it is, to the bit.
Camera turned_camera(const Camera& camera, const Vec3& pivot, uint32_t number, uint32_t count);

}  // namespace candela
