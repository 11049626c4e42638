// SPDX-License-Identifier: MIT
#include "tests/models/plain_tracer.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace candela::test {
namespace {

using glm::dmat3;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using Json = RawGltf::Json;

dmat4 transform_of(const Json& node) {
    if (node.contains("matrix")) {
        const std::vector<double> m = node["matrix"];
        return glm::make_mat4(m.data());
    }
    const std::vector<double> t = node.value("translation", std::vector<double>{0, 0, 0});
    const std::vector<double> r = node.value("rotation", std::vector<double>{0, 0, 0, 1});
    const std::vector<double> s = node.value("scale", std::vector<double>{1, 1, 1});
    return glm::translate(dmat4(1), dvec3(t[0], t[1], t[2])) *
           glm::mat4_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2]))) *
           glm::scale(dmat4(1), dvec3(s[0], s[1], s[2]));
}

double linear_from_srgb(double s) {
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// Where a texel lies that may be outside of the picture.
int wrapped(int i, int size, int mode) {
    constexpr int clamp_to_edge = 33071, mirrored_repeat = 33648;
    if (mode == clamp_to_edge) return std::clamp(i, 0, size - 1);
    const int tile = i >= 0 ? i / size : -((size - 1 - i) / size);
    const int inside = i - tile * size;
    return mode == mirrored_repeat && tile % 2 != 0 ? size - 1 - inside : inside;
}

}  // namespace

bool PlainTracer::can_read(const RawGltf& gltf) {
    if (gltf.json.contains("skins")) return false;
    for (const Json& mesh : gltf.json.value("meshes", Json::array())) {
        for (const Json& primitive : mesh["primitives"]) {
            const int mode = primitive.value("mode", 4);
            if (primitive.contains("targets") || mode < 4) return false;
        }
    }
    return true;
}

PlainTracer::PlainTracer(const RawGltf& gltf, const Scene& scene, SeenColor seen) : gltf_(gltf), seen_(seen) {
    for (const Json& material : gltf.json.value("materials", Json::array()))
        materials_.push_back(read_material(material, scene));
    materials_.push_back(read_material(Json::object(), scene));
    const Json& roots = gltf.json["scenes"][gltf.json.value("scene", size_t{0})]["nodes"];
    for (const Json& root : roots)
        add_node(root, dmat4(1));
}

PlainTracer::SeenMaterial PlainTracer::read_material(const Json& material, const Scene& scene) const {
    SeenMaterial out;
    Json texture;
    const Json extensions = material.value("extensions", Json::object());
    if (seen_ == SeenColor::emitted) {
        const std::vector<double> factor = material.value("emissiveFactor", std::vector<double>{0, 0, 0});
        out.factor = dvec4(factor[0], factor[1], factor[2], 1);
        if (extensions.contains("KHR_materials_emissive_strength")) {
            out.factor *= extensions["KHR_materials_emissive_strength"].value("emissiveStrength", 1.0);
        }
        texture = material.value("emissiveTexture", Json());
    } else {
        const bool glossy = extensions.contains("KHR_materials_pbrSpecularGlossiness");
        const Json base = glossy ? extensions["KHR_materials_pbrSpecularGlossiness"]
                                 : material.value("pbrMetallicRoughness", Json::object());
        const std::vector<double> factor =
            base.value(glossy ? "diffuseFactor" : "baseColorFactor", std::vector<double>{1, 1, 1, 1});
        out.factor = glm::make_vec4(factor.data());
        texture = base.value(glossy ? "diffuseTexture" : "baseColorTexture", Json());
        if (material.value("alphaMode", "OPAQUE") == "MASK") out.cutoff = material.value("alphaCutoff", 0.5);
    }
    out.has_normal_map = material.contains("normalTexture");
    if (texture.is_null()) return out;

    // The texture's picture, that of an extension before the one that everybody knows.
    const Json& used = gltf_.json["textures"][texture["index"].get<size_t>()];
    Json source = used.value("source", Json());
    const Json others = used.value("extensions", Json::object());
    for (const auto& [name, extension] : others.items())
        source = extension.value("source", source);
    if (!source.is_null()) out.image = scene.images.at(source.get<size_t>()).pixels.get();
    if (used.contains("sampler")) {
        const Json& sampler = gltf_.json["samplers"][used["sampler"].get<size_t>()];
        out.wrap_s = sampler.value("wrapS", 10497);
        out.wrap_t = sampler.value("wrapT", 10497);
        out.nearest = sampler.value("magFilter", 9729) == 9728;
    }

    // KHR_texture_transform: scaled, turned, moved, in this order.
    out.uv_set = texture.value("texCoord", size_t{0});
    const Json more = texture.value("extensions", Json::object());
    if (more.contains("KHR_texture_transform")) {
        const Json& transform = more["KHR_texture_transform"];
        const std::vector<double> offset = transform.value("offset", std::vector<double>{0, 0});
        const std::vector<double> scale = transform.value("scale", std::vector<double>{1, 1});
        const double angle = transform.value("rotation", 0.0);
        out.uv_transform[0] = scale[0] * dvec2(std::cos(angle), -std::sin(angle));
        out.uv_transform[1] = scale[1] * dvec2(std::sin(angle), std::cos(angle));
        out.uv_transform[2] = dvec2(offset[0], offset[1]);
        out.uv_set = transform.value("texCoord", out.uv_set);
    }
    return out;
}

void PlainTracer::add_node(size_t index, const dmat4& world_from_parent) {
    const Json& node = gltf_.json["nodes"][index];
    const dmat4 world = world_from_parent * transform_of(node);
    if (node.contains("mesh")) {
        for (const Json& primitive : gltf_.json["meshes"][node["mesh"].get<size_t>()]["primitives"])
            add_primitive(primitive, world);
    }
    for (const Json& child : node.value("children", Json::array()))
        add_node(child, world);
}

void PlainTracer::add_primitive(const Json& primitive, const dmat4& world_from_object) {
    const Json& attributes = primitive["attributes"];
    const auto material = static_cast<uint32_t>(primitive.value("material", materials_.size() - 1));
    const SeenMaterial& seen = materials_[material];
    const std::vector<dvec3> positions = gltf_.read3(attributes["POSITION"]);
    std::vector<dvec3> normals;
    if (attributes.contains("NORMAL")) normals = gltf_.read3(attributes["NORMAL"]);
    std::vector<double> uv, colors;
    const std::string uv_name = "TEXCOORD_" + std::to_string(seen.uv_set);
    if (attributes.contains(uv_name)) uv = gltf_.read(attributes[uv_name]);
    if (attributes.contains("COLOR_0") && seen_ == SeenColor::base) colors = gltf_.read(attributes["COLOR_0"]);
    const size_t channels = colors.size() / positions.size();

    std::vector<size_t> order;
    if (primitive.contains("indices")) {
        for (const double i : gltf_.read(primitive["indices"]))
            order.push_back(static_cast<size_t>(i));
    } else {
        for (size_t i = 0; i < positions.size(); ++i)
            order.push_back(i);
    }
    const int mode = primitive.value("mode", 4);
    const size_t count = mode == 4 ? order.size() / 3 : order.size() - 2;
    const dmat3 normal_map = glm::transpose(glm::inverse(dmat3(world_from_object)));
    for (size_t t = 0; t < count; ++t) {
        size_t corners[3] = {3 * t, 3 * t + 1, 3 * t + 2};
        if (mode == 5) {
            corners[0] = t;
            corners[1] = t + 1 + t % 2;
            corners[2] = t + 2 - t % 2;
        }
        if (mode == 6) {
            corners[0] = t + 1;
            corners[1] = t + 2;
            corners[2] = 0;
        }
        Triangle& out = triangles_.emplace_back();
        out.material = material;
        out.has_normals = !normals.empty();
        for (size_t c = 0; c < 3; ++c) {
            const size_t i = order.at(corners[c]);
            out.corners[c] = dvec3(world_from_object * dvec4(positions[i], 1));
            if (out.has_normals) out.normals[c] = glm::normalize(normal_map * glm::normalize(normals[i]));
            const dvec2 plain = uv.empty() ? dvec2(0) : dvec2(uv[2 * i], uv[2 * i + 1]);
            out.uv[c] = seen.uv_transform * dvec3(plain, 1);
            out.colors[c] = dvec4(1);
            for (size_t k = 0; k < channels; ++k)
                out.colors[c][static_cast<int>(k)] = colors[channels * i + k];
        }
    }
}

dvec4 PlainTracer::texel(const SeenMaterial& material, const dvec2& uv) {
    if (material.image == nullptr) return dvec4(1);
    const ImageRgba8& image = *material.image;
    const auto fetch = [&](double column, double row) {
        const Rgba8 p = image(wrapped(static_cast<int>(column), image.width(), material.wrap_s),
                              wrapped(static_cast<int>(row), image.height(), material.wrap_t));
        return dvec4(linear_from_srgb(p.r / 255.0), linear_from_srgb(p.g / 255.0), linear_from_srgb(p.b / 255.0),
                     p.a / 255.0);
    };
    const dvec2 at = uv * dvec2(image.width(), image.height());
    if (material.nearest) return fetch(std::floor(at.x), std::floor(at.y));
    const dvec2 corner = glm::floor(at - 0.5), share = at - 0.5 - corner;
    return glm::mix(glm::mix(fetch(corner.x, corner.y), fetch(corner.x + 1, corner.y), share.x),
                    glm::mix(fetch(corner.x, corner.y + 1), fetch(corner.x + 1, corner.y + 1), share.x), share.y);
}

PlainAnswer PlainTracer::trace(const dvec3& origin, const dvec3& direction) const {
    struct Met {
        double distance = 0;
        dvec3 weights{0};
        const Triangle* triangle = nullptr;
    };
    constexpr double edge = 1e-4;  // of a triangle's height: hit or missed by rounding

    // All triangles that the ray meets, those too that it just misses (Möller and Trumbore 1997).
    std::vector<Met> met;
    for (const Triangle& triangle : triangles_) {
        const dvec3 edge1 = triangle.corners[1] - triangle.corners[0],
                    edge2 = triangle.corners[2] - triangle.corners[0];
        const dvec3 p = glm::cross(direction, edge2), s = origin - triangle.corners[0];
        const double determinant = glm::dot(p, edge1);
        if (std::abs(determinant) < 1e-6 * glm::length(edge1) * glm::length(edge2)) continue;
        const double u = glm::dot(p, s) / determinant;
        if (!(u > -edge && u < 1 + edge)) continue;
        const dvec3 q = glm::cross(s, edge1);
        const double v = glm::dot(q, direction) / determinant;
        if (!(v > -edge && u + v < 1 + edge)) continue;
        met.push_back({glm::dot(q, edge2) / determinant, dvec3(1 - u - v, u, v), &triangle});
    }
    std::sort(met.begin(), met.end(), [](const Met& a, const Met& b) { return a.distance < b.distance; });

    PlainAnswer out;
    for (size_t i = 0; i < met.size(); ++i) {
        const Triangle& triangle = *met[i].triangle;
        const SeenMaterial& material = materials_[triangle.material];
        const dvec3& w = met[i].weights;
        const bool is_behind_another = i + 1 < met.size() && met[i + 1].distance < met[i].distance + 1e-4;
        if (is_behind_another || std::min({w.x, w.y, w.z}) < edge) out.is_uncertain = true;
        const dvec2 uv = w.x * triangle.uv[0] + w.y * triangle.uv[1] + w.z * triangle.uv[2];
        const dvec4 factor =
            material.factor * (w.x * triangle.colors[0] + w.y * triangle.colors[1] + w.z * triangle.colors[2]);
        const dvec4 color = factor * texel(material, uv);

        // Floats round positions and coordinates: what lies as far to each side may be seen instead.
        dvec4 spread(0);
        const double rounding = 5e-6 * std::max({1.0, std::abs(uv.x), std::abs(uv.y)});
        for (const dvec2& step : {dvec2(1, 0), dvec2(-1, 0), dvec2(0, 1), dvec2(0, -1)})
            spread = glm::max(spread, glm::abs(factor * texel(material, uv + rounding * step) - color));
        if (material.cutoff >= 0) {
            if (std::abs(color.a - material.cutoff) <= spread.a + 1e-5) out.is_uncertain = true;
            if (color.a < material.cutoff) continue;
        }
        PlainHit& hit = out.hit.emplace();
        hit.distance = met[i].distance;
        hit.color = dvec3(color);
        hit.color_tolerance = 1e-4 + std::max({spread.r, spread.g, spread.b});
        hit.has_normal_map = material.has_normal_map;
        const dvec3 geometric = glm::normalize(
            glm::cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]));
        hit.geometric_normal = glm::dot(geometric, direction) < 0 ? geometric : -geometric;
        hit.normal = hit.geometric_normal;
        if (triangle.has_normals)
            hit.normal =
                glm::normalize(w.x * triangle.normals[0] + w.y * triangle.normals[1] + w.z * triangle.normals[2]);
        return out;
    }
    return out;
}

}  // namespace candela::test
