// SPDX-License-Identifier: MIT
// What a ray sees of a model, worked out once more from the file's own numbers: every triangle is tried, in double
// precision, and textures are read as the samplers say. No skins, morph targets or compression.
#pragma once

#include <optional>

#include "renderer/scene/scene.h"
#include "tests/io/raw_gltf.h"

namespace candela::test {

// Which colours of the materials are looked at. Of the base colour, blending counts as opaque and masks decide; for the
// emission all is opaque.
enum class SeenColor : uint8_t { base, emitted };

struct PlainHit {
    double distance = 0;
    glm::dvec3 color{0};   // linear
    glm::dvec3 normal{0};  // unit, interpolated from the file's or, where there are none, the triangle's
    glm::dvec3 geometric_normal{0};
    bool has_normal_map = false;
    double color_tolerance = 0;  // how far the colour moves where texture coordinates are rounded
};

struct PlainAnswer {
    std::optional<PlainHit> hit;  // none: the ray misses everything
    bool is_uncertain = false;    // an edge, two surfaces in one place, or the edge of a mask decide
};

class PlainTracer {
  public:
    // Decoded pictures are taken from the scene; everything else from the file.
    PlainTracer(const RawGltf& gltf, const Scene& scene, SeenColor seen);

    // Whether the file holds nothing that is beyond this tracer.
    static bool can_read(const RawGltf& gltf);

    PlainAnswer trace(const glm::dvec3& origin, const glm::dvec3& direction) const;

  private:
    using Json = RawGltf::Json;

    struct Triangle {
        glm::dvec3 corners[3], normals[3];
        glm::dvec2 uv[3];  // of the seen texture, its transform applied
        glm::dvec4 colors[3];
        uint32_t material = 0;
        bool has_normals = false;
    };
    struct SeenMaterial {
        glm::dvec4 factor{1};
        const ImageRgba8* image = nullptr;
        int wrap_s = 10497, wrap_t = 10497;
        bool nearest = false;
        double cutoff = -1;  // -1: no mask
        bool has_normal_map = false;
        size_t uv_set = 0;
        glm::dmat3x2 uv_transform{1, 0, 0, 1, 0, 0};
    };

    SeenMaterial read_material(const Json& material, const Scene& scene) const;
    void add_node(size_t index, const glm::dmat4& world_from_parent);
    void add_primitive(const Json& primitive, const glm::dmat4& world_from_object);
    static glm::dvec4 texel(const SeenMaterial& material, const glm::dvec2& uv);

    const RawGltf& gltf_;
    SeenColor seen_;
    std::vector<SeenMaterial> materials_;  // the file's, and the default one
    std::vector<Triangle> triangles_;
};

}  // namespace candela::test
