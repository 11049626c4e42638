// SPDX-License-Identifier: MIT
// A camera is a value: pose, projection, thin lens. It owns neither film nor sampler.
#pragma once

#include "renderer/math/bounds.h"
#include "renderer/math/ray.h"

namespace candela {

// panorama: the whole sphere, equirectangular: the column in the middle looks along the view axis, the row in the
// middle at the horizon; columns run clockwise seen from above.
enum class Projection : uint8_t { perspective, orthographic, panorama };

struct Camera {
    // Columns are right, up, back (the camera looks along -Z) and position; orthonormal rotation part.
    Mat4 world_from_camera{1.0f};
    Projection projection = Projection::perspective;
    float yfov_radians = 0.7853982f;   // full vertical angle
    float ortho_half_height_m = 1.0f;  // half the height that the picture spans
    float aspect = 0.0f;               // width / height that the file asks for; 0: none
    float aperture_diameter_m = 0.0f;  // 0: pinhole
    // Blades of the aperture: a regular polygon inscribed in its circle, one corner up. Fewer than 3: the circle.
    uint32_t aperture_blades = 0;
    float focus_distance_m = 1.0f;  // distance of the plane in focus, along the view axis

    Vec3 position() const { return Vec3(world_from_camera[3]); }
    Vec3 forward() const { return -Vec3(world_from_camera[2]); }
    bool operator==(const Camera&) const = default;
};

inline const char* name_of(Projection projection) {
    return projection == Projection::perspective ? "perspective"
           : projection == Projection::panorama  ? "panorama"
                                                 : "orthographic";
}

// The ray through film_uv for a picture of width / height = aspect. film_uv is (0,0) at the top left and (1,1) at the
// bottom right of the picture, lens_uv in [0,1)² picks the point on the lens. aspect replaces the camera's own; the
// vertical angle stays. A panorama has no lens. The direction is a unit vector.
Ray generate_ray(const Camera& camera, float aspect, const Vec2& film_uv, const Vec2& lens_uv) noexcept;

// The cone around a ray of the camera that is as wide as a pixel of a picture `height` pixels high, in the geometric
// mean over directions. A lens does not widen it.
RayCone pixel_cone(const Camera& camera, uint32_t height, const Ray& ray) noexcept;

// Where a world point appears: film_uv in xy, distance along the view axis in z (negative behind a perspective camera;
// from the eye for a panorama).
Vec3 project(const Camera& camera, float aspect, const Vec3& world_point) noexcept;

// world_from_camera of a camera at eye that looks at target; up need not be perpendicular, and may be parallel to the
// view (another axis is then taken).
Mat4 look_at(const Vec3& eye, const Vec3& target, const Vec3& up);

// A perspective camera that looks at the whole box from the front, slightly from above (yaw 30°, pitch 15°), with the
// box just inside the picture.
Camera frame_bounds(const Bounds3& bounds, float aspect, float yfov_radians = 0.7853982f);

}  // namespace candela
