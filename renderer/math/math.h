// SPDX-License-Identifier: MIT
// Vector aliases, constants and small numeric helpers that every room uses.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace candela {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Vec2i = glm::ivec2;
using Vec2u = glm::uvec2;
using Vec3u = glm::uvec3;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;
using Quat = glm::quat;

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr float inv_pi = 0.31830988618379067154f;
inline constexpr float infinity = std::numeric_limits<float>::infinity();
// The largest float below 1: a uniform number u satisfies 0 <= u <= one_minus_epsilon.
inline constexpr float one_minus_epsilon = 0x1.fffffep-1f;

inline constexpr float sqr(float x) {
    return x * x;
}

inline float safe_sqrt(float x) {
    return std::sqrt(std::max(x, 0.0f));
}

inline float max_component(const Vec3& v) {
    return std::max(v.x, std::max(v.y, v.z));
}

// Luminance of linear Rec. 709 (sRGB primaries, D65); ITU-R BT.709-6 item 3.2.
inline float luminance(const Vec3& rgb) {
    return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

inline bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline bool is_black(const Vec3& v) {
    return v.x == 0.0f && v.y == 0.0f && v.z == 0.0f;
}

inline float lerp(float a, float b, float t) {
    return (1.0f - t) * a + t * b;
}

}  // namespace candela
