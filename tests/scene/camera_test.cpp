// SPDX-License-Identifier: MIT
#include "renderer/scene/camera.h"

#include <random>

namespace candela {
namespace {

constexpr float aspect = 1.5f;

Camera make_camera(Projection projection) {
    Camera camera;
    camera.world_from_camera = look_at({3, 2, 5}, {0.5f, 0, -1}, {0, 1, 0});
    camera.projection = projection;
    camera.ortho_half_height_m = 2;
    return camera;
}

TEST(Camera, ProjectUndoesGenerateRay) {
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        const Camera camera = make_camera(projection);
        for (const Vec2 uv : {Vec2(0.5f), Vec2(0.01f, 0.99f), Vec2(0.8f, 0.3f)}) {
            const Ray ray = generate_ray(camera, aspect, uv, {0.2f, 0.9f});
            EXPECT_NEAR(glm::length(ray.direction), 1, 1e-5f);
            for (const float t : {0.5f, 4.0f, 30.0f}) {
                const Vec3 seen = project(camera, aspect, ray.origin + t * ray.direction);
                EXPECT_NEAR(seen.x, uv.x, 1e-4f);
                EXPECT_NEAR(seen.y, uv.y, 1e-4f);
                EXPECT_NEAR(seen.z, t * glm::dot(ray.direction, camera.forward()), 1e-3f);
            }
        }
    }
}

TEST(Camera, TheFieldOfViewIsVertical) {
    Camera camera;
    camera.yfov_radians = 1.0f;
    const Vec3 top = generate_ray(camera, aspect, {0.5f, 0}, Vec2(0)).direction;
    EXPECT_NEAR(std::atan2(top.y, -top.z), 0.5f, 1e-5f);
    const Vec3 right = generate_ray(camera, aspect, {1, 0.5f}, Vec2(0)).direction;
    EXPECT_NEAR(right.x / -right.z, aspect * std::tan(0.5f), 1e-5f);
}

TEST(Camera, RaysThroughTheLensMeetInThePlaneOfFocus) {
    Camera camera = make_camera(Projection::perspective);
    camera.aperture_diameter_m = 0.3f;
    camera.focus_distance_m = 4;
    Camera pinhole = camera;
    pinhole.aperture_diameter_m = 0;
    std::mt19937 engine(1);
    const auto uniform = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    const Vec2 uv(0.3f, 0.6f);
    const Ray centre = generate_ray(pinhole, aspect, uv, Vec2(0.5f));
    const Vec3 focus = centre.origin + centre.direction * (4 / glm::dot(centre.direction, camera.forward()));
    float widest = 0;
    for (int i = 0; i < 500; ++i) {
        const float a = uniform();
        const Ray ray = generate_ray(camera, aspect, uv, {a, uniform()});
        const Vec3 offset = ray.origin - camera.position();
        widest = std::max(widest, glm::length(offset));
        EXPECT_NEAR(glm::dot(offset, camera.forward()), 0, 1e-5f);
        EXPECT_LT(glm::length(glm::cross(focus - ray.origin, ray.direction)), 1e-4f);
    }
    EXPECT_LE(widest, 0.15f + 1e-5f);
    EXPECT_GT(widest, 0.145f) << "the aperture is a diameter";
}

TEST(Camera, LookAtIsARotationEvenStraightDown) {
    for (const Vec3& target : {Vec3(1, 0, 0), Vec3(0, -5, 0), Vec3(0, 5, 0), Vec3(-1, 2, 3)}) {
        const Mat4 pose = look_at(Vec3(0), target, {0, 1, 0});
        const Mat3 rotation(pose);
        EXPECT_NEAR(glm::determinant(rotation), 1, 1e-5f);
        EXPECT_LT(glm::distance(-rotation[2], glm::normalize(target)), 1e-5f);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(glm::length(rotation[i]), 1, 1e-5f);
    }
}

TEST(Camera, FrameBoundsShowsEveryCornerAndLittleElse) {
    for (const float shape : {0.4f, 1.0f, 2.5f}) {
        const Bounds3 bounds{{-2, 0, 1}, {5, 3, 9}};
        const Camera camera = frame_bounds(bounds, shape);
        float reach = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 p((corner & 1) ? 5 : -2, (corner & 2) ? 3 : 0, (corner & 4) ? 9 : 1);
            const Vec3 seen = project(camera, shape, p);
            EXPECT_GT(seen.z, 0);
            reach = std::max({reach, std::abs(seen.x - 0.5f), std::abs(seen.y - 0.5f)});
        }
        EXPECT_LT(reach, 0.5f);
        EXPECT_GT(reach, 0.45f);
    }
    // Of a point or of nothing there is still a camera.
    EXPECT_TRUE(is_finite(frame_bounds({{1, 1, 1}, {1, 1, 1}}, 1).position()));
    EXPECT_TRUE(is_finite(frame_bounds({}, 1).position()));
}

TEST(Camera, PanoramaSeesEveryDirectionAndProjectUndoesIt) {
    Camera camera = make_camera(Projection::panorama);
    const auto seen = [&](const Vec2& uv) { return generate_ray(camera, 2, uv, Vec2(0.3f)).direction; };
    EXPECT_LT(glm::distance(seen({0.5f, 0.5f}), camera.forward()), 1e-5f);
    EXPECT_LT(glm::distance(seen({0.75f, 0.5f}), Vec3(camera.world_from_camera[0])), 1e-5f) << "right of the middle";
    EXPECT_LT(glm::distance(seen({0.1f, 0}), Vec3(camera.world_from_camera[1])), 1e-5f) << "the top row is up";
    for (const Vec2 uv : {Vec2(0.5f), Vec2(0.02f, 0.9f), Vec2(0.8f, 0.3f)}) {
        const Vec3 at = project(camera, 2, camera.position() + 7.0f * seen(uv));
        EXPECT_LT(glm::distance(Vec2(at), uv), 1e-4f);
        EXPECT_NEAR(at.z, 7, 1e-4f);
    }
}

TEST(Camera, BladesMakeAPolygon) {
    Camera camera;
    camera.aperture_diameter_m = 2;
    camera.focus_distance_m = 5;
    std::mt19937 engine{1};
    const auto random = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    for (const uint32_t blades : {3u, 5u, 6u}) {
        camera.aperture_blades = blades;
        const float inner = std::cos(pi / static_cast<float>(blades));
        double second_moment = 0;
        constexpr int count = 20000;
        for (int i = 0; i < count; ++i) {
            const Vec2 p(generate_ray(camera, 1, Vec2(0.5f), {random(), random()}).origin);
            // Inside all edges, whose normals point between the corners.
            for (uint32_t k = 0; k < blades; ++k) {
                const float angle = 2 * pi * (static_cast<float>(k) + 0.5f) / static_cast<float>(blades);
                ASSERT_LE(glm::dot(p, Vec2(std::sin(angle), std::cos(angle))), inner + 1e-5f);
            }
            second_moment += static_cast<double>(glm::dot(p, p)) / count;
        }
        // Uniform over a regular polygon of circumradius 1: E[r²] = (2 + cos(2π/n)) / 6.
        const double exact = (2 + std::cos(2 * static_cast<double>(pi) / blades)) / 6;
        EXPECT_NEAR(second_moment, exact, 0.01) << blades;
    }
}

}  // namespace
}  // namespace candela
