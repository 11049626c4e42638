// SPDX-License-Identifier: MIT
#include "renderer/io/nodes.h"
#include "renderer/io/tinygltf.h"

namespace candela {
namespace {

// Right, up, back, orthonormal and right-handed whatever the node scales, mirrors or shears: the view axis is kept
// first, then the up axis as far as it can be.
Mat4 rigid(const Mat4& world_from_node) {
    const glm::dmat4 m(world_from_node);
    glm::dvec3 back(m[2]), up(m[1]);
    back = glm::length(back) > 1e-30 ? glm::normalize(back) : glm::dvec3(0, 0, 1);
    up -= back * glm::dot(back, up);
    if (!(glm::length(up) > 1e-30)) {
        const glm::dvec3 axis = std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        up = axis - back * glm::dot(back, axis);
    }
    up = glm::normalize(up);
    const glm::dvec3 right = glm::cross(up, back);
    return Mat4(Vec4(right, 0.0f), Vec4(up, 0.0f), Vec4(back, 0.0f), Vec4(Vec3(m[3]), 1.0f));
}

}  // namespace

Camera make_camera(LoadContext& context, const tinygltf::Model& model, uint32_t index, const Mat4& world_from_node) {
    const tinygltf::Camera& source = model.cameras[index];
    const std::string where = pointer_to("/cameras", index, source.type);
    Camera camera;
    camera.world_from_camera = rigid(world_from_node);
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

void load_lights(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    for (size_t i = 0; i < model.lights.size(); ++i) {
        const tinygltf::Light& source = model.lights[i];
        const std::string where = pointer_to("/extensions/KHR_lights_punctual/lights", i);
        PunctualLight& light = scene.lights.emplace_back();
        light.name = source.name;
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
