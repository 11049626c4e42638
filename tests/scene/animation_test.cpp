// SPDX-License-Identifier: MIT
// Interpolation against its closed forms.
#include "renderer/scene/animation.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

AnimationSampler sampler(Interpolation interpolation, std::vector<float> times, std::vector<float> values,
                         uint32_t width, bool is_rotation = false) {
    AnimationSampler out;
    out.times_s = std::make_shared<const std::vector<float>>(std::move(times));
    out.values = std::move(values);
    out.width = width;
    out.interpolation = interpolation;
    out.is_rotation = is_rotation;
    return out;
}

std::vector<float> at(const AnimationSampler& keys, float time_s) {
    std::vector<float> out(keys.width, -1.0f);
    evaluate(keys, time_s, out);
    return out;
}

// A rotation about z as x y z w.
std::vector<float> about_z(float degrees) {
    const float half = glm::radians(degrees) / 2;
    return {0, 0, std::sin(half), std::cos(half)};
}

float angle_about_z(const std::vector<float>& q) {
    return glm::degrees(2 * std::atan2(q[2], q[3]));
}

std::vector<float> joined(std::initializer_list<std::vector<float>> parts) {
    std::vector<float> out;
    for (const std::vector<float>& part : parts)
        out.insert(out.end(), part.begin(), part.end());
    return out;
}

TEST(Animation, StepHoldsTheLastKey) {
    const AnimationSampler keys = sampler(Interpolation::step, {1, 2, 4}, {10, 20, 40}, 1);
    EXPECT_EQ(at(keys, 0), std::vector{10.0f});
    EXPECT_EQ(at(keys, 1), std::vector{10.0f});
    EXPECT_EQ(at(keys, 1.999f), std::vector{10.0f});
    EXPECT_EQ(at(keys, 2), std::vector{20.0f});
    EXPECT_EQ(at(keys, 3.999f), std::vector{20.0f});
    EXPECT_EQ(at(keys, 4), std::vector{40.0f});
    EXPECT_EQ(at(keys, 1e9f), std::vector{40.0f});
}

TEST(Animation, LinearIsALineBetweenKeysAndFlatOutside) {
    const AnimationSampler keys = sampler(Interpolation::linear, {1, 2, 4}, {0, 100, 10, 300, 50, 700}, 2);
    EXPECT_EQ(at(keys, -5), (std::vector{0.0f, 100.0f}));
    EXPECT_EQ(at(keys, 1.25f), (std::vector{2.5f, 150.0f}));
    EXPECT_EQ(at(keys, 2), (std::vector{10.0f, 300.0f}));
    EXPECT_EQ(at(keys, 3), (std::vector{30.0f, 500.0f}));
    EXPECT_EQ(at(keys, 5), (std::vector{50.0f, 700.0f}));
    EXPECT_EQ(at(keys, std::numeric_limits<float>::quiet_NaN()), (std::vector{50.0f, 700.0f}));
}

TEST(Animation, RotationsTurnAtConstantSpeedTheShorterWay) {
    const AnimationSampler keys = sampler(Interpolation::linear, {0, 1}, joined({about_z(10), about_z(130)}), 4, true);
    for (const float t : {0.0f, 0.1f, 0.25f, 0.5f, 0.9f, 1.0f})
        EXPECT_NEAR(angle_about_z(at(keys, t)), 10 + 120 * t, 1e-4f) << t;
    // The same rotation with the opposite sign: still 120 degrees, not 240 the other way round.
    std::vector<float> opposite = about_z(130);
    for (float& c : opposite)
        c = -c;
    const AnimationSampler flipped = sampler(Interpolation::linear, {0, 1}, joined({about_z(10), opposite}), 4, true);
    EXPECT_NEAR(angle_about_z(at(flipped, 0.25f)), 40, 1e-4f);
    // From 350 to 10 degrees through 0.
    const AnimationSampler across =
        sampler(Interpolation::linear, {0, 1}, joined({about_z(350), about_z(10)}), 4, true);
    EXPECT_NEAR(std::abs(angle_about_z(at(across, 0.5f))), 360, 1e-3f);
    // Keys that are the same, or of another length than 1.
    const AnimationSampler still =
        sampler(Interpolation::linear, {0, 1}, joined({{0, 0, 0, 5}, {0, 0, 0, 2}}), 4, true);
    EXPECT_EQ(at(still, 0.3f), (std::vector{0.0f, 0.0f, 0.0f, 1.0f}));
}

// A cubic with the right tangents is that cubic: f(t) = t³ - 2t + 1 over intervals of different lengths.
TEST(Animation, CubicSplinesReproduceCubics) {
    const auto f = [](float t) { return t * t * t - 2 * t + 1; };
    const auto slope = [](float t) { return 3 * t * t - 2; };
    std::vector<float> values;
    const std::vector<float> times = {0, 0.5f, 2, 3};
    for (const float t : times)
        values.insert(values.end(), {slope(t), f(t), slope(t)});
    const AnimationSampler keys = sampler(Interpolation::cubic_spline, times, values, 1);
    for (float t = 0; t <= 3; t += 0.0625f)
        EXPECT_NEAR(at(keys, t)[0], f(t), 2e-5f) << t;
    EXPECT_EQ(at(keys, -1)[0], f(0));
    EXPECT_EQ(at(keys, 9)[0], f(3));
}

// Tangents towards and away from a key differ: each acts on its own side.
TEST(Animation, CubicTangentsBelongToTheirSides) {
    const AnimationSampler keys = sampler(Interpolation::cubic_spline, {0, 2}, {100, 1, 3, /* */ -5, 7, 100}, 1);
    // Hermite at the middle: (p0 + p1) / 2 + interval (m0 - m1) / 8.
    EXPECT_NEAR(at(keys, 1)[0], 4.0f + 2.0f * (3 - -5) / 8.0f, 1e-5f);
}

TEST(Animation, CubicRotationsAreUnit) {
    const AnimationSampler keys =
        sampler(Interpolation::cubic_spline, {0, 1},
                joined({{0, 0, 0, 0}, about_z(0), {0, 0, 0, 0}, {0, 0, 0, 0}, about_z(90), {0, 0, 0, 0}}), 4, true);
    const std::vector<float> q = at(keys, 0.5f);
    EXPECT_NEAR(q[2] * q[2] + q[3] * q[3], 1.0f, 1e-6f);
    EXPECT_NEAR(angle_about_z(q), 45, 1e-4f);
}

TEST(Animation, OneKeyIsAConstant) {
    EXPECT_EQ(at(sampler(Interpolation::linear, {3}, {8}, 1), 0), std::vector{8.0f});
    EXPECT_EQ(at(sampler(Interpolation::cubic_spline, {3}, {1, 8, 2}, 1), 4), std::vector{8.0f});
}

TEST(AnimatedProperty, PointersAreFoundWithTheirIndex) {
    const auto rotation = find_animated_property("/nodes/12/rotation");
    ASSERT_TRUE(rotation);
    EXPECT_EQ(rotation->object, 12u);
    EXPECT_TRUE(rotation->property->is_rotation);
    const auto coat = find_animated_property("/materials/3/extensions/KHR_materials_clearcoat/clearcoatFactor");
    ASSERT_TRUE(coat);
    EXPECT_EQ(coat->object, 3u);
    const auto light = find_animated_property("/extensions/KHR_lights_punctual/lights/0/intensity");
    ASSERT_TRUE(light);
    const auto uv = find_animated_property("/materials/7/emissiveTexture/extensions/KHR_texture_transform/scale");
    ASSERT_TRUE(uv);
    EXPECT_EQ(uv->object, 7u);
    EXPECT_EQ(uv->property->width, 2u);
    for (const char* wrong :
         {"", "/", "/nodes", "/nodes/1", "/nodes/01/rotation", "/nodes/-1/rotation", "/nodes/x/rotation",
          "/nodes/1/rotation/0", "/nodes/99999999999/rotation", "/nodes//rotation", "/materials/0/name",
          "/materials/0/nothingTexture/extensions/KHR_texture_transform/scale", "nodes/1/rotation"})
        EXPECT_FALSE(find_animated_property(wrong)) << wrong;
}

}  // namespace
}  // namespace candela
