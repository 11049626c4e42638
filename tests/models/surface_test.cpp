// SPDX-License-Identifier: MIT
// What rays see of the shared models: where, which colour, which normal, against a second reading of the files.
// Attributes, primitive modes, node transforms, materials' factors and textures, samplers and texture transforms all
// show in it.
#include <fstream>

#include <gtest/gtest.h>

#include "renderer/integrator/aov.h"
#include "renderer/io/load_gltf.h"
#include "tests/models/plain_tracer.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using test::PlainAnswer;
using test::PlainTracer;
using test::RawGltf;
using test::SeenColor;

constexpr uint32_t side = 40;

// The scene as its bare colours: every material shows the one that is looked at, unlit.
std::shared_ptr<const World> world_of_colors(Scene scene, SeenColor seen) {
    // What has no material gets one that can be made unlit.
    const MaterialId plain_material{static_cast<uint32_t>(scene.materials.size())};
    scene.materials.emplace_back();
    for (std::shared_ptr<const Mesh>& mesh : scene.meshes) {
        auto copy = std::make_shared<Mesh>(*mesh);
        for (Primitive& primitive : copy->primitives) {
            if (!primitive.material.valid()) primitive.material = plain_material;
            if (seen == SeenColor::emitted) primitive.colors.clear();
        }
        mesh = copy;
    }
    for (Material& material : scene.materials) {
        material.unlit = true;
        if (material.alpha_mode == AlphaMode::blend || seen == SeenColor::emitted)
            material.alpha_mode = AlphaMode::opaque;
        if (seen == SeenColor::base) continue;
        material.base_color = material.emissive;
        material.base_color_factor = Vec4(material.emissive_factor * material.emissive_strength, 1);
    }
    return build_world(std::make_shared<const Scene>(std::move(scene)));
}

struct Seen {
    int compared = 0, uncertain = 0, colored = 0;
    int normals = 0;
};

// Rays of an orthographic camera that looks along `direction` at everything.
Seen compare(const std::filesystem::path& file, const RawGltf& gltf, const Scene& scene, SeenColor seen,
             const Vec3& direction) {
    const PlainTracer plain(gltf, scene, seen);
    const auto world = world_of_colors(scene, seen);
    const Bounds3 bounds = bounds_of(scene);
    const Vec3 center = 0.5f * (bounds.lower + bounds.upper);
    const float size = glm::length(bounds.upper - bounds.lower);
    View view;
    view.extent = Vec2u(side);
    view.camera.projection = Projection::orthographic;
    view.camera.ortho_half_height_m = 0.5f * size;
    view.camera.world_from_camera = look_at(center - size * glm::normalize(direction), center, Vec3(0, 1, 0));

    Seen out;
    for (uint32_t i = 0; i < side * side; ++i) {
        const Vec2 film_uv((static_cast<float>(i % side) + 0.493f) / side,
                           (static_cast<float>(i / side) + 0.507f) / side);
        const Ray ray = generate_ray(view.camera, 1, film_uv, Vec2(0.5f));
        const PlainAnswer expected = plain.trace(glm::dvec3(ray.origin), glm::dvec3(ray.direction));
        if (expected.is_uncertain || (expected.hit && expected.hit->color_tolerance > 0.05)) {
            ++out.uncertain;
            continue;
        }
        const FirstHit hit = trace_first_hit(*world, view, film_uv);
        SCOPED_TRACE(file.filename().string() + " ray " + std::to_string(i % side) + ", " + std::to_string(i / side));
        EXPECT_EQ(hit.hit, expected.hit.has_value());
        if (!hit.hit || !expected.hit) continue;
        ++out.compared;
        EXPECT_NEAR(hit.depth, expected.hit->distance, 2e-5 * static_cast<double>(size));
        const glm::dvec3 off = glm::abs(glm::dvec3(hit.albedo) - expected.hit->color);
        EXPECT_LE(std::max({off.r, off.g, off.b}), expected.hit->color_tolerance)
            << "red " << hit.albedo.r << " instead of " << expected.hit->color.r;
        out.colored += std::max({expected.hit->color.r, expected.hit->color.g, expected.hit->color.b}) > 0;

        // Normals, where nothing bends them: no map, and their mirror direction leaves the surface.
        const glm::dvec3 wo = -glm::dvec3(ray.direction), n = expected.hit->normal;
        const glm::dvec3 mirrored = 2 * glm::dot(n, wo) * n - wo;
        if (expected.hit->has_normal_map || glm::dot(n, wo) < 0.1 ||
            glm::dot(mirrored, expected.hit->geometric_normal) < 0.1)
            continue;
        ++out.normals;
        EXPECT_LT(glm::distance(glm::dvec3(hit.normal), n), 2e-4);
    }
    return out;
}

bool lists(const RawGltf::Json& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(Surfaces, AreWhatTheFilesSay) {
    std::ifstream stream(test::shared_data() / "manifest.json");
    if (!stream) GTEST_SKIP() << "skipped: no shared data";
    const RawGltf::Json manifest = RawGltf::Json::parse(stream);
    int models = 0, of_the_asset_generator = 0, emitting = 0, with_normals = 0;
    for (const RawGltf::Json& entry : manifest["files"]) {
        const std::string path = entry["path"];
        if (entry["kind"] != "model" || entry["triangles"] > 8000 || entry["triangles"] == 0) continue;
        bool is_readable = true;
        for (const char* extension :
             {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing"})
            is_readable = is_readable && !lists(entry["extensionsUsed"], extension);
        const RawGltf gltf(test::shared_data() / path);
        if (!is_readable || !PlainTracer::can_read(gltf) ||
            lists(entry["extensionsRequired"], "FAKE_materials_quantumRendering"))
            continue;
        Diagnostics diagnostics;
        const Scene scene = load_gltf(test::shared_data() / path, diagnostics, {});
        const Seen base = compare(path, gltf, scene, SeenColor::base, Vec3(-0.21f, -0.13f, -1));
        EXPECT_GT(base.compared, 100) << path;
        EXPECT_LT(base.uncertain, base.compared) << path;
        with_normals += base.normals > 50;
        const bool emits = std::any_of(scene.materials.begin(), scene.materials.end(),
                                       [](const Material& m) { return max_component(m.emissive_factor) > 0; });
        if (emits) {
            const Seen emitted = compare(path, gltf, scene, SeenColor::emitted, Vec3(0.31f, -0.4f, -1));
            emitting += emitted.colored > 0;
        }
        ++models;
        of_the_asset_generator += path.find("AssetGenerator/") != std::string::npos;
    }
    EXPECT_GE(models, 40);
    EXPECT_GE(of_the_asset_generator, 25);
    EXPECT_GE(with_normals, 50);
    EXPECT_GE(emitting, 4);
}

}  // namespace
}  // namespace candela
