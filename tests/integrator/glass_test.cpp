// SPDX-License-Identifier: MIT
// Interfaces and media against exact answers: what a slab reflects, lets through, absorbs and displaces; glass in a
// furnace; bodies in bodies; light found through panes.
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/sampling/wavelength.h"
#include "tests/support/measure.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

using namespace test;

MaterialId add_glass(Scene& scene, float ior, float roughness = 0, bool thin = false) {
    Material glass;
    glass.metallic_factor = 0;
    glass.roughness_factor = roughness;
    glass.ior = ior;
    glass.transmission.factor = 1;
    glass.volume.thickness_factor = thin ? 0.0f : 1.0f;
    scene.materials.push_back(glass);
    return {static_cast<uint32_t>(scene.materials.size() - 1)};
}

Material& material(Scene& scene, MaterialId id) {
    return scene.materials[id.value];
}

// A box as one mesh with flat faces.
Primitive make_box(const Vec3& lower, const Vec3& upper) {
    const Vec3 d = upper - lower;
    const Vec3 x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
    Primitive out;
    out.flat_normals = true;
    for (const Primitive& side : {make_quad(lower, y, x), make_quad(lower + z, x, y), make_quad(lower, z, y),
                                  make_quad(lower + x, y, z), make_quad(lower, x, z), make_quad(lower + y, z, x)}) {
        const auto first = static_cast<uint32_t>(out.positions.size());
        out.positions.insert(out.positions.end(), side.positions.begin(), side.positions.end());
        for (const Vec3u& t : side.triangles)
            out.triangles.push_back(t + first);
    }
    return out;
}

// A lamp of radiance 1 that faces +z, far behind everything.
void add_lamp_behind(Scene& scene, float z) {
    add_object(scene, make_quad(Vec3(-50, -50, z), Vec3(100, 0, 0), Vec3(0, 100, 0)), add_emitter(scene, Vec3(1)));
}

// Looks along -z from the front, off the axes so that no ray meets a diagonal.
View look_along_z(float tilt = 0) {
    const Vec3 target(0.123f, 0.234f, 0.5f);
    return look_at_point(target + Vec3(3 * std::sin(tilt), 0, 3 * std::cos(tilt)), target, Vec3(0, 1, 0));
}

TEST(Glass, ClearSlabLetsThroughWhatAllInterreflectionsLeave) {
    Scene scene;
    add_object(scene, make_box(Vec3(-20, -20, -0.5f), Vec3(20, 20, 0.5f)), add_glass(scene, 1.5f));
    add_lamp_behind(scene, -5);
    const auto world = build(std::move(scene));
    // T = (1 − F₀)/(1 + F₀)
    for (const Technique& technique : all_techniques)
        expect_exact(measure(*world, look_along_z(), technique, 32, 8192), 0.9230769, 1e-3, describe(technique));
}

TEST(Glass, ClearSlabReflectsTheRest) {
    Scene scene;
    add_object(scene, make_box(Vec3(-20, -20, -0.5f), Vec3(20, 20, 0.5f)), add_glass(scene, 1.5f));
    // A lamp before the slab, seen in it; the eye stands between.
    add_object(scene, make_quad(Vec3(-50, 50, 9), Vec3(100, 0, 0), Vec3(0, -100, 0)), add_emitter(scene, Vec3(1)));
    const auto world = build(std::move(scene));
    expect_exact(measure(*world, look_along_z(), {}, 128, 32768), 0.0769231, 2e-3, "R = 2 F0 / (1 + F0)");
}

TEST(Glass, AbsorbingSlabFollowsBeerLambert) {
    for (const float ior : {1.0f, 1.5f}) {
        Scene scene;
        const MaterialId glass = add_glass(scene, ior);
        material(scene, glass).volume.attenuation_color = Vec3(0.25f);
        material(scene, glass).volume.attenuation_distance_m = 2;
        add_object(scene, make_box(Vec3(-20, -20, -0.5f), Vec3(20, 20, 0.5f)), glass);
        add_lamp_behind(scene, -5);
        const auto world = build(std::move(scene));
        const double f = std::pow((static_cast<double>(ior) - 1) / (static_cast<double>(ior) + 1), 2);
        const double tau = std::sqrt(0.25);
        const double exact = (1 - f) * (1 - f) * tau / (1 - f * f * tau * tau);
        for (const Technique& technique : all_techniques)
            expect_exact(measure(*world, look_along_z(), technique, 32, 8192), exact, 1e-3,
                         "ior " + std::to_string(ior) + " " + describe(technique));
    }
}

TEST(Glass, SlabShiftsARayBySnellsLaw) {
    // Behind the slab a lamp covers only x below an edge. The edge of what is seen moves by the slab's shift.
    constexpr double n = 1.5, theta = 0.7, thickness = 1.0;
    const double sine = std::sin(theta), cosine = std::cos(theta);
    const double shift = thickness * sine * (1 - cosine / std::sqrt(n * n - sine * sine));
    Scene scene;
    add_object(scene, make_box(Vec3(-20, -20, -0.5f), Vec3(20, 20, 0.5f)), add_glass(scene, 1.5f));
    const auto edge = 0.123f;
    add_object(scene, make_quad(Vec3(-50, -50, -2), Vec3(50 + edge, 0, 0), Vec3(0, 100, 0)),
               add_emitter(scene, Vec3(1)));
    const auto world = build(std::move(scene));
    RayCounts counts;
    IntegratorSettings settings;
    settings.filter = PixelFilter::box;
    // Bisect for the sideways start at which the lamp appears.
    const Vec3 along(-static_cast<float>(sine), 0, -static_cast<float>(cosine)),
        across(static_cast<float>(cosine), 0, -static_cast<float>(sine));
    const auto sees_lamp = [&](double offset) {
        View view;
        const Vec3 at = Vec3(edge, 0.234f, -2) + static_cast<float>(offset) * across;
        view.camera.world_from_camera = look_at(at - 6.0f * along, at, Vec3(0, 1, 0));
        view.camera.projection = Projection::orthographic;
        view.camera.ortho_half_height_m = 1e-6f;
        for (uint32_t i = 0; i < 64; ++i) {
            if (trace_sample(*world, view, settings, {0, 0, i}, counts).radiance.y > 0) return true;
        }
        return false;
    };
    double low = -2, high = 2;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (sees_lamp(middle) ? low : high) = middle;
    }
    EXPECT_NEAR(std::abs(low), shift, 1e-4);
}

// The whole of a lossless scene in a furnace shows the furnace's radiance.
void expect_furnace(Scene scene, const std::string& what, uint32_t samples) {
    scene.environment = constant_environment(Vec3(1));
    const auto world = build(std::move(scene));
    const View view = look_at_point(Vec3(0.31f, 0.22f, 5), Vec3(0.31f, 0.22f, 0), Vec3(0, 1, 0));
    for (const Technique& technique : all_techniques)
        expect_exact(measure(*world, view, technique, 32, samples), 1.0, 1e-3, what + ", " + describe(technique));
}

Primitive flat_sphere(float radius, bool inside_out = false) {
    Primitive sphere = make_sphere(Vec3(0), radius, 48, 24, inside_out);
    sphere.normals.clear();
    sphere.flat_normals = true;
    return sphere;
}

TEST(Glass, FurnaceWithAGlassBallReadsOne) {
    for (const float ior : {1.0f, 1.33f, 1.5f, 2.4f}) {
        Scene scene;
        add_object(scene, flat_sphere(1), add_glass(scene, ior));
        expect_furnace(std::move(scene), "ball of index " + std::to_string(ior), 4096);
    }
}

TEST(Glass, FurnaceWithAWhiteBallInAGlassShellReadsOne) {
    Scene scene;
    const MaterialId glass = add_glass(scene, 1.5f);
    Primitive shell = flat_sphere(1), hollow = flat_sphere(0.9f, true);
    const auto first = static_cast<uint32_t>(shell.positions.size());
    shell.positions.insert(shell.positions.end(), hollow.positions.begin(), hollow.positions.end());
    for (const Vec3u& t : hollow.triangles)
        shell.triangles.push_back(t + first);
    add_object(scene, std::move(shell), glass);
    add_object(scene, flat_sphere(0.6f), add_lambert(scene, Vec3(1)));
    expect_furnace(std::move(scene), "white ball in a shell", 8192);
}

TEST(Glass, FurnaceWithADrinkInAGlassReadsOne) {
    // The drink overlaps the glass, ice swims in the drink: four indices meet, two boundaries are hidden.
    Scene scene;
    const MaterialId glass = add_glass(scene, 1.5f), water = add_glass(scene, 1.33f), ice = add_glass(scene, 1.31f);
    add_object(scene, make_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), glass);
    add_object(scene, make_box(Vec3(-0.8f, -0.7f, -0.75f), Vec3(0.85f, 0.8f, 0.9f)), water);
    add_object(scene, make_box(Vec3(-0.2f, -0.1f, -0.15f), Vec3(0.45f, 0.4f, 0.35f)), ice);
    add_object(scene, flat_sphere(0.1f), add_lambert(scene, Vec3(1)));
    expect_furnace(std::move(scene), "drink", 8192);
}

TEST(Glass, NestedBodiesReflectByTheIndicesThatMeet) {
    // Water fills a block of glass up to a face inside it: seen through, T is the product of the three interfaces'
    // transmittances up to interreflections, which are summed here layer by layer.
    Scene scene;
    add_object(scene, make_box(Vec3(-20, -20, -1), Vec3(20, 20, 1)), add_glass(scene, 1.6f));
    add_object(scene, make_box(Vec3(-19, -19, -0.5f), Vec3(19, 19, 0.5f)), add_glass(scene, 1.3f));
    add_lamp_behind(scene, -5);
    const auto world = build(std::move(scene));
    const auto interface = [](double a, double b) { return std::pow((a - b) / (a + b), 2); };
    // Incoherent sum: a stack of two layers has R = R1 + T1² R2 / (1 − R1 R2), T = T1 T2 / (1 − R1 R2).
    double r = 0, t = 1;
    for (const double f : {interface(1, 1.6), interface(1.6, 1.3), interface(1.3, 1.6), interface(1.6, 1)}) {
        const double back = r;  // the stack so far is symmetric enough: all lossless, its R is the same from behind
        const double new_t = t * (1 - f) / (1 - back * f);
        r = 1 - new_t;
        t = new_t;
    }
    expect_exact(measure(*world, look_along_z(), {}, 32, 16384), t, 1e-3, "glass, water, glass");
}

TEST(Glass, WhereBodiesOverlapTheSmallerOneIsThere) {
    // A slab of absorbing glass and a smaller clear one that reaches 0.2 into it: the glass ends where the other
    // begins, whichever of the two a ray enters first.
    for (const int order : {0, 1, 2, 3}) {
        const bool small_one_first = order % 2 == 1, from_behind = order >= 2;
        const auto slab = [&](float size, float z0, float z1) {
            return from_behind ? make_box(Vec3(-size, -size, -z1), Vec3(size, size, -z0))
                               : make_box(Vec3(-size, -size, z0), Vec3(size, size, z1));
        };
        Scene scene;
        const MaterialId tinted = add_glass(scene, 1.6f), clear = add_glass(scene, 1.3f);
        material(scene, tinted).volume.attenuation_color = Vec3(0.5f);
        material(scene, tinted).volume.attenuation_distance_m = 1;
        const auto add_small = [&] { add_object(scene, slab(19, 0, 1), clear); };
        if (small_one_first) add_small();
        add_object(scene, slab(20, -1, 0.2f), tinted);
        if (!small_one_first) add_small();
        add_lamp_behind(scene, -5);
        const auto world = build(std::move(scene));
        // Either way through the stack is as good: light crosses 1.6|1, 1 unit of tint, 1.3|1.6, 1|1.3. Layers add up
        // as R₁ + T₁²R₂/(1 − R₁′R₂).
        const auto reflectance = [](double a, double b) { return std::pow((a - b) / (a + b), 2); };
        double r_back = reflectance(1.6, 1), t = 1 - r_back;
        const double tint = 0.5;
        t *= tint;
        r_back *= tint * tint;  // seen through the tint
        for (const double f : {reflectance(1.3, 1.6), reflectance(1, 1.3)}) {
            const double next_t = t * (1 - f) / (1 - r_back * f);
            r_back = f + (1 - f) * (1 - f) * r_back / (1 - r_back * f);
            t = next_t;
        }
        expect_exact(measure(*world, look_along_z(), {}, 32, 16384), t, 1e-3, "order " + std::to_string(order));
    }
}

TEST(Glass, HiddenBoundariesHideNoLight) {
    // A plane and a lamp inside one body, and between them the face of another that the first hides.
    const auto scene_with = [](bool bodies) {
        Scene scene;
        add_object(scene, make_quad(Vec3(-2, -2, -1), Vec3(4, 0, 0), Vec3(0, 4, 0)), add_lambert(scene, Vec3(1)));
        add_object(scene, make_quad(Vec3(-1, 1, 1), Vec3(2, 0, 0), Vec3(0, -2, 0)), add_emitter(scene, Vec3(1)));
        if (bodies) {
            add_object(scene, make_box(Vec3(-5, -5, -3), Vec3(5, 5, 3)), add_glass(scene, 1));
            add_object(scene, make_box(Vec3(-9, -9, -4), Vec3(9, 9, 0)), add_glass(scene, 1));
        }
        return build(std::move(scene));
    };
    const View view = look_at_point(Vec3(2.9f, 0.2f, 3.5f), Vec3(0.3f, 0.2f, -1), Vec3(0, 1, 0));
    const BatchMeans bare = measure(*scene_with(false), view, {}, 32, 4096);
    const auto world = scene_with(true);
    for (const Technique& technique : all_techniques) {
        const BatchMeans means = measure(*world, view, technique, 32, 4096);
        EXPECT_NEAR(means.mean(), bare.mean(), 4 * std::hypot(means.standard_error(), bare.standard_error()))
            << describe(technique);
        EXPECT_LT(means.standard_error(), 0.02 * bare.mean());
    }
}

TEST(Glass, FurnaceWithRoughGlassReadsOneToItsTable) {
    for (const float roughness : {0.3f, 0.6f}) {
        Scene scene;
        add_object(scene, flat_sphere(1), add_glass(scene, 1.5f, roughness));
        scene.environment = constant_environment(Vec3(1));
        const auto world = build(std::move(scene));
        const View view = look_at_point(Vec3(0.31f, 0.22f, 5), Vec3(0.31f, 0.22f, 0), Vec3(0, 1, 0));
        for (const Technique& technique : all_techniques) {
            // Sampled lights alone find a narrow lobe too rarely to say anything.
            if (technique.estimator == Estimator::light) continue;
            const BatchMeans means = measure(*world, view, technique, 32, 4096);
            // The table is within half a percent of the integral at each of the two or three surfaces met.
            EXPECT_NEAR(means.mean(), 1.0, 4 * means.standard_error() + 1e-2) << roughness << describe(technique);
            EXPECT_LT(means.standard_error(), 3e-3);
        }
    }
}

TEST(Glass, LampsAreFoundThroughThinPanes) {
    // Two tinted panes between a plane and a small lamp, straight and tilted: all estimators agree, and next-event
    // estimation is not blind.
    Scene scene;
    add_object(scene, make_quad(Vec3(-9, 0, 9), Vec3(18, 0, 0), Vec3(0, 0, -18)), add_lambert(scene, Vec3(1)));
    const MaterialId pane = add_glass(scene, 1.5f, 0, true);
    material(scene, pane).base_color_factor = Vec4(0.8f, 0.8f, 0.8f, 1);
    add_object(scene, make_quad(Vec3(-30, 0.5f, 31), Vec3(60, 0, 0), Vec3(0, 0, -62)), pane);
    add_object(scene, make_quad(Vec3(-30, -5, 33), Vec3(60, 12, 0), Vec3(0, 0, -66)), pane);
    add_object(scene, make_quad(Vec3(-0.5f, 2, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1)), add_emitter(scene, Vec3(1)));
    const auto world = build(std::move(scene));
    const View view = look_at_point(Vec3(0.2f, 0.3f, 0.3f), Vec3(0.1f, 0, 0.05f), Vec3(0, 1, 0));
    const BatchMeans light = measure(*world, view, {Estimator::light}, 64, 4096);
    const BatchMeans bsdf = measure(*world, view, {Estimator::bsdf}, 64, 8192);
    const BatchMeans mis = measure(*world, view, {Estimator::mis}, 64, 4096);
    EXPECT_LT(light.standard_error(), 2e-3 * light.mean());
    EXPECT_LT(bsdf.standard_error(), 1e-2 * bsdf.mean());
    EXPECT_NEAR(light.mean(), bsdf.mean(), 4 * std::hypot(light.standard_error(), bsdf.standard_error()));
    EXPECT_NEAR(mis.mean(), bsdf.mean(), 4 * std::hypot(mis.standard_error(), bsdf.standard_error()));
}

TEST(Glass, OnePaneDimsALampByItsTransmittance) {
    // A directional light straight down through a pane: what the plane shows is exact.
    Scene scene;
    add_object(scene, make_quad(Vec3(-9, 0, 9), Vec3(18, 0, 0), Vec3(0, 0, -18)),
               add_lambert(scene, Vec3(0.0f, 0.5f, 0)));
    const MaterialId pane = add_glass(scene, 1.5f, 0, true);
    material(scene, pane).base_color_factor = Vec4(0.5f, 0.5f, 0.5f, 1);
    add_object(scene, make_quad(Vec3(-30, 0.5f, 31), Vec3(60, 0, 0), Vec3(0, 0, -62)), pane);
    PunctualLight light;
    light.kind = LightKind::directional;
    light.intensity = pi;
    scene.lights.push_back(light);
    scene.light_instances.push_back({{0}, {0}, glm::rotate(Mat4(1), -pi / 2, Vec3(1, 0, 0))});
    const auto world = build(std::move(scene));
    RayCounts counts;
    IntegratorSettings settings;
    settings.max_depth = 1;
    settings.filter = PixelFilter::box;
    const View view = look_at_point(Vec3(0.2f, 0.3f, 0.3f), Vec3(0.1f, 0, 0.05f), Vec3(0, 1, 0));
    const Vec3 seen = trace_sample(*world, view, settings, {0, 0, 0}, counts).radiance;
    EXPECT_NEAR(seen.y, 0.5f * 0.96f * 0.5f, 1e-5f);
}

TEST(Glass, DiffuseTransmissionLightsTheOtherSide) {
    // A leaf before a lamp: radiance ρ_t L for a plane under a half-space of constant radiance from behind.
    Scene scene;
    const MaterialId leaf = add_lambert(scene, Vec3(0.5f));
    material(scene, leaf).diffuse_transmission.factor = 0.25f;
    material(scene, leaf).diffuse_transmission.color_factor = Vec3(0.8f);
    add_object(scene, make_quad(Vec3(-1, -1, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)), leaf);
    scene.environment = constant_environment(Vec3(2));
    const auto world = build(std::move(scene));
    for (const Technique& technique : all_techniques) {
        expect_exact(measure(*world, look_along_z(0.3f), technique, 32, 8192), 2 * (0.75 * 0.5 + 0.25 * 0.8), 1e-3,
                     describe(technique));
    }
}

TEST(Glass, DispersionBendsBlueMoreThanRed) {
    // Through a tilted slab, at the edge of the lamp where the d line just sees it.
    constexpr double n = 1.6, theta = 0.7;
    const double sine = std::sin(theta), cosine = std::cos(theta);
    const double shift = 10 * sine * (1 - cosine / std::sqrt(n * n - sine * sine));
    Scene scene;
    const MaterialId flint = add_glass(scene, 1.6f);
    material(scene, flint).volume.dispersion = 1;
    add_object(scene, make_box(Vec3(-90, -90, -5), Vec3(90, 90, 5)), flint);
    add_object(scene, make_quad(Vec3(-50, -50, -7), Vec3(50, 0, 0), Vec3(0, 100, 0)), add_emitter(scene, Vec3(1)));
    const auto world = build(std::move(scene));
    const Vec3 along(-static_cast<float>(sine), 0, -static_cast<float>(cosine)),
        across(static_cast<float>(cosine), 0, -static_cast<float>(sine));
    IntegratorSettings settings;
    settings.filter = PixelFilter::box;
    RayCounts counts;
    const auto seen_at = [&](double offset) {
        const Vec3 at = Vec3(0, 0.234f, -7) + static_cast<float>(offset) * across;
        const View view = look_at_point(at - 30.0f * along, at, Vec3(0, 1, 0));
        glm::dvec3 sum(0);
        for (uint32_t i = 0; i < 16384; ++i)
            sum += glm::dvec3(trace_sample(*world, view, settings, {0, 0, i}, counts).radiance) / 16384.0;
        return sum;
    };
    // The slab moves what is seen towards one side: by sign, the one where the edge appears.
    const glm::dvec3 one = seen_at(shift), other = seen_at(-shift);
    const bool takes_one = std::abs(one.x - one.z) > std::abs(other.x - other.z);
    const glm::dvec3 edge = takes_one ? one : other;
    EXPECT_GT(std::abs(edge.z - edge.x), 0.5) << edge.x << " " << edge.y << " " << edge.z;
    // A step further in or out of the lamp all colours agree.
    for (const double step : {-0.5, 0.5}) {
        const glm::dvec3 away = seen_at((takes_one ? shift : -shift) + step);
        EXPECT_NEAR(away.x, away.z, 0.02) << step;
    }
}

TEST(Glass, DispersionKeepsWhiteWhite) {
    Scene scene;
    const MaterialId prism = add_glass(scene, 1.6f);
    material(scene, prism).volume.dispersion = 1;
    add_object(scene, flat_sphere(1), prism);
    scene.environment = constant_environment(Vec3(1));
    const auto world = build(std::move(scene));
    const View view = look_at_point(Vec3(0.31f, 0.22f, 5), Vec3(0.31f, 0.22f, 0), Vec3(0, 1, 0));
    IntegratorSettings settings;
    settings.filter = PixelFilter::box;
    RayCounts counts;
    BatchMeans red, green, blue;
    for (uint32_t seed = 0; seed < 32; ++seed) {
        settings.seed = seed;
        glm::dvec3 sum(0);
        for (uint32_t i = 0; i < 4096; ++i)
            sum += glm::dvec3(trace_sample(*world, view, settings, {0, 0, i}, counts).radiance);
        red.add(sum.x / 4096);
        green.add(sum.y / 4096);
        blue.add(sum.z / 4096);
    }
    expect_exact(red, 1, 5e-3, "red");
    expect_exact(green, 1, 5e-3, "green");
    expect_exact(blue, 1, 5e-3, "blue");
}

}  // namespace
}  // namespace candela
