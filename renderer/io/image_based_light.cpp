// SPDX-License-Identifier: MIT
#include "renderer/io/image_based_light.h"

#include <nlohmann/json.hpp>

#include "renderer/image/tone.h"

namespace candela {
namespace {

constexpr const char* extension_name = "EXT_lights_image_based";

const Json* member(const Json* object, const char* name) {
    if (object == nullptr) return nullptr;
    const auto found = object->find(name);
    return found == object->end() ? nullptr : &*found;
}

// Which face a direction meets and where on it: OpenGL's table of cube maps (specification 4.6, table 8.19), with s
// turned over.
struct FacePoint {
    size_t face;
    Vec2 st;  // from the left and from the top
};
FacePoint face_point(const Vec3& w) {
    const Vec3 a = glm::abs(w);
    if (a.x >= a.y && a.x >= a.z) {
        const float sc = w.x > 0.0f ? -w.z : w.z;
        return {w.x > 0.0f ? size_t{0} : size_t{1}, 0.5f + 0.5f * Vec2(-sc, -w.y) / a.x};
    }
    if (a.y >= a.z) {
        const float tc = w.y > 0.0f ? w.z : -w.z;
        return {w.y > 0.0f ? size_t{2} : size_t{3}, 0.5f + 0.5f * Vec2(-w.x, tc) / a.y};
    }
    const float sc = w.z > 0.0f ? w.x : -w.x;
    return {w.z > 0.0f ? size_t{4} : size_t{5}, 0.5f + 0.5f * Vec2(-sc, -w.y) / a.z};
}

// Six faces of the sharpest level; empty with a warning where one is missing.
std::optional<CubeFaces> read_faces(LoadContext& context, const Json& light, const std::string& where,
                                    AssetImages& images) {
    const Json& levels = light["specularImages"];
    if (levels.empty() || levels[0].size() != 6) {
        context.fail(where + "/specularImages/0", "should name six images, one for each face");
    }
    std::vector<uint32_t> indices;
    for (const Json& image : levels[0])
        indices.push_back(image.get<uint32_t>());
    const std::vector<ImageRgba8> stored = images.decode_apart(indices);
    CubeFaces faces;
    for (size_t i = 0; i < faces.size(); ++i) {
        const ImageRgba8& face = stored[i];
        if (face.empty() || face.width() != face.height() || face.width() != stored[0].width()) {
            context.warn(where + "/specularImages/0",
                         "has a face that is missing, not square or of another size; the light is left out");
            return std::nullopt;
        }
        faces[i] = decode_face(face);
    }
    return faces;
}

}  // namespace

Vec3 radiance_of(const CubeFaces& faces, const Vec3& w) {
    const FacePoint point = face_point(w);
    const ImageRgb32f& face = faces[point.face];
    const int size = face.width();
    const Vec2 at = point.st * static_cast<float>(size) - 0.5f;
    const Vec2 base = glm::floor(at);
    const Vec2 t = at - base;
    const auto texel = [&](int dx, int dy) -> const Vec3& {
        return face(std::clamp(static_cast<int>(base.x) + dx, 0, size - 1),
                    std::clamp(static_cast<int>(base.y) + dy, 0, size - 1));
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), t.x), glm::mix(texel(0, 1), texel(1, 1), t.x), t.y);
}

ImageRgb32f decode_face(const ImageRgba8& stored) {
    ImageRgb32f out(stored.width(), stored.height());
    for (size_t i = 0; i < stored.size(); ++i) {
        const Rgba8& texel = stored.pixels()[i];
        // An alpha of 0 would be infinitely bright: the least that can be stored stands for it.
        const float divisor = static_cast<float>(std::max<int>(texel.a, 1)) / 255.0f;
        for (int c = 0; c < 3; ++c)
            out.pixels()[i][c] = linear_from_srgb(static_cast<float>(texel[c]) / 255.0f) / divisor;
    }
    return out;
}

void load_image_based_light(LoadContext& context, const Json& document, AssetImages& images, Scene& scene) {
    // Find the light that the active scene refers to.
    const Json* scenes = member(&document, "scenes");
    if (scenes == nullptr || scene.active_scene >= scenes->size()) return;
    const Json* reference = member(member(&(*scenes)[scene.active_scene], "extensions"), extension_name);
    const Json* light_index = member(reference, "light");
    const Json* lights = member(member(member(&document, "extensions"), extension_name), "lights");
    if (light_index == nullptr || lights == nullptr) return;
    const auto index = light_index->get<uint32_t>();
    const Json& light = (*lights)[index];
    const std::string where = pointer_to("/extensions/EXT_lights_image_based/lights", index);

    const std::optional<CubeFaces> faces = read_faces(context, light, where, images);
    if (!faces) return;
    glm::quat world_from_cube(1, 0, 0, 0);
    if (const Json* rotation = member(&light, "rotation")) {
        const auto at = [&](size_t i) { return (*rotation)[i].get<float>(); };
        const glm::quat given(at(3), at(0), at(1), at(2));
        if (glm::length(given) > 1e-6f) {
            world_from_cube = glm::normalize(given);
        } else {
            context.warn(where + "/rotation", "is no quaternion of a rotation; the light is not turned");
        }
    }

    // Resample to a picture of the same angular resolution at the equator.
    const int height = std::clamp(2 * (*faces)[0].width(), 2, 4096);
    context.charge(uint64_t{2} * static_cast<uint64_t>(height) * static_cast<uint64_t>(height), sizeof(Vec3), where);
    Environment environment;
    environment.radiance = ImageRgb32f(2 * height, height);
    environment.intensity = std::max(light.value("intensity", 1.0f), 0.0f);
    const glm::quat cube_from_world = glm::conjugate(world_from_cube);
    for (int y = 0; y < height; ++y) {
        const float latitude = (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(height)) * pi;
        for (int x = 0; x < 2 * height; ++x) {
            const float phi = ((static_cast<float>(x) + 0.5f) / static_cast<float>(2 * height) - 0.5f) * 2.0f * pi;
            const Vec3 w(std::cos(latitude) * std::cos(phi), std::sin(latitude), std::cos(latitude) * std::sin(phi));
            environment.radiance(x, y) = radiance_of(*faces, cube_from_world * w);
        }
    }
    scene.environment = std::move(environment);
}

}  // namespace candela
