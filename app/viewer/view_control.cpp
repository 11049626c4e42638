// SPDX-License-Identifier: MIT
#include "app/viewer/view_control.h"

#include <glm/gtc/matrix_transform.hpp>

namespace candela {

namespace {

// Height of the picture where the pivot is, in metres.
float height_at_pivot(const OrbitView& view) {
    const Camera& camera = view.camera;
    return camera.projection == Projection::orthographic ? 2 * camera.ortho_half_height_m
                                                         : 2 * std::tan(camera.yfov_radians / 2) * pivot_distance(view);
}

void rotate_about(OrbitView& view, float radians, const Vec3& axis) {
    Mat4& pose = view.camera.world_from_camera;
    const Mat4 rotation = glm::rotate(Mat4(1), radians, axis);
    const Vec3 arm = view.camera.position() - view.pivot;
    const Vec3 position = view.pivot + Vec3(rotation * Vec4(arm, 0));
    pose = rotation * pose;

    // Thousands of small turns must not shear the pose.
    const Vec3 back = glm::normalize(Vec3(pose[2]));
    const Vec3 right = glm::normalize(glm::cross(Vec3(pose[1]), back));
    pose = Mat4(Vec4(right, 0), Vec4(glm::cross(back, right), 0), Vec4(back, 0), Vec4(position, 1));
}

void move_to(OrbitView& view, const Vec3& position) {
    view.camera.world_from_camera[3] = Vec4(position, 1);
}

void look_along(OrbitView& view, const Vec3& back, const Vec3& up) {
    const float distance = pivot_distance(view);
    view.camera.world_from_camera = look_at(view.pivot + distance * back, view.pivot, up);
}

// About +Y and the camera's own horizontal axis through the pivot, from one pole to the other: the scene never stands
// on its head.
OrbitView turned(const OrbitView& view, const Vec2& radians) {
    OrbitView out = view;
    rotate_about(out, -radians.x, {0, 1, 0});
    const Vec3 back = Vec3(out.camera.world_from_camera[2]);
    const float elevation = std::asin(std::clamp(back.y, -1.0f, 1.0f));
    const bool upright = out.camera.world_from_camera[1].y >= 0;
    const float limit = pi / 2;
    const float turn = upright ? std::clamp(elevation + radians.y, -limit, limit) - elevation : radians.y;
    rotate_about(out, -turn, Vec3(out.camera.world_from_camera[0]));
    return out;
}

}  // namespace

float pivot_distance(const OrbitView& view) {
    const float along = glm::dot(view.pivot - view.camera.position(), view.camera.forward());
    return std::max(along, 1e-5f);
}

OrbitView orbit(const OrbitView& view, const Vec2& drag) {
    return turned(view, pi * drag);
}

OrbitView fly(const OrbitView& view, const Vec3& right_up_forward_m) {
    OrbitView out = view;
    const Vec3 right = Vec3(view.camera.world_from_camera[0]);
    const Vec3 step = right_up_forward_m.x * right + right_up_forward_m.y * Vec3(0, 1, 0) +
                      right_up_forward_m.z * view.camera.forward();
    move_to(out, view.camera.position() + step);
    out.pivot += step;
    return out;
}

OrbitView look_around(const OrbitView& view, const Vec2& drag) {
    // What the drag began at stays under the cursor, in the middle of the picture at least.
    const float distance = pivot_distance(view);
    OrbitView eye = view;
    eye.pivot = view.camera.position();
    OrbitView out = turned(eye, -view.camera.yfov_radians * drag);
    out.pivot = out.camera.position() + distance * out.camera.forward();
    return out;
}

OrbitView pan(const OrbitView& view, const Vec2& drag) {
    OrbitView out = view;
    const Mat4& pose = view.camera.world_from_camera;
    const Vec3 offset = height_at_pivot(view) * (-drag.x * Vec3(pose[0]) + drag.y * Vec3(pose[1]));
    move_to(out, view.camera.position() + offset);
    out.pivot += offset;
    return out;
}

OrbitView dolly(const OrbitView& view, const Vec3& anchor, float factor, float aspect) {
    OrbitView out = view;
    const float distance = pivot_distance(view);
    if (view.camera.projection == Projection::orthographic) {
        // Magnify, then slide so that the anchor keeps its place.
        out.camera.ortho_half_height_m = std::clamp(view.camera.ortho_half_height_m * factor, 1e-6f, 1e12f);
        const Vec3 before = project(view.camera, aspect, anchor), after = project(out.camera, aspect, anchor);
        return pan(out, {(before.x - after.x) * aspect, before.y - after.y});
    }
    move_to(out, anchor + (view.camera.position() - anchor) * factor);
    out.pivot = out.camera.position() + out.camera.forward() * distance * factor;
    return out;
}

OrbitView recentre(const OrbitView& view, const Vec3& point) {
    OrbitView out = view;
    const Vec3 forward = view.camera.forward();
    const Vec3 to_point = point - view.camera.position();
    move_to(out, view.camera.position() + to_point - glm::dot(to_point, forward) * forward);
    out.pivot = point;
    return out;
}

OrbitView look_from(const OrbitView& view, AxisView side) {
    OrbitView out = view;
    switch (side) {
        case AxisView::front:
            look_along(out, {0, 0, 1}, {0, 1, 0});
            break;
        case AxisView::right:
            look_along(out, {1, 0, 0}, {0, 1, 0});
            break;
        case AxisView::top:
            look_along(out, {0, 1, 0}, {0, 0, -1});
            break;
        case AxisView::isometric:
            if (out.camera.projection == Projection::perspective) out = toggle_orthographic(out);
            look_along(out, glm::normalize(Vec3(1)), {0, 1, 0});
            break;
    }
    return out;
}

OrbitView toggle_orthographic(const OrbitView& view) {
    OrbitView out = view;
    const float half_height = height_at_pivot(view) / 2;
    if (view.camera.projection == Projection::perspective) {
        out.camera.projection = Projection::orthographic;
        out.camera.ortho_half_height_m = half_height;
        return out;
    }
    out.camera.projection = Projection::perspective;
    move_to(out, view.pivot - view.camera.forward() * (half_height / std::tan(out.camera.yfov_radians / 2)));
    // The pivot stays on the side where it was.
    const Vec3 aside = view.pivot - view.camera.position();
    const Vec3 forward = view.camera.forward();
    move_to(out, out.camera.position() - (aside - glm::dot(aside, forward) * forward));
    return out;
}

OrbitView frame_all(const OrbitView& view, const Bounds3& bounds, float aspect) {
    OrbitView out;
    out.camera = frame_bounds(bounds, aspect, view.camera.yfov_radians);
    out.pivot = bounds.center();
    out.camera.aperture_diameter_m = view.camera.aperture_diameter_m;
    out.camera.focus_distance_m = pivot_distance(out);
    if (view.camera.projection == Projection::orthographic) out = toggle_orthographic(out);
    return out;
}

OrbitView view_of(const Camera& camera, const Bounds3& bounds) {
    OrbitView out{camera, camera.position() + camera.forward()};
    const float size = glm::length(bounds.upper - bounds.lower);
    if (!(size > 0) || !std::isfinite(size)) return out;
    const float along = glm::dot(bounds.center() - camera.position(), camera.forward());
    out.pivot = camera.position() + camera.forward() * std::max(along, 0.05f * size);
    return out;
}

Vec3 point_at_pivot_distance(const OrbitView& view, float aspect, const Vec2& film_uv) {
    Camera pinhole = view.camera;
    pinhole.aperture_diameter_m = 0;
    const Ray ray = generate_ray(pinhole, aspect, film_uv, Vec2(0.5f));
    const float along = glm::dot(ray.direction, view.camera.forward());
    const float start = glm::dot(ray.origin - view.camera.position(), view.camera.forward());
    return ray.origin + ray.direction * ((pivot_distance(view) - start) / std::max(along, 1e-6f));
}

}  // namespace candela
