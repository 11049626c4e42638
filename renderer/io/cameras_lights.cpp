// SPDX-License-Identifier: MIT
#include "renderer/io/nodes.h"
#include "renderer/io/tinygltf.h"

namespace candela {
namespace {

Camera make_camera(LoadContext& context, const tinygltf::Camera& source, const std::string& where) {
    Camera camera;
    if (source.type == "perspective") {
        const tinygltf::PerspectiveCamera& perspective = source.perspective;
        if (!(perspective.yfov > 0.0 && perspective.yfov < 3.14159)) {
            context.fail(where + "/yfov", "must be an angle between 0 and pi, in radians");
        }
        camera.projection = Projection::perspective;
        camera.yfov_radians = static_cast<float>(perspective.yfov);
        if (perspective.aspectRatio > 0.0) camera.aspect = static_cast<float>(perspective.aspectRatio);
    } else {
        const tinygltf::OrthographicCamera& orthographic = source.orthographic;
        if (orthographic.ymag == 0.0 || orthographic.xmag == 0.0) {
            context.fail(where + (orthographic.ymag == 0.0 ? "/ymag" : "/xmag"), "must not be 0");
        }
        camera.projection = Projection::orthographic;
        camera.ortho_half_height_m = static_cast<float>(std::abs(orthographic.ymag));
        camera.aspect = static_cast<float>(std::abs(orthographic.xmag / orthographic.ymag));
    }
    return camera;
}

}  // namespace

void load_cameras(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    std::vector<uint8_t> used(model.cameras.size(), 0);
    for (const Node& node : scene.nodes) {
        if (node.camera.valid()) used[node.camera.value] = 1;
    }
    for (size_t i = 0; i < model.cameras.size(); ++i) {
        FileCamera& out = scene.file_cameras.emplace_back();
        out.name = model.cameras[i].name;
        if (used[i] == 0) continue;
        out.camera = make_camera(context, model.cameras[i], pointer_to("/cameras", i, model.cameras[i].type));
    }
}

void load_lights(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    std::vector<uint8_t> used(model.lights.size(), 0);
    for (const Node& node : scene.nodes) {
        if (node.light.valid() && node.light.value < used.size()) used[node.light.value] = 1;
    }
    for (size_t i = 0; i < model.lights.size(); ++i) {
        const tinygltf::Light& source = model.lights[i];
        const std::string where = pointer_to("/extensions/KHR_lights_punctual/lights", i);
        PunctualLight& light = scene.lights.emplace_back();
        light.name = source.name;
        if (used[i] == 0) context.warn(where, "is on no node, and so shines nowhere");
        if (source.type == "point") {
            light.kind = LightKind::point;
        } else if (source.type == "spot") {
            light.kind = LightKind::spot;
        } else if (source.type == "directional") {
            light.kind = LightKind::directional;
        } else {
            context.fail(where + "/type", "\"" + source.type.substr(0, 40) + "\" is not a kind of light");
        }
        for (size_t c = 0; c < source.color.size() && c < 3; ++c)
            light.color[static_cast<int>(c)] = static_cast<float>(source.color[c]);
        light.intensity = static_cast<float>(source.intensity);
        if (glm::any(glm::lessThan(light.color, Vec3(0))) || light.intensity < 0.0f) {
            context.warn(where, "is negative in colour or intensity; negative values are taken as 0");
            light.color = glm::max(light.color, 0.0f);
            light.intensity = std::max(light.intensity, 0.0f);
        }
        if (source.range > 0.0) light.range = static_cast<float>(source.range);
        if (light.kind != LightKind::spot) continue;
        // 0 <= inner < outer <= pi/2
        const double outer = source.spot.outerConeAngle, inner = source.spot.innerConeAngle;
        constexpr double widest = 1.5707963267948966;
        const double outer_used = std::clamp(outer, 1e-4, widest);
        const double inner_used = std::clamp(inner, 0.0, outer_used);
        if (outer_used < outer - 1e-6 || outer_used > outer || inner_used != inner) {
            context.warn(where + "/spot", "its cone angles are out of range and were clamped");
        }
        light.outer_cone_radians = static_cast<float>(outer_used);
        light.inner_cone_radians = static_cast<float>(inner_used);
    }
}

}  // namespace candela
