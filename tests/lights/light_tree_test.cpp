// SPDX-License-Identifier: MIT
// The tree over lights: it chooses with the probability that it states, and overlooks no light that shines.
#include "renderer/lights/light_tree.h"

#include <random>

#include "renderer/lights/lights.h"

namespace candela {
namespace {

class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    float operator()() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    Vec3 in_cube() {
        const float x = (*this)(), y = (*this)();
        return 2.0f * Vec3(x, y, (*this)()) - 1.0f;
    }

  private:
    std::mt19937 engine_;
};

// Lamps of all kinds in a cube of side 2.
Lights random_lights(Random& random, int count) {
    Lights out;
    for (int i = 0; i < count; ++i) {
        const float kind = random();
        if (kind < 0.4f) {
            EmissiveTriangle triangle;
            triangle.p0 = random.in_cube();
            triangle.edge1 = 0.3f * random.in_cube();
            triangle.edge2 = 0.3f * random.in_cube();
            triangle.mean_radiance = 10 * random();
            triangle.two_sided = random() < 0.3f;
            out.triangles.push_back(triangle);
            continue;
        }
        PlacedLight light;
        light.kind = kind < 0.7f ? LightKind::point : LightKind::spot;
        light.position = random.in_cube();
        light.direction = glm::normalize(random.in_cube());
        light.intensity = Vec3(random());
        light.cos_outer = std::cos(0.1f + 1.4f * random());
        light.cos_inner = lerp(light.cos_outer, 1.0f, random());
        out.punctual.push_back(light);
    }
    finish_lights(out, {{-1, -1, -1}, {1, 1, 1}});
    return out;
}

LightReceiver random_receiver(Random& random) {
    LightReceiver out;
    out.position = 1.5f * random.in_cube();
    if (random() < 0.8f) out.normal = glm::normalize(random.in_cube());
    out.both_sides = random() < 0.3f;
    return out;
}

TEST(LightTree, ProbabilitiesAddToOneAndAreThoseOfTheSamples) {
    Random random(1);
    for (int scene = 0; scene < 60; ++scene) {
        const Lights lights = random_lights(random, 1 + static_cast<int>(random() * 40));
        const auto count = static_cast<uint32_t>(lights.punctual.size() + lights.triangles.size());
        const LightReceiver receiver = random_receiver(random);
        double sum = 0;
        for (uint32_t i = 0; i < count; ++i)
            sum += static_cast<double>(lights.placed->probability(i, receiver));
        // Samples at equal steps: each light is met as often as its probability says.
        constexpr int steps = 20000;
        std::vector<int> met(count, 0);
        int missed = 0;
        for (int k = 0; k < steps; ++k) {
            const LightTree::Choice choice =
                lights.placed->sample(receiver, (static_cast<float>(k) + 0.5f) / static_cast<float>(steps));
            if (choice.probability > 0.0f) {
                ++met[choice.index];
                EXPECT_NEAR(choice.probability, lights.placed->probability(choice.index, receiver),
                            1e-5f * choice.probability);
            } else {
                ++missed;
            }
        }
        // A subtree may turn out dark only further down: what went there is lost.
        EXPECT_NEAR(sum, 1 - static_cast<double>(missed) / steps, 2e-3);
        for (uint32_t i = 0; i < count; ++i) {
            EXPECT_NEAR(met[i] / static_cast<double>(steps),
                        static_cast<double>(lights.placed->probability(i, receiver)), 2e-3);
        }
    }
}

TEST(LightTree, EveryLightThatShinesCanBeChosen) {
    Random random(2);
    int shining = 0;
    for (int scene = 0; scene < 200; ++scene) {
        const Lights lights = random_lights(random, 1 + static_cast<int>(random() * 200));
        for (int k = 0; k < 20; ++k) {
            const LightReceiver receiver = random_receiver(random);
            const auto received = [&](const Vec3& wi) {
                const float cosine = receiver.normal == Vec3(0) ? 1.0f : glm::dot(wi, receiver.normal);
                return receiver.both_sides ? std::abs(cosine) : cosine;
            };
            for (uint32_t i = 0; i < lights.punctual.size(); ++i) {
                const PlacedLight& light = lights.punctual[i];
                const Vec3 wi = glm::normalize(light.position - receiver.position);
                const float cosine = -glm::dot(light.direction, wi);
                if (received(wi) < 1e-3f || (light.kind == LightKind::spot && cosine < light.cos_outer + 1e-4f)) {
                    continue;
                }
                ++shining;
                EXPECT_GT(lights.placed->probability(i, receiver), 0.0f);
            }
            for (uint32_t i = 0; i < lights.triangles.size(); ++i) {
                const EmissiveTriangle& light = lights.triangles[i];
                const Vec3 normal = glm::normalize(glm::cross(light.edge1, light.edge2));
                // Any corner will do.
                for (const Vec3& corner : {light.p0, light.p0 + light.edge1, light.p0 + light.edge2}) {
                    const Vec3 wi = glm::normalize(corner - receiver.position);
                    const float emitted = light.two_sided ? std::abs(glm::dot(normal, wi)) : -glm::dot(normal, wi);
                    if (emitted < 1e-3f || received(wi) < 1e-3f) continue;
                    ++shining;
                    EXPECT_GT(lights.placed->probability(static_cast<uint32_t>(lights.punctual.size()) + i, receiver),
                              0.0f);
                }
            }
        }
    }
    EXPECT_GT(shining, 100000);
}

TEST(LightTree, ANearLampIsChosenMoreOftenThanAFarOne) {
    Lights lights;
    for (int i = 0; i < 100; ++i) {
        PlacedLight light;
        light.position = Vec3(10 * i, 2, 0);
        light.direction = Vec3(0, -1, 0);
        lights.punctual.push_back(light);
    }
    finish_lights(lights, {{0, 0, -1}, {1000, 2, 1}});
    // By power it would be one in a hundred; by what arrives, 0.95. Without splitting, a tree gets part of the way.
    const LightReceiver receiver{Vec3(500, 0, 0), Vec3(0, 1, 0), false};
    EXPECT_GT(lights.placed->probability(50, receiver), 0.15f);
}

TEST(LightTree, WithoutLightItChoosesNone) {
    EXPECT_EQ(LightTree().sample({}, 0.5f).probability, 0.0f);
    const LightBounds dark;
    EXPECT_TRUE(LightTree(std::span(&dark, 1)).empty());
    EXPECT_EQ(LightTree(std::span(&dark, 1)).probability(0, {}), 0.0f);
}

}  // namespace
}  // namespace candela
