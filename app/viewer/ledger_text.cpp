// SPDX-License-Identifier: MIT
#include "app/viewer/ledger_text.h"

#include <fmt/format.h>

namespace candela {

namespace {

constexpr size_t longest_name = 20;  // in characters

// A name that leaves room for others; characters of UTF-8 are not cut in two.
std::string shortened(const std::string& name) {
    size_t characters = 0, cut = 0;
    for (size_t i = 0; i < name.size(); ++i) {
        if ((static_cast<unsigned char>(name[i]) & 0xC0) == 0x80) continue;
        if (characters == longest_name - 1) cut = i;
        ++characters;
    }
    return characters > longest_name ? name.substr(0, cut) + "…" : name;
}

std::string surface_name(const Scene& scene, uint32_t instance, uint32_t material) {
    const std::string object = shortened(object_name(scene, instance)),
                      made_of = shortened(material_name(scene, material));
    return object.empty() ? made_of : object + ", " + made_of;
}

std::string light_name(const World& world, const LightRecord& light) {
    const Scene& scene = *world.scene;
    if (light.surface != invalid_index) {
        const Surface& surface = world.surfaces[light.surface];
        return surface_name(scene, surface.instance, surface.material);
    }
    if (light.punctual == invalid_index) return light.is_background ? "background" : "environment";
    // The world has dropped none of those that the scene places.
    if (light.punctual < scene.light_instances.size() && scene.light_instances.size() == world.lights.punctual.size()) {
        const LightInstance& placed = scene.light_instances[light.punctual];
        if (placed.light.value < scene.lights.size() && !scene.lights[placed.light.value].name.empty())
            return shortened(scene.lights[placed.light.value].name);
    }
    return fmt::format("lamp {}", light.punctual);
}

std::string share_text(float share) {
    return fmt::format("{:.1f} %", 100 * share);
}

std::array<std::string, 3> color_of(const Vec3& color) {
    return {figure_text(color.r), figure_text(color.g), figure_text(color.b)};
}

std::string pdf_text(float pdf, bool is_delta) {
    return is_delta ? "delta" : pdf > 0 ? figure_text(pdf) : "-";
}

LedgerRow light_row(const World& world, const LightRecord& light, const Vec3& brought, bool hidden) {
    LedgerRow row;
    row.is_light = true;
    row.what = light_name(world, light);
    row.how = name_of(light.technique);
    row.color = color_of(brought);
    row.brings_nothing = is_black(brought);
    if (hidden) row.note = "hidden";
    if (light.technique == LightTechnique::seen) return row;
    const bool samples_light = light.technique == LightTechnique::light_sample;
    row.pdf = pdf_text(samples_light ? light.light_pdf : light.bsdf_pdf, light.is_delta);
    row.other_pdf = pdf_text(samples_light ? light.bsdf_pdf : light.light_pdf, false);
    row.share = share_text(light.share);
    return row;
}

std::string note_of(const VertexRecord& shading) {
    switch (shading.end) {
        case PathEnd::absorbed:
            return "absorbed";
        case PathEnd::depth:
            return "depth limit";
        case PathEnd::roulette:
            return fmt::format("ended at {:.0f} %", 100 * shading.survival);
        case PathEnd::missed:
        case PathEnd::none:
            break;
    }
    return shading.survival < 1 ? fmt::format("{:.0f} % live", 100 * shading.survival) : "";
}

}  // namespace

std::string object_name(const Scene& scene, uint32_t instance) {
    if (instance >= scene.instances.size()) return "";
    const NodeId node = scene.instances[instance].node;
    if (node.valid() && !scene.nodes[node.value].name.empty()) return scene.nodes[node.value].name;
    return fmt::format("object {}", instance);
}

std::string material_name(const Scene& scene, uint32_t material) {
    if (material >= scene.materials.size()) return "glTF's default";
    const std::string& name = scene.materials[material].name;
    return name.empty() ? fmt::format("material {}", material) : name;
}

std::string figure_text(float value) {
    const float size = std::abs(value);
    if (value == 0) return "0";
    if (!(size >= 0.001f && size < 999.95f)) return fmt::format("{:.1e}", value);
    return fmt::format("{:.{}f}", value, size < 9.9995f ? 3 : size < 99.995f ? 2 : 1);
}

std::vector<LedgerRow> rows_of(const World& world, const Ledger& ledger) {
    std::vector<LedgerRow> rows;
    for (size_t i = 0; i < ledger.vertices.size(); ++i) {
        const LedgerVertex& vertex = ledger.vertices[i];
        const VertexRecord& shading = vertex.shading;
        LedgerRow row;
        row.number = fmt::format("{}", i + 1);
        row.note = note_of(shading);
        if (shading.end == PathEnd::missed) {
            row.what = "nothing";
            row.how = "left the scene";
        } else {
            row.what = surface_name(*world.scene, vertex.instance, vertex.material);
            row.how = name_of_scattering(shading);
            if (shading.pdf > 0) row.pdf = pdf_text(shading.pdf, shading.is_delta);
            if (shading.end == PathEnd::none || shading.end == PathEnd::roulette)
                row.color = color_of(vertex.throughput);
        }
        // What the light sampler thinks of the direction, one knows where it found light.
        const LedgerVertex* next = i + 1 < ledger.vertices.size() ? &ledger.vertices[i + 1] : nullptr;
        if (next != nullptr && next->shading.found) {
            row.other_pdf = pdf_text(next->shading.found->light_pdf, false);
            row.share = share_text(next->shading.found->share);
        }
        rows.push_back(std::move(row));
        if (shading.found) rows.push_back(light_row(world, *shading.found, vertex.found, false));
        if (shading.sampled)
            rows.push_back(light_row(world, *shading.sampled, vertex.connected, is_black(vertex.visibility)));
    }
    return rows;
}

}  // namespace candela
