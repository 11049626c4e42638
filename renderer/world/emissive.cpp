// SPDX-License-Identifier: MIT
#include "renderer/world/emissive.h"

#include <array>

#include "renderer/math/parallel.h"

namespace candela {

namespace {

constexpr int most_cells_per_edge = 32;
constexpr size_t most_cells = 1u << 20;

// Emission over a triangle in uv, on a grid of barycentric points that is as fine as the texels up to 16 × 16.
struct TextureMean {
    float mean = 0.0f;
    float largest = 0.0f;
    float smallest = infinity;
};

// Longest edge of the triangle in texels; 1 where it is not finite.
int texels_along(const TextureView& texture, const TextureRef& ref, const Vec2 uv[3]) {
    Vec2 texel[3];
    for (int i = 0; i < 3; ++i) {
        texel[i] = ref.uv_transform * Vec3(uv[i], 1.0f) *
                   Vec2(static_cast<float>(texture.width), static_cast<float>(texture.height));
    }
    const float longest = std::max(
        {glm::length(texel[1] - texel[0]), glm::length(texel[2] - texel[0]), glm::length(texel[2] - texel[1])});
    return std::isfinite(longest) ? static_cast<int>(std::ceil(std::clamp(longest, 1.0f, 1e6f))) : 1;
}

TextureMean mean_over_triangle(const TextureView& texture, const TextureRef& ref, const Vec3& factor,
                               const Vec2 uv[3]) {
    const int n = std::min(texels_along(texture, ref, uv), 16);
    TextureMean out;
    double sum = 0;
    int count = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            const float u = (static_cast<float>(i) + 1.0f / 3.0f) / static_cast<float>(n);
            const float v = (static_cast<float>(j) + 1.0f / 3.0f) / static_cast<float>(n);
            const Vec2 at = (1.0f - u - v) * uv[0] + u * uv[1] + v * uv[2];
            const float value = luminance(factor * Vec3(lookup_srgb(texture, ref.uv_transform * Vec3(at, 1.0f))));
            sum += static_cast<double>(value);
            out.largest = std::max(out.largest, value);
            out.smallest = std::min(out.smallest, value);
            ++count;
        }
    }
    out.mean = static_cast<float>(sum / count);
    return out;
}

// One cell of a triangle: all of it for corner 0 and scale 1.
EmissiveTriangle cut_cell(const EmissiveTriangle& whole, const Vec2& corner, float scale) {
    EmissiveTriangle cell = whole;
    cell.p0 = whole.p0 + corner.x * whole.edge1 + corner.y * whole.edge2;
    cell.edge1 = scale * whole.edge1;
    cell.edge2 = scale * whole.edge2;
    cell.corner = corner;
    cell.scale = scale;
    return cell;
}

// Its vertices in the order that makes edge1 × edge2 point to the front.
Vec3u front_order(const World& world, const Surface& surface, uint32_t triangle) {
    Vec3u index = surface.primitive->triangles[triangle];
    if (world.transforms[surface.transform].flips) std::swap(index.y, index.z);
    return index;
}

// Without what it shines.
EmissiveTriangle place_triangle(const World& world, uint32_t surface_index, const Surface& surface, uint32_t triangle) {
    const Vec3u index = front_order(world, surface, triangle);
    Vec3 p[3];
    for (int i = 0; i < 3; ++i) {
        p[i] = surface.positions[index[i]];
        if (!surface.positions_in_world)
            p[i] = world.transforms[surface.transform].world_from_object * Vec4(p[i], 1.0f);
    }
    EmissiveTriangle out;
    out.p0 = p[0];
    out.edge1 = p[1] - p[0];
    out.edge2 = p[2] - p[0];
    out.surface = surface_index;
    out.triangle = triangle;
    out.two_sided = world.materials[surface.material].double_sided;
    return out;
}

// Whether two poses of a surface shine alike at the same (u, v) of the same triangles.
bool shine_alike(const World& a, const Surface& at_a, const World& b, const Surface& at_b) {
    const Material& x = a.materials[at_a.material];
    const Material& y = b.materials[at_b.material];
    if (x.emissive_factor != y.emissive_factor || x.emissive_strength != y.emissive_strength ||
        x.emissive.texture != y.emissive.texture || x.emissive.uv_set != y.emissive.uv_set ||
        x.emissive.uv_transform != y.emissive.uv_transform)
        return false;
    if (a.transforms[at_a.transform].flips != b.transforms[at_b.transform].flips) return false;
    if (x.emissive.valid()) {
        const uint32_t texture = x.emissive.texture.value;
        if (texture >= a.textures.size() || texture >= b.textures.size() ||
            a.textures[texture].pixels != b.textures[texture].pixels)
            return false;
    }
    if (at_a.primitive == at_b.primitive) return true;
    const uint32_t set = x.emissive.uv_set & 1u;
    return at_a.primitive->triangles == at_b.primitive->triangles && at_a.primitive->uv[set] == at_b.primitive->uv[set];
}

}  // namespace

void append_emissive_triangles(const World& world, uint32_t surface_index, Surface& surface, Lights& out) {
    const Primitive& primitive = *surface.primitive;
    const Material& material = world.materials[surface.material];
    const Vec3 factor = material.emissive_factor * material.emissive_strength;
    const std::vector<Vec2>* uv = nullptr;
    if (material.emissive.valid() && !primitive.uv[material.emissive.uv_set & 1u].empty()) {
        uv = &primitive.uv[material.emissive.uv_set & 1u];
    }
    const auto count = static_cast<uint32_t>(primitive.triangles.size());
    const auto corners_of = [&](uint32_t triangle) {
        const Vec3u index = front_order(world, surface, triangle);
        return std::array<Vec2, 3>{(*uv)[index.x], (*uv)[index.y], (*uv)[index.z]};
    };

    // Each triangle as a whole, and how finely it should be cut.
    std::vector<EmissiveTriangle> wholes(count);
    std::vector<uint32_t> cuts(count, 1);
    parallel_for_each(count, 64, [&](size_t triangle) {
        const auto t = static_cast<uint32_t>(triangle);
        wholes[t] = place_triangle(world, surface_index, surface, t);
        wholes[t].mean_radiance = luminance(factor);
        if (uv == nullptr) return;
        // A triangle must stay reachable as long as a texel of it may shine: the grid can miss some, so its choice
        // never falls below a hundredth of the factor's unless the grid saw every texel black.
        const TextureView& texture = world.textures[material.emissive.texture.value];
        const std::array<Vec2, 3> corners = corners_of(t);
        const TextureMean mean = mean_over_triangle(texture, material.emissive, factor, corners.data());
        wholes[t].mean_radiance = std::max(mean.mean, 0.01f * std::max(mean.largest, 0.01f * luminance(factor)));
        if (!(mean.largest > 2.0f * mean.smallest)) return;
        const int texels = texels_along(texture, material.emissive, corners.data());
        cuts[t] = static_cast<uint32_t>(std::min(2 * texels, most_cells_per_edge));
    });

    // The cells follow one another, as long as there are not too many.
    surface.first_emissive = static_cast<uint32_t>(out.cells.size());
    out.cells.reserve(out.cells.size() + count);
    size_t cells = out.triangles.size();
    for (uint32_t t = 0; t < count; ++t) {
        if (cuts[t] > 1 && cells + size_t{cuts[t]} * cuts[t] > most_cells) cuts[t] = 1;
        out.cells.push_back({static_cast<uint32_t>(cells), cuts[t]});
        cells += size_t{cuts[t]} * cuts[t];
    }
    out.triangles.resize(cells);

    // Each cell has its own mean, but a share that keeps it reachable.
    const uint32_t first = surface.first_emissive;
    parallel_for_each(count, 16, [&](size_t triangle) {
        const auto t = static_cast<uint32_t>(triangle);
        const EmissiveTriangle& whole = wholes[t];
        EmissiveTriangle* next = &out.triangles[out.cells[first + t].first];
        if (cuts[t] == 1) {
            *next = whole;
            return;
        }
        const TextureView& texture = world.textures[material.emissive.texture.value];
        const std::array<Vec2, 3> corners = corners_of(t);
        const auto n = static_cast<int>(cuts[t]);
        const float width = 1.0f / static_cast<float>(n);
        const auto add_cell = [&](const Vec2& corner, float scale) {
            *next = cut_cell(whole, corner, scale);
            const auto uv_at = [&](float u, float v) {
                return (1.0f - u - v) * corners[0] + u * corners[1] + v * corners[2];
            };
            const Vec2 cell_uv[3] = {uv_at(corner.x, corner.y), uv_at(corner.x + scale, corner.y),
                                     uv_at(corner.x, corner.y + scale)};
            const float shines = mean_over_triangle(texture, material.emissive, factor, cell_uv).mean;
            next->mean_radiance = std::max(shines, 0.05f * whole.mean_radiance);
            ++next;
        };
        for (int i = 0; i < n; ++i) {
            for (int j = 0; i + j < n; ++j) {
                const Vec2 corner = width * Vec2(i, j);
                add_cell(corner, width);
                if (i + j < n - 1) add_cell(corner + width, -width);
            }
        }
    });
}

bool move_emissive_triangles(const World& before, const World& world, uint32_t surface_index, Surface& surface,
                             Lights& out) {
    // How finely triangles are cut depends on how many cells there are before them.
    if (surface_index >= before.surfaces.size()) return false;
    const Surface& old = before.surfaces[surface_index];
    const Lights& lights = before.lights;
    if (old.first_emissive != out.cells.size() || old.first_emissive >= lights.cells.size() ||
        lights.cells[old.first_emissive].first != out.triangles.size() || !shine_alike(before, old, world, surface))
        return false;

    surface.first_emissive = old.first_emissive;
    for (uint32_t t = 0; t < surface.primitive->triangles.size(); ++t) {
        const EmissiveTriangle whole = place_triangle(world, surface_index, surface, t);
        const EmissiveCells& cells = lights.cells[old.first_emissive + t];
        out.cells.push_back(cells);
        for (uint32_t i = 0; i < cells.cells_per_edge * cells.cells_per_edge; ++i) {
            const EmissiveTriangle& shining = lights.triangles[cells.first + i];
            out.triangles.push_back(cells.cells_per_edge == 1 ? whole : cut_cell(whole, shining.corner, shining.scale));
            out.triangles.back().mean_radiance = shining.mean_radiance;
        }
    }
    return true;
}

}  // namespace candela
