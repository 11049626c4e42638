// SPDX-License-Identifier: MIT
#include "renderer/scene/camera.h"

#include <initializer_list>

#include "renderer/sampling/warp.h"

namespace candela {

namespace {

// Half the picture's extent at distance 1 (perspective) or everywhere (orthographic).
Vec2 half_extent(const Camera& camera, float aspect) {
    const float half_height = camera.projection == Projection::perspective ? std::tan(0.5f * camera.yfov_radians)
                                                                           : camera.ortho_half_height_m;
    return {half_height * aspect, half_height};
}

// Uniform over the aperture of diameter 2: a disc, or the polygon of its blades, one of whose equal triangles is chosen
// by the first number.
Vec2 sample_aperture(uint32_t blades, const Vec2& u) {
    if (blades < 3) return sample_disc(u);
    const auto count = static_cast<float>(blades);
    const float blade = std::min(std::floor(u.x * count), count - 1.0f);
    const Vec2 at = sample_triangle({u.x * count - blade, u.y});
    const auto corner = [&](float k) {
        const float angle = 2.0f * pi * k / count;
        return Vec2(std::sin(angle), std::cos(angle));
    };
    return at.x * corner(blade) + at.y * corner(blade + 1.0f);
}

Ray panorama_ray(const Camera& camera, const Vec2& film_uv) {
    const float azimuth = 2.0f * pi * (film_uv.x - 0.5f), elevation = pi * (0.5f - film_uv.y);
    const Vec3 direction(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                         -std::cos(azimuth) * std::cos(elevation));
    Ray ray;
    ray.origin = camera.position();
    ray.direction = glm::normalize(Mat3(camera.world_from_camera) * direction);
    return ray;
}

}  // namespace

Ray generate_ray(const Camera& camera, float aspect, const Vec2& film_uv, const Vec2& lens_uv) noexcept {
    if (camera.projection == Projection::panorama) return panorama_ray(camera, film_uv);
    const Vec2 on_film = Vec2(2.0f * film_uv.x - 1.0f, 1.0f - 2.0f * film_uv.y) * half_extent(camera, aspect);
    const Mat3 rotation(camera.world_from_camera);
    Vec3 origin(0);
    Vec3 direction(0, 0, -1);
    if (camera.projection == Projection::perspective) {
        direction = Vec3(on_film, -1.0f);
    } else {
        origin = Vec3(on_film, 0.0f);
    }
    // All rays of a pixel meet in the plane in focus, whatever point of the lens they pass.
    if (camera.aperture_diameter_m > 0.0f) {
        const Vec3 in_focus = origin + camera.focus_distance_m * direction;
        const Vec2 on_lens = 0.5f * camera.aperture_diameter_m * sample_aperture(camera.aperture_blades, lens_uv);
        origin += Vec3(on_lens, 0.0f);
        direction = in_focus - origin;
    }
    Ray ray;
    ray.origin = Vec3(camera.world_from_camera[3]) + rotation * origin;
    ray.direction = glm::normalize(rotation * direction);
    return ray;
}

RayCone pixel_cone(const Camera& camera, uint32_t height, const Ray& ray) noexcept {
    const float rows = static_cast<float>(height);
    if (camera.projection == Projection::panorama) return {0.0f, pi / rows};
    if (camera.projection == Projection::orthographic) return {2.0f * camera.ortho_half_height_m / rows, 0.0f};
    // Away from the axis pixels are seen from further off, and along the radius at a slant.
    const float cosine = std::clamp(glm::dot(ray.direction, camera.forward()), 0.0f, 1.0f);
    return {0.0f, 2.0f * std::tan(0.5f * camera.yfov_radians) / rows * cosine * std::sqrt(cosine)};
}

Vec3 project(const Camera& camera, float aspect, const Vec3& world_point) noexcept {
    const Vec3 p = glm::transpose(Mat3(camera.world_from_camera)) * (world_point - camera.position());
    if (camera.projection == Projection::panorama) {
        const float distance = std::max(glm::length(p), 1e-30f);
        return {0.5f + 0.5f * inv_pi * std::atan2(p.x, -p.z),
                0.5f - inv_pi * std::asin(std::clamp(p.y / distance, -1.0f, 1.0f)), distance};
    }
    Vec2 on_film = Vec2(p) / half_extent(camera, aspect);
    if (camera.projection == Projection::perspective) on_film /= -p.z;
    return {0.5f + 0.5f * on_film.x, 0.5f - 0.5f * on_film.y, -p.z};
}

Mat4 look_at(const Vec3& eye, const Vec3& target, const Vec3& up) {
    Vec3 back = eye - target;
    back = glm::length(back) > 0.0f ? glm::normalize(back) : Vec3(0, 0, 1);
    Vec3 right = glm::cross(up, back);
    if (!(glm::length(right) > 1e-6f * glm::length(up))) {
        right = glm::cross(std::abs(back.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(0, 0, -1), back);
    }
    right = glm::normalize(right);
    return Mat4(Vec4(right, 0), Vec4(glm::cross(back, right), 0), Vec4(back, 0), Vec4(eye, 1));
}

Camera frame_bounds(const Bounds3& bounds, float aspect, float yfov_radians) {
    Camera camera;
    camera.yfov_radians = yfov_radians;
    const Vec3 center = bounds.center();
    constexpr float yaw = pi / 6, pitch = pi / 12;
    const Vec3 back(std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch));
    camera.world_from_camera = look_at(center + back, center, Vec3(0, 1, 0));

    // Step back until every corner is inside a picture that is a twentieth smaller.
    const Mat3 rotation(camera.world_from_camera);
    const Vec2 tangent = Vec2(aspect, 1.0f) * std::tan(0.5f * yfov_radians) / 1.05f;
    float distance = 1e-6f;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 side((corner & 1) != 0 ? 0.5f : -0.5f, (corner & 2) != 0 ? 0.5f : -0.5f,
                        (corner & 4) != 0 ? 0.5f : -0.5f);
        const Vec3 p = glm::transpose(rotation) * (side * bounds.extent());
        distance = std::max({distance, p.z + std::abs(p.x) / tangent.x, p.z + std::abs(p.y) / tangent.y});
    }
    if (!(distance > 1e-6f)) distance = 1.0f;
    camera.world_from_camera[3] = Vec4(center + distance * back, 1.0f);
    camera.focus_distance_m = distance;
    return camera;
}

}  // namespace candela
