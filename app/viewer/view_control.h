// SPDX-License-Identifier: MIT
// Moving a camera by hand: pure functions from one view to the next. Drags are in fractions of the picture's height,
// right and down positive; film_uv is (0,0) at the top left of the picture and (1,1) at the bottom right.
#pragma once

#include "renderer/scene/camera.h"

namespace candela {

// A camera and the point it turns about.
struct OrbitView {
    Camera camera;
    Vec3 pivot{0};

    bool operator==(const OrbitView&) const = default;
};

enum class AxisView : uint8_t { front, right, top, isometric };

// Distance of the pivot along the view axis, at least a little.
float pivot_distance(const OrbitView& view);

// Turns about +Y through the pivot and about the camera's own horizontal axis, as if the scene were held at the cursor:
// the picture's height is half a turn. Stops when it looks straight down or up.
OrbitView orbit(const OrbitView& view, const Vec2& drag);
// What lies at the pivot's distance follows the cursor.
OrbitView pan(const OrbitView& view, const Vec2& drag);
// Brings the camera nearer to anchor, a point that stays where it is in the picture: factor < 1 shrinks all distances
// by it, > 1 grows them; an orthographic picture is magnified instead.
OrbitView dolly(const OrbitView& view, const Vec3& anchor, float factor, float aspect);
// Moves the eye and the pivot by so many metres to the right, up in the world, and forward.
OrbitView fly(const OrbitView& view, const Vec3& right_up_forward_m);
// Turns the head: as orbit, but about the eye. The scene follows the drag.
OrbitView look_around(const OrbitView& view, const Vec2& drag);
// Moves the camera sideways so that point comes to the middle, and turns about it from then on.
OrbitView recentre(const OrbitView& view, const Vec3& point);
// Looks at the pivot from that side, at the same distance. isometric is orthographic; the others keep the projection.
OrbitView look_from(const OrbitView& view, AxisView side);
// Perspective to orthographic and back; what lies at the pivot's distance keeps its size.
OrbitView toggle_orthographic(const OrbitView& view);
// The whole box from the direction that frame_bounds chooses; lens and projection stay.
OrbitView frame_all(const OrbitView& view, const Bounds3& bounds, float aspect);
// The view of a camera whose pivot is not known: the point on its axis where the box's middle is, or inside the box.
OrbitView view_of(const Camera& camera, const Bounds3& bounds);
// The point on the ray through film_uv at the pivot's distance.
Vec3 point_at_pivot_distance(const OrbitView& view, float aspect, const Vec2& film_uv);

}  // namespace candela
