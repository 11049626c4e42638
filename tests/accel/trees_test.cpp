// SPDX-License-Identifier: MIT
// Trees that Accels share, and trees that are fitted to a pose.
#include <atomic>
#include <thread>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/accel/soup.h"

namespace candela {
namespace {

using test::hit_soup;
using test::Random;
using test::Soup;

// A soup that bends: bend(0) is the rest.
struct BendingSoup {
    std::shared_ptr<const Soup> rest;

    BendingSoup(Random& random, int count, float size) : rest(std::make_shared<Soup>(random, count, size)) {}

    std::shared_ptr<const Soup> bend(float amount) const {
        auto out = std::make_shared<Soup>(*rest);
        for (Vec3& p : out->positions) {
            const float angle = amount * p.x;
            p = Vec3(p.x + 0.3f * amount, p.y * std::cos(angle) - p.z * std::sin(angle),
                     p.y * std::sin(angle) + p.z * std::cos(angle));
        }
        return out;
    }
    AccelShape shape(const std::shared_ptr<const Soup>& pose) const {
        AccelGeometry geometry = pose->geometry();
        geometry.triangles = rest->triangles;
        geometry.rest_positions = rest->geometry().positions;
        AccelShape out;
        out.geometries = {geometry};
        out.owner = pose;
        out.rest = rest;
        return out;
    }
};

AccelShape rigid(const std::shared_ptr<const Soup>& soup) {
    AccelShape out;
    out.geometries = {soup->geometry()};
    out.owner = soup;
    return out;
}

AccelShape again(std::shared_ptr<const AccelTree> tree) {
    AccelShape out;
    out.tree = std::move(tree);
    return out;
}

std::vector<Hit> hits_of(const Accel& accel, int count) {
    Random random;
    std::vector<Hit> out;
    for (int i = 0; i < count; ++i)
        out.push_back(accel.intersect({random.in_box(3), random.direction()}, 0));
    return out;
}

bool same_hits(const std::vector<Hit>& a, const std::vector<Hit>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Hit& x, const Hit& y) {
        return x.surface == y.surface && x.triangle == y.triangle && x.distance == y.distance && x.u == y.u &&
               x.v == y.v;
    });
}

Mat4 placed_at(float x, float angle) {
    return glm::rotate(glm::translate(Mat4(1), Vec3(x, 0, 0)), angle, Vec3(1, 2, 3));
}

// A room that stays, a thing that is moved, and one that bends.
struct MovingScene {
    Random random;
    std::shared_ptr<const Soup> room{std::make_shared<Soup>(random, 300, 0.3f)};
    std::shared_ptr<const Soup> thing{std::make_shared<Soup>(random, 100, 0.2f)};
    BendingSoup body{random, 200, 0.2f};

    struct Pose {
        std::shared_ptr<const Soup> body;
        Mat4 thing{1}, world_from_body{1};
    };
    Pose at(float t) const { return {body.bend(t), placed_at(1 + 0.2f * t, t), placed_at(-1, 0.5f)}; }

    // From nothing, or from the Accel of another pose.
    std::unique_ptr<Accel> build(const Pose& pose, const Accel* before) const {
        AccelInput input;
        input.fixed = before != nullptr ? again(before->fixed_tree()) : rigid(room);
        input.fixed_surfaces = {0};
        input.shapes = {before != nullptr ? again(before->shape_tree(0)) : rigid(thing), body.shape(pose.body)};
        input.instances = {{0, pose.thing, 1}, {1, pose.world_from_body, 2}};
        input.relative = before;
        return Accel::build(input);
    }
};

TEST(AccelTrees, APoseBuildsOnlyWhatIsNewInIt) {
    const MovingScene scene;
    auto first = scene.build(scene.at(0.3f), nullptr);
    EXPECT_EQ(first->work().trees_built, 3u);
    EXPECT_EQ(first->work().trees_refitted, 1u);
    EXPECT_EQ(first->work().trees_shared, 0u);

    // While the first lives, the second has to lay out a tree of its own for what bends; the third takes the first's.
    auto second = scene.build(scene.at(0.6f), first.get());
    EXPECT_EQ(second->work().trees_built, 1u);
    EXPECT_EQ(second->work().trees_shared, 2u);
    EXPECT_EQ(second->fixed_tree(), first->fixed_tree());
    first.reset();
    const auto third = scene.build(scene.at(0.9f), second.get());
    EXPECT_EQ(third->work().trees_built, 0u);
    EXPECT_EQ(third->work().trees_refitted, 1u);
    EXPECT_EQ(third->work().trees_shared, 2u);
    EXPECT_TRUE(third->work().placement_built);

    // Nothing moves: nothing is made.
    AccelInput same;
    same.fixed = again(third->fixed_tree());
    same.fixed_surfaces = {0};
    same.shapes = {again(third->shape_tree(0)), again(third->shape_tree(1))};
    const MovingScene::Pose pose = scene.at(0.9f);
    same.instances = {{0, pose.thing, 1}, {1, pose.world_from_body, 2}};
    same.relative = third.get();
    const auto fourth = Accel::build(same);
    EXPECT_EQ(fourth->work().trees_built + fourth->work().trees_refitted, 0u);
    EXPECT_FALSE(fourth->work().placement_built);
    EXPECT_TRUE(same_hits(hits_of(*third, 2000), hits_of(*fourth, 2000)));
}

TEST(AccelTrees, RefittedTreesHitWhatBruteForceHits) {
    const MovingScene scene;
    std::unique_ptr<Accel> accel;
    for (const float t : {0.0f, 0.4f, 1.5f, 0.7f}) {
        const MovingScene::Pose pose = scene.at(t);
        accel = scene.build(pose, accel.get());
        Random random;
        int hits = 0, differing = 0;
        for (int i = 0; i < 1500; ++i) {
            const Ray ray{random.in_box(3), random.direction()};
            Hit expected;
            hit_soup(ray, *scene.room, Mat4(1), 0, expected);
            hit_soup(ray, *scene.thing, pose.thing, 1, expected);
            hit_soup(ray, *pose.body, pose.world_from_body, 2, expected);
            const Hit hit = accel->intersect(ray, 0);
            hits += expected.valid() ? 1 : 0;
            const bool same =
                hit.valid() == expected.valid() && hit.surface == expected.surface && hit.triangle == expected.triangle;
            differing += same ? 0 : 1;
            if (!same || !hit.valid()) continue;
            EXPECT_NEAR(hit.distance, expected.distance, 1e-4f * (1 + expected.distance));
        }
        EXPECT_GT(hits, 100);
        EXPECT_LE(differing, 1) << "at " << t;
    }
}

// Two triangles that share an edge, or coincide, hide each other in the order of traversal: only the same tree hits
// the same one. Every triangle is there twice.
TEST(AccelTrees, APoseHasTheSameTreeWhateverWasBefore) {
    MovingScene scene;
    Soup doubled = *scene.body.rest;
    for (const Vec3u& triangle : scene.body.rest->triangles)
        doubled.triangles.push_back(triangle);
    scene.body.rest = std::make_shared<const Soup>(doubled);

    const std::vector<Hit> expected = hits_of(*scene.build(scene.at(0.8f), nullptr), 20000);
    std::unique_ptr<Accel> accel;
    for (const float t : {2.0f, 0.1f, -1.0f, 0.8f})
        accel = scene.build(scene.at(t), accel.get());
    EXPECT_EQ(accel->work().trees_built, 0u);
    EXPECT_TRUE(same_hits(hits_of(*accel, 20000), expected));
}

TEST(AccelTrees, LargeTreesAreBuiltAlikeEveryTime) {
    Random random;
    const auto soup = std::make_shared<Soup>(random, 30000, 0.02f);
    auto doubled = std::make_shared<Soup>(*soup);
    doubled->triangles.insert(doubled->triangles.end(), soup->triangles.begin(), soup->triangles.end());
    AccelInput input;
    input.fixed = rigid(doubled);
    input.fixed_surfaces = {0};
    const std::vector<Hit> expected = hits_of(*Accel::build(input), 20000);
    for (int i = 0; i < 5; ++i)
        EXPECT_TRUE(same_hits(hits_of(*Accel::build(input), 20000), expected));
}

TEST(AccelTrees, AnOldPoseIsTracedOnWhileNewOnesAreMade) {
    const MovingScene scene;
    const auto old = scene.build(scene.at(0.5f), nullptr);
    const std::vector<Hit> expected = hits_of(*old, 2000);
    std::atomic<bool> stop{false}, same{true};
    std::atomic<int> rounds{0};
    std::thread tracer([&] {
        while (!stop) {
            if (!same_hits(hits_of(*old, 2000), expected)) same = false;
            ++rounds;
        }
    });
    std::unique_ptr<Accel> newest = scene.build(scene.at(0), old.get());
    // However long the tracer takes, no pose comes near the old one.
    for (int i = 0; i < 100 || rounds < 10; ++i)
        newest = scene.build(scene.at(0.6f + 0.02f * static_cast<float>(i % 70)), newest.get());
    stop = true;
    tracer.join();
    EXPECT_TRUE(same);
    EXPECT_FALSE(same_hits(hits_of(*newest, 2000), expected));
}

TEST(AccelTrees, AHundredPosesNeedNoMoreMemoryThanAFew) {
    const MovingScene scene;
    std::unique_ptr<Accel> accel = scene.build(scene.at(0), nullptr);
    for (int i = 0; i < 5; ++i)
        accel = scene.build(scene.at(0.01f * static_cast<float>(i)), accel.get());
    const uint64_t few = accel->memory_bytes();
    for (int i = 0; i < 100; ++i) {
        accel = scene.build(scene.at(0.01f * static_cast<float>(i)), accel.get());
        ASSERT_EQ(accel->work().trees_built, 0u);
    }
    EXPECT_LE(accel->memory_bytes(), few + few / 20);
}

TEST(AccelTrees, TheVerticesOfAPoseLiveAsLongAsItsAccel) {
    const MovingScene scene;
    const auto first = scene.build(scene.at(0), nullptr);
    std::unique_ptr<Accel> second = scene.build(scene.at(1), first.get());
    for (int i = 0; i < 2; ++i) {
        MovingScene::Pose pose = scene.at(0.5f);
        const std::weak_ptr<const Soup> vertices = pose.body;
        second = scene.build(pose, first.get());
        pose.body.reset();
        EXPECT_FALSE(vertices.expired());
        second.reset();
        EXPECT_TRUE(vertices.expired()) << "a tree that waits keeps its old vertices";
    }
}

TEST(AccelTrees, TheSameTreesAskEachAccelsOwnUser) {
    const auto opacity = [](const void* user, uint32_t, uint32_t, float, float) noexcept {
        return *static_cast<const float*>(user);
    };
    const std::vector<Vec3> positions{{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}, {}, {}};
    const std::vector<Vec3u> triangles{{0, 1, 2}};
    AccelInput input;
    input.fixed.geometries = {{std::span(positions).first(3), triangles, true, {}}};
    input.fixed_surfaces = {0};
    input.opacity = opacity;
    const float quarter = 0.25f, half = 0.5f;
    input.opacity_user = &quarter;
    const auto first = Accel::build(input);
    const auto second = first->with_user(&half);
    const Ray ray{{0, 0, 0}, {0, 0, 1}};
    EXPECT_EQ(first->transmittance(ray), Vec3(0.75f));
    EXPECT_EQ(second->transmittance(ray), Vec3(0.5f));
    EXPECT_EQ(first->fixed_tree(), second->fixed_tree());
    EXPECT_EQ(second->work().trees_built, 0u);
}

TEST(AccelTrees, ACancelledPoseLeavesTheFamilySound) {
    const MovingScene scene;
    auto first = scene.build(scene.at(0.3f), nullptr);
    AccelInput input;
    const MovingScene::Pose pose = scene.at(0.6f);
    input.shapes = {scene.body.shape(pose.body)};
    input.relative = first.get();
    const std::atomic<bool> cancel{true};
    EXPECT_THROW(Accel::build(input, {}, &cancel), AccelError);
    const auto second = scene.build(pose, first.get());
    EXPECT_TRUE(same_hits(hits_of(*second, 2000), hits_of(*scene.build(pose, nullptr), 2000)));
}

}  // namespace
}  // namespace candela
