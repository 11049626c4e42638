// SPDX-License-Identifier: MIT
// Moving a camera by hand keeps what it promises about the picture.
#include "app/viewer/view_control.h"

namespace candela {
namespace {

constexpr float aspect = 1.6f;

OrbitView make_view() {
    OrbitView view;
    view.camera.world_from_camera = look_at({3, 2, 5}, {0.5f, 0.25f, -1}, {0, 1, 0});
    view.pivot = {0.5f, 0.25f, -1};
    return view;
}

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-4f) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

void expect_upright_and_orthonormal(const OrbitView& view) {
    const Mat3 rotation(view.camera.world_from_camera);
    const Mat3 product = glm::transpose(rotation) * rotation;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(product[i][j], i == j ? 1.0f : 0.0f, 1e-5f);
    }
    EXPECT_GT(glm::determinant(rotation), 0);
    EXPECT_GE(view.camera.world_from_camera[1].y, -1e-4f);
    EXPECT_NEAR(view.camera.world_from_camera[0].y, 0, 1e-4f) << "the horizon tilts";
}

TEST(ViewControl, OrbitKeepsDistanceAndTheMiddleOfThePicture) {
    const OrbitView before = make_view();
    const OrbitView after = orbit(before, {0.3f, 0.1f});
    EXPECT_NEAR(pivot_distance(after), pivot_distance(before), 1e-4f);
    expect_near(Vec3(Vec2(project(after.camera, aspect, after.pivot)), 0), {0.5f, 0.5f, 0});
    expect_upright_and_orthonormal(after);
    // Dragging to the right shows more of the left: the camera goes left.
    EXPECT_LT(glm::dot(after.camera.position() - before.camera.position(), Vec3(before.camera.world_from_camera[0])),
              0);
    EXPECT_GT(after.camera.position().y, before.camera.position().y);
}

TEST(ViewControl, OrbitThereAndBackReturns) {
    const OrbitView before = make_view();
    OrbitView view = before;
    for (int i = 0; i < 1000; ++i)
        view = orbit(view, {0.013f, i % 2 == 0 ? 0.01f : -0.01f});
    for (int i = 0; i < 1000; ++i)
        view = orbit(view, {-0.013f, 0});
    expect_near(view.camera.position(), before.camera.position(), 2e-2f);
    expect_upright_and_orthonormal(view);
}

TEST(ViewControl, OrbitStopsAtThePoles) {
    for (const float drag : {5.0f, -5.0f}) {
        const OrbitView view = orbit(make_view(), {0, drag});
        EXPECT_NEAR(view.camera.forward().y, drag > 0 ? -1 : 1, 1e-5f);
        expect_upright_and_orthonormal(view);
        // And comes back from there.
        const OrbitView back = orbit(view, {0, drag > 0 ? -0.25f : 0.25f});
        EXPECT_NEAR(std::abs(back.camera.forward().y), std::sqrt(0.5f), 1e-3f);
    }
}

TEST(ViewControl, PannedThePivotFollowsTheCursor) {
    for (const bool orthographic : {false, true}) {
        OrbitView view = make_view();
        if (orthographic) view = toggle_orthographic(view);
        const Vec3 point = view.pivot;
        const OrbitView after = pan(view, {0.2f, -0.1f});
        const Vec3 seen = project(after.camera, aspect, point);
        EXPECT_NEAR(seen.x, 0.5f + 0.2f / aspect, 1e-4f);
        EXPECT_NEAR(seen.y, 0.5f - 0.1f, 1e-4f);
        EXPECT_NEAR(pivot_distance(after), pivot_distance(view), 1e-4f);
    }
}

TEST(ViewControl, DollyKeepsTheAnchorInItsPlaceAndComesBack) {
    for (const bool orthographic : {false, true}) {
        OrbitView view = make_view();
        if (orthographic) view = toggle_orthographic(view);
        const Vec3 anchor{1, 0.5f, -2};
        const Vec3 before = project(view.camera, aspect, anchor);
        const OrbitView nearer = dolly(view, anchor, 0.5f, aspect);
        const Vec3 after = project(nearer.camera, aspect, anchor);
        expect_near(Vec3(Vec2(before), 0), Vec3(Vec2(after), 0));
        if (!orthographic) {
            EXPECT_NEAR(after.z, before.z / 2, 1e-4f);
        }
        const OrbitView back = dolly(nearer, anchor, 2.0f, aspect);
        expect_near(back.camera.position(), view.camera.position());
        EXPECT_NEAR(pivot_distance(back), pivot_distance(view), 1e-3f);
    }
}

TEST(ViewControl, RecentreBringsThePointToTheMiddleWithoutTurning) {
    const OrbitView view = make_view();
    const Vec3 point{1, 1, 0};
    const OrbitView after = recentre(view, point);
    expect_near(Vec3(Vec2(project(after.camera, aspect, point)), 0), {0.5f, 0.5f, 0});
    EXPECT_EQ(Mat3(after.camera.world_from_camera), Mat3(view.camera.world_from_camera));
    EXPECT_NEAR(project(after.camera, aspect, point).z, project(view.camera, aspect, point).z, 1e-4f);
    expect_near(after.pivot, point);
}

TEST(ViewControl, AxisViewsLookAlongTheirAxis) {
    const OrbitView view = make_view();
    expect_near(look_from(view, AxisView::front).camera.forward(), {0, 0, -1});
    expect_near(look_from(view, AxisView::right).camera.forward(), {-1, 0, 0});
    const OrbitView top = look_from(view, AxisView::top);
    expect_near(top.camera.forward(), {0, -1, 0});
    expect_near(Vec3(top.camera.world_from_camera[1]), {0, 0, -1});
    const OrbitView isometric = look_from(view, AxisView::isometric);
    EXPECT_EQ(isometric.camera.projection, Projection::orthographic);
    expect_near(isometric.camera.forward(), glm::normalize(Vec3(-1)));
    for (const AxisView side : {AxisView::front, AxisView::right, AxisView::top}) {
        EXPECT_NEAR(pivot_distance(look_from(view, side)), pivot_distance(view), 1e-4f);
    }
}

TEST(ViewControl, OrthographicKeepsSizesAtThePivotAndComesBack) {
    const OrbitView view = make_view();
    const OrbitView flat = toggle_orthographic(view);
    const Vec3 aside =
        view.pivot + 0.3f * Vec3(view.camera.world_from_camera[0]) + 0.2f * Vec3(view.camera.world_from_camera[1]);
    const Vec3 before = project(view.camera, aspect, aside), after = project(flat.camera, aspect, aside);
    expect_near(Vec3(Vec2(before), 0), Vec3(Vec2(after), 0));
    expect_near(toggle_orthographic(flat).camera.position(), view.camera.position(), 1e-3f);
}

TEST(ViewControl, FrameAllShowsEveryCorner) {
    const Bounds3 bounds{{-2, 0, 1}, {5, 3, 9}};
    const OrbitView view = frame_all(make_view(), bounds, aspect);
    expect_near(view.pivot, bounds.center());
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p((corner & 1) ? 5 : -2, (corner & 2) ? 3 : 0, (corner & 4) ? 9 : 1);
        const Vec3 seen = project(view.camera, aspect, p);
        EXPECT_TRUE(seen.x > 0 && seen.x < 1 && seen.y > 0 && seen.y < 1) << corner;
    }
}

TEST(ViewControl, PointAtPivotDistanceLiesUnderTheCursor) {
    for (const bool orthographic : {false, true}) {
        OrbitView view = make_view();
        if (orthographic) view = toggle_orthographic(view);
        const Vec3 seen = project(view.camera, aspect, point_at_pivot_distance(view, aspect, {0.2f, 0.7f}));
        EXPECT_NEAR(seen.x, 0.2f, 1e-4f);
        EXPECT_NEAR(seen.y, 0.7f, 1e-4f);
        EXPECT_NEAR(seen.z, pivot_distance(view), 1e-3f);
    }
}

TEST(ViewControl, ViewOfACameraTurnsAboutAPointInFront) {
    Camera camera;
    camera.world_from_camera = look_at({0, 0, 10}, {0, 0, 0}, {0, 1, 0});
    EXPECT_NEAR(view_of(camera, {{-1, -1, -1}, {1, 1, 1}}).pivot.z, 0, 1e-5f);
    // Behind the camera or nowhere: still in front.
    EXPECT_LT(view_of(camera, {{-1, -1, 19}, {1, 1, 21}}).pivot.z, 10);
    EXPECT_LT(view_of(camera, {}).pivot.z, 10);
}

}  // namespace
}  // namespace candela
