// SPDX-License-Identifier: MIT
// What the file says: plain vectors with typed ids, editable, knowing neither Embree nor files.
// Right-handed, +Y up, metres; counter-clockwise triangles seen from the front; rows of images from the top and uv
// (0,0) at the top left, as glTF has it. All transforms map column vectors.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/math/bounds.h"
#include "renderer/scene/camera.h"

namespace candela {

struct Animation;
struct Deformation;

// An index into one of Scene's vectors; Tag tells which.
template <typename Tag>
struct Id {
    static constexpr uint32_t none = 0xffffffffu;
    uint32_t value = none;

    constexpr bool valid() const { return value != none; }
    constexpr bool operator==(const Id&) const = default;
};
using MeshId = Id<struct MeshTag>;
using MaterialId = Id<struct MaterialTag>;
using TextureId = Id<struct TextureTag>;
using ImageId = Id<struct ImageTag>;
using NodeId = Id<struct NodeTag>;
using LightId = Id<struct LightTag>;
using CameraId = Id<struct CameraTag>;
using SkinId = Id<struct SkinTag>;

// What a primitive is of in the file; points and lines have bodies of triangles (StrokeSummary).
enum class PrimitiveShape : uint8_t { surface, points, lines };

// KHR_materials_variants: the material that a primitive has in one of the file's variants.
struct VariantMaterial {
    uint32_t variant = 0;  // Scene::variant_names index
    MaterialId material;
};

// Whoever makes the positions of a primitive reserves room for that many more, so that the accelerator, which reads 16
// bytes past the last one, can traverse them where they lie; without it they are copied.
inline constexpr size_t position_padding = 2;

// Triangles that share one material: a glTF primitive. Per-vertex arrays are empty or as long as positions.
struct Primitive {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;   // unit; never empty after loading unless flat (see flat_normals)
    std::vector<Vec4> tangents;  // unit xyz, w = sign of the bitangent; filled when the material needs them
    std::vector<Vec2> uv[2];
    std::vector<Vec4> colors;      // linear RGBA factors
    std::vector<Vec3u> triangles;  // vertex indices, all in range
    MaterialId material;           // outside of all variants; invalid: glTF's default material
    std::vector<VariantMaterial> variants;
    PrimitiveShape shape = PrimitiveShape::surface;
    bool flat_normals = false;  // the file gives no normals: the geometric normal shades, normals is empty
    // Morph targets and joint influences (deform.h), for the vertices as the file models them; null: a rigid shape.
    std::shared_ptr<const Deformation> deformation;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> morph_weights;  // one for each morph target, for nodes that bring none
};

// A mesh placed in the world: the flattened result of walking the active scene's nodes.
struct Instance {
    MeshId mesh;
    NodeId node;
    Mat4 world_from_object{1.0f};
    bool moves = false;    // another pose of the scene may place or deform it otherwise
    bool deforms = false;  // its mesh is a copy of its own, which another pose may replace
};

enum class WrapMode : uint8_t { repeat, clamp_to_edge, mirrored_repeat };
enum class TextureFilter : uint8_t { linear, nearest };
// Between the levels of a mip chain; none: only the image itself is read.
enum class MipFilter : uint8_t { linear, nearest, none };

struct Texture {
    ImageId image;
    ImageId fallback;  // shown where image cannot be decoded; invalid: none
    WrapMode wrap_u = WrapMode::repeat;
    WrapMode wrap_v = WrapMode::repeat;
    TextureFilter mag_filter = TextureFilter::linear;  // where a texel is larger than a pixel
    TextureFilter min_filter = TextureFilter::linear;  // where it is smaller
    MipFilter mip_filter = MipFilter::linear;
};

// A use of a texture: which uv set, and KHR_texture_transform as a 2×3 matrix applied to (u, v, 1).
struct TextureRef {
    TextureId texture;
    uint32_t uv_set = 0;
    glm::mat3x2 uv_transform{1, 0, 0, 1, 0, 0};  // columns: u axis, v axis, offset

    bool valid() const { return texture.valid(); }
};

enum class AlphaMode : uint8_t { opaque, mask, blend };

// The layers that the KHR_materials extensions add. Each texture multiplies the factor beside it; the comment names the
// channel that is read. Colours are linear factors with sRGB textures.
struct SpecularLayer {
    float factor = 1.0f;
    TextureRef texture;  // A
    Vec3 color_factor{1.0f};
    TextureRef color;
};
struct ClearcoatLayer {
    float factor = 0.0f;
    TextureRef texture;  // R
    float roughness_factor = 0.0f;
    TextureRef roughness;  // G
    TextureRef normal;
    float normal_scale = 1.0f;
};
struct SheenLayer {
    Vec3 color_factor{0.0f};
    TextureRef color;
    float roughness_factor = 0.0f;
    TextureRef roughness;  // A
};
struct IridescenceLayer {
    float factor = 0.0f;
    TextureRef texture;  // R
    float ior = 1.3f;
    float thickness_minimum_nm = 100.0f;
    float thickness_maximum_nm = 400.0f;
    TextureRef thickness;  // G: from minimum to maximum; without it the maximum
};
struct Anisotropy {
    float strength = 0.0f;
    float rotation_radians = 0.0f;  // counter-clockwise from the tangent
    TextureRef texture;             // RG direction in [-1,1], B strength
};
struct Transmission {
    float factor = 0.0f;
    TextureRef texture;  // R
};
struct DiffuseTransmission {
    float factor = 0.0f;
    TextureRef texture;  // A
    Vec3 color_factor{1.0f};
    TextureRef color;
};
// KHR_materials_volume and KHR_materials_dispersion. Rays measure the thickness themselves: its texture is not used.
struct Volume {
    float thickness_factor = 0.0f;  // 0: a thin wall without inside
    Vec3 attenuation_color{1.0f};
    float attenuation_distance_m = infinity;
    float dispersion = 0.0f;  // 20 / Abbe number
};

struct Material {
    std::string name;
    Vec4 base_color_factor{1.0f};
    TextureRef base_color;  // sRGB, alpha linear
    float metallic_factor = 1.0f;
    float roughness_factor = 1.0f;
    TextureRef metallic_roughness;  // G roughness, B metallic
    TextureRef normal;
    float normal_scale = 1.0f;
    TextureRef occlusion;  // read and reported, not used: a path tracer computes occlusion
    Vec3 emissive_factor{0.0f};
    float emissive_strength = 1.0f;
    TextureRef emissive;  // sRGB
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    // Both faces emit when set; without it only the front face does. Both faces always scatter.
    bool double_sided = false;
    bool unlit = false;
    float ior = 1.5f;  // 0: total reflection
    SpecularLayer specular;
    ClearcoatLayer clearcoat;
    SheenLayer sheen;
    IridescenceLayer iridescence;
    Anisotropy anisotropy;
    Transmission transmission;
    DiffuseTransmission diffuse_transmission;
    Volume volume;

    // KHR_materials_pbrSpecularGlossiness: base_color is its diffuse, specular.color_factor the reflectance at normal
    // incidence itself, roughness_factor 1 − glossiness.
    bool specular_glossiness = false;
    TextureRef specular_glossiness_texture;  // sRGB specular, A glossiness

    bool emits() const { return !unlit && emissive_strength > 0.0f && max_component(emissive_factor) > 0.0f; }
    bool transmits() const { return transmission.factor > 0.0f || diffuse_transmission.factor > 0.0f; }
    // The surface encloses a medium that light enters.
    bool has_volume() const { return transmits() && volume.thickness_factor > 0.0f; }
    // Light may pass in a straight line: sampled lights are found through it.
    bool is_thin_glass() const { return transmission.factor > 0.0f && volume.thickness_factor <= 0.0f; }
};

// Whether all texels of an image are opaque.
enum class ImageAlpha : uint8_t { unknown, opaque, transparent };

// 8 bits a channel as stored in the file; whether it is sRGB follows from the use, not from the image.
struct SceneImage {
    std::string name;
    std::shared_ptr<const ImageRgba8> pixels;  // null: not decoded
    uint64_t pixel_count = 0;                  // as the head of the picture says; 0: unknown, or decoded
    // Levels 1, 2, … (mip_chain.h) of an image whose texels are colours; null: none.
    std::shared_ptr<const std::vector<ImageRgba8>> smaller = nullptr;
    ImageAlpha alpha = ImageAlpha::unknown;  // a decoder may have looked; of what is not decoded, the head may tell
};

enum class LightKind : uint8_t { point, spot, directional };

// KHR_lights_punctual; shines along -Z of its node. Units are carried 1:1: candela as W/sr, lux as W/m².
struct PunctualLight {
    std::string name;
    LightKind kind = LightKind::point;
    Vec3 color{1.0f};
    float intensity = 1.0f;
    float range = infinity;  // read and reported; not applied: it would break the inverse-square law
    float inner_cone_radians = 0.0f;
    float outer_cone_radians = pi / 4.0f;
};

struct LightInstance {
    LightId light;
    NodeId node;
    Mat4 world_from_light{1.0f};
};

struct CameraInstance {
    std::string name;
    NodeId node;
    Camera camera;  // pose and projection in world space
};

// A camera as the file describes it, before a node places it.
struct FileCamera {
    std::string name;
    Camera camera;  // its pose means nothing
};

struct Skin {
    std::string name;
    std::vector<NodeId> joints;
    std::vector<Mat4> joint_from_mesh;  // inverse bind matrices, one for each joint
};

struct Node {
    std::string name;
    NodeId parent;
    std::vector<NodeId> children;
    Mat4 parent_from_node{1.0f};
    // parent_from_node = translation · rotation · scale, unless the file gives a matrix: then as near as three can be.
    Vec3 translation{0.0f};
    Quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    Vec3 scale{1.0f};
    bool is_matrix = false;
    MeshId mesh;
    SkinId skin;
    LightId light;
    CameraId camera;
    std::vector<float> morph_weights;  // one for each morph target of its mesh
    bool has_own_weights = false;      // not those of its mesh
    // EXT_mesh_gpu_instancing: where the node places its mesh; null: once, as the node stands.
    std::shared_ptr<const std::vector<Mat4>> node_from_instance;
    bool visible = true;  // KHR_node_visibility: false hides meshes and lights of the node and of all below it
    bool in_active_scene = false;
    bool moves = false;     // an animation moves, shows or hides it or one of its ancestors
    bool reshapes = false;  // an animation deforms its mesh
};

// An equirectangular environment. Direction (x,y,z) reads u = atan2(z,x)/2π + ½ from the left and v = ½ − asin(y)/π
// from the top. rotation_radians > 0 turns it counter-clockwise seen from +Y.
struct Environment {
    ImageRgb32f radiance;  // 1×1 for a constant sky
    float rotation_radians = 0.0f;
    float intensity = 1.0f;
};

struct ExtensionUse {
    enum class Treatment : uint8_t { rendered, approximated, ignored, refused };
    std::string name;
    bool required = false;
    Treatment treatment = Treatment::ignored;
    std::string how;  // what an approximation does
};

// Something that the file says of itself or of a part of it: of what (JSON pointers), which property, its value.
struct MetadataEntry {
    std::string where, key, value;
};

// The points and lines of a file, which are drawn as spheres and tubes of one width.
struct StrokeSummary {
    uint64_t points = 0, segments = 0;
    float width_m = 0.0f;
};

// The parts of a texture's transform, where an animation drives them (KHR_texture_transform).
struct UvTransform {
    glm::dvec2 offset{0.0};
    double rotation_radians = 0.0;
    glm::dvec2 scale{1.0};
};
struct AnimatedUv {
    MaterialId material;
    uint32_t slot = 0;  // which texture of the material (animated_property.h)
    UvTransform transform;
};
// translation · rotation · scale. A positive rotation turns the coordinates counter-clockwise as the picture is seen,
// where v points down: u' = u cos + v sin, v' = v cos - u sin.
glm::mat3x2 compose_uv_transform(const UvTransform& transform);

// Copies share meshes, pictures and animations; whoever changes one of these puts another in its place. So equal
// pointers tell that a mesh has the same shape in two poses.
struct Scene {
    std::string source;              // the path as given
    std::vector<std::string> files;  // that it names, where they are or should be
    // The file's meshes; then, one for each instance that deforms, its mesh in this pose.
    std::vector<std::shared_ptr<const Mesh>> meshes;
    uint32_t posed_mesh_count = 0;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<SceneImage> images;
    std::vector<PunctualLight> lights;
    std::vector<FileCamera> file_cameras;
    std::vector<std::shared_ptr<const Skin>> skins;
    std::vector<std::shared_ptr<const Animation>> animations;
    std::vector<AnimatedUv> animated_uvs;
    std::vector<Node> nodes;
    std::vector<NodeId> roots;             // of the active scene
    std::vector<std::string> scene_names;  // all scenes of the file
    uint32_t active_scene = 0;

    // The active scene, flattened (place_nodes.h).
    std::vector<Instance> instances;
    std::vector<LightInstance> light_instances;
    std::vector<CameraInstance> cameras;
    std::optional<Environment> environment;

    std::vector<std::string> variant_names;
    std::optional<uint32_t> active_variant;  // none: each primitive's own material
    StrokeSummary strokes;
    std::vector<MetadataEntry> metadata;
    std::vector<ExtensionUse> extensions;

    const Mesh& mesh(MeshId id) const { return *meshes[id.value]; }
};

// What the primitive is made of in the active variant; invalid: glTF's default material.
MaterialId material_of(const Scene& scene, const Primitive& primitive);
// World-space bounds of all instances of the active scene.
Bounds3 bounds_of(const Scene& scene);
// Triangles of all the file's meshes, each counted once, and of all instances.
uint64_t unique_triangle_count(const Scene& scene);
uint64_t instanced_triangle_count(const Scene& scene);

}  // namespace candela
