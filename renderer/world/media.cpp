// SPDX-License-Identifier: MIT
#include "renderer/world/media.h"

#include <array>
#include <map>
#include <numeric>
#include <unordered_map>

namespace candela {

namespace {

// Beer-Lambert: attenuation_color is what remains after attenuation_distance_m (KHR_materials_volume).
Vec3 absorption_of(const Volume& volume) {
    constexpr float darkest = 1e-10f;
    if (!std::isfinite(volume.attenuation_distance_m)) return Vec3(0);
    return -glm::log(glm::clamp(volume.attenuation_color, darkest, 1.0f)) / volume.attenuation_distance_m;
}

Vec3 world_position(const World& world, const Surface& surface, uint32_t vertex) {
    const Vec3 p = surface.positions[vertex];
    return surface.positions_in_world ? p : Vec3(world.transforms[surface.transform].world_from_object * Vec4(p, 1.0f));
}

std::string body_name(const World& world, const Surface& surface) {
    const Scene& scene = *world.scene;
    const NodeId node = scene.instances[surface.instance].node;
    const std::string& name = node.valid() ? scene.nodes[node.value].name : std::string();
    return name.empty() ? "/nodes/" + std::to_string(node.value) : "\"" + name + "\"";
}

// Its corners in units of a fine grid, sorted.
using TriangleOnGrid = std::array<std::array<int64_t, 3>, 3>;

struct HashOfTriangle {
    size_t operator()(const TriangleOnGrid& triangle) const {
        uint64_t hash = 0;
        for (const std::array<int64_t, 3>& corner : triangle) {
            for (const int64_t value : corner)
                hash = (hash ^ static_cast<uint64_t>(value)) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 29;
        }
        return static_cast<size_t>(hash ^ hash >> 32);
    }
};

}  // namespace

void gather_media(World& world) {
    // One body for each placed material that has an inside.
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> known;
    std::vector<Bounds3> bounds;
    for (Surface& surface : world.surfaces) {
        const Material& material = world.materials[surface.material];
        if (!material.has_volume()) continue;
        const auto [entry, is_new] =
            known.emplace(std::pair{surface.instance, surface.material}, static_cast<uint32_t>(world.media.size()));
        if (is_new) {
            Medium medium;
            medium.ior = material.ior > 0.0f ? material.ior : 1e6f;
            medium.dispersion = material.volume.dispersion;
            medium.absorption = absorption_of(material.volume);
            world.media.push_back(medium);
            bounds.emplace_back();
        }
        surface.medium = entry->second;
        for (uint32_t v = 0; v < surface.primitive->positions.size(); ++v)
            bounds[surface.medium].extend(world_position(world, surface, v));
    }

    // The smaller body has the higher rank.
    std::vector<uint32_t> order(world.media.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto size_of = [&](uint32_t i) {
        const Vec3 d = bounds[i].extent();
        return static_cast<double>(d.x) * static_cast<double>(d.y) * static_cast<double>(d.z);
    };
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return size_of(a) > size_of(b); });
    for (uint32_t rank = 0; rank < order.size(); ++rank)
        world.media[order[rank]].rank = rank;
}

// Looks for a triangle of one body that lies on a triangle of another, corner on corner.
void warn_of_shared_faces(World& world) {
    // Worth its time only where bodies are few triangles and more than one.
    constexpr size_t most_triangles = 1u << 20;
    size_t triangles = 0;
    for (const Surface& surface : world.surfaces) {
        if (surface.medium != invalid_index) triangles += surface.primitive->triangles.size();
    }
    if (world.media.size() < 2 || triangles > most_triangles) return;
    const float grid = std::max(world.bounds.radius(), 1e-30f) * 1e-6f;
    std::unordered_map<TriangleOnGrid, uint32_t, HashOfTriangle> owners;  // to its surface
    owners.reserve(triangles);
    std::map<std::pair<uint32_t, uint32_t>, bool> warned;
    for (uint32_t s = 0; s < world.surfaces.size(); ++s) {
        const Surface& surface = world.surfaces[s];
        if (surface.medium == invalid_index) continue;
        for (const Vec3u& triangle : surface.primitive->triangles) {
            TriangleOnGrid corners;
            for (int c = 0; c < 3; ++c) {
                const Vec3 p = world_position(world, surface, triangle[c]) / grid;
                for (int i = 0; i < 3; ++i)
                    corners[static_cast<size_t>(c)][static_cast<size_t>(i)] = static_cast<int64_t>(std::round(p[i]));
            }
            std::sort(corners.begin(), corners.end());
            const auto [owner, is_new] = owners.emplace(corners, s);
            const Surface& other = world.surfaces[owner->second];
            if (is_new || other.medium == surface.medium) continue;
            if (!warned.emplace(std::pair{other.medium, surface.medium}, true).second) continue;
            world.warnings.push_back(
                "node " + body_name(world, other) + " and node " + body_name(world, surface) +
                " share faces, so light may cross them in either order: let one overlap the other");
        }
    }
}

}  // namespace candela
