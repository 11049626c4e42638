// SPDX-License-Identifier: MIT
#include "app/frame_sequence.h"

#include <fmt/format.h>

#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

namespace candela {

std::string numbered(const std::string& path, uint32_t number) {
    const std::filesystem::path whole(path);
    return (whole.parent_path() / fmt::format("{}_{:04}{}", whole.stem().string(), number, whole.extension().string()))
        .string();
}

Camera turned_camera(const Camera& camera, const Vec3& pivot, uint32_t number, uint32_t count) {
    if (number % count == 0) return camera;
    const float radians = 2 * pi * static_cast<float>(number % count) / static_cast<float>(count);
    Camera out = camera;
    // Each from the first: nothing adds up over a turn.
    const Mat4 turn = glm::rotate(glm::translate(Mat4(1), pivot), radians, Vec3(0, 1, 0));
    out.world_from_camera = glm::translate(turn, -pivot) * camera.world_from_camera;
    return out;
}

}  // namespace candela
