// SPDX-License-Identifier: MIT
#include "renderer/io/schema.h"

#include <nlohmann/json.hpp>

namespace candela {
namespace {

enum class Kind : uint8_t { object, array, string, boolean, integer, number, numbers, index };

// A property by the path of member names from the root; * stands for every element of an array or member of an object.
struct Rule {
    std::string_view path;
    Kind kind;
    std::string_view target = {};  // index: the array it points into
    bool required = false;         // where the parent exists
    int64_t minimum = 0;           // integer
    size_t length = 0;             // numbers: elements; 0: any
};

constexpr bool needed = true;
constexpr std::string_view image_lights_path = "extensions/EXT_lights_image_based/lights";
constexpr std::string_view variants_path = "extensions/KHR_materials_variants/variants";
constexpr std::string_view lights_path = "extensions/KHR_lights_punctual/lights";

// Parents stand before their members, so that a walk meets only containers of checked type.
constexpr Rule rules[] = {
    {"asset", Kind::object, {}, needed},
    {"asset/version", Kind::string, {}, needed},
    {"asset/minVersion", Kind::string},
    {"extensionsUsed", Kind::array},
    {"extensionsUsed/*", Kind::string},
    {"extensionsRequired", Kind::array},
    {"extensionsRequired/*", Kind::string},
    {"extensions", Kind::object},
    {"extensions/*", Kind::object},

    {"buffers", Kind::array},
    {"buffers/*", Kind::object},
    {"buffers/*/byteLength", Kind::integer, {}, needed, 1},
    {"buffers/*/uri", Kind::string},
    {"buffers/*/extensions", Kind::object},
    {"buffers/*/extensions/EXT_meshopt_compression", Kind::object},
    {"buffers/*/extensions/EXT_meshopt_compression/fallback", Kind::boolean},
    {"buffers/*/extensions/KHR_meshopt_compression", Kind::object},
    {"buffers/*/extensions/KHR_meshopt_compression/fallback", Kind::boolean},

    {"bufferViews", Kind::array},
    {"bufferViews/*", Kind::object},
    {"bufferViews/*/buffer", Kind::index, "buffers", needed},
    {"bufferViews/*/byteOffset", Kind::integer},
    {"bufferViews/*/byteLength", Kind::integer, {}, needed, 1},
    {"bufferViews/*/byteStride", Kind::integer},
    {"bufferViews/*/extensions", Kind::object},
    {"bufferViews/*/extensions/EXT_meshopt_compression", Kind::object},
    {"bufferViews/*/extensions/EXT_meshopt_compression/buffer", Kind::index, "buffers", needed},
    {"bufferViews/*/extensions/EXT_meshopt_compression/byteOffset", Kind::integer},
    {"bufferViews/*/extensions/EXT_meshopt_compression/byteLength", Kind::integer, {}, needed, 1},
    {"bufferViews/*/extensions/EXT_meshopt_compression/byteStride", Kind::integer, {}, needed, 1},
    {"bufferViews/*/extensions/EXT_meshopt_compression/count", Kind::integer, {}, needed, 1},
    {"bufferViews/*/extensions/EXT_meshopt_compression/mode", Kind::string, {}, needed},
    {"bufferViews/*/extensions/EXT_meshopt_compression/filter", Kind::string},
    {"bufferViews/*/extensions/KHR_meshopt_compression", Kind::object},
    {"bufferViews/*/extensions/KHR_meshopt_compression/buffer", Kind::index, "buffers", needed},
    {"bufferViews/*/extensions/KHR_meshopt_compression/byteOffset", Kind::integer},
    {"bufferViews/*/extensions/KHR_meshopt_compression/byteLength", Kind::integer, {}, needed, 1},
    {"bufferViews/*/extensions/KHR_meshopt_compression/byteStride", Kind::integer, {}, needed, 1},
    {"bufferViews/*/extensions/KHR_meshopt_compression/count", Kind::integer, {}, needed, 1},
    {"bufferViews/*/extensions/KHR_meshopt_compression/mode", Kind::string, {}, needed},
    {"bufferViews/*/extensions/KHR_meshopt_compression/filter", Kind::string},

    {"accessors", Kind::array},
    {"accessors/*", Kind::object},
    {"accessors/*/bufferView", Kind::index, "bufferViews"},
    {"accessors/*/byteOffset", Kind::integer},
    {"accessors/*/componentType", Kind::integer, {}, needed},
    {"accessors/*/normalized", Kind::boolean},
    {"accessors/*/count", Kind::integer, {}, needed, 1},
    {"accessors/*/type", Kind::string, {}, needed},
    {"accessors/*/sparse", Kind::object},
    {"accessors/*/sparse/count", Kind::integer, {}, needed, 1},
    {"accessors/*/sparse/indices", Kind::object, {}, needed},
    {"accessors/*/sparse/indices/bufferView", Kind::index, "bufferViews", needed},
    {"accessors/*/sparse/indices/byteOffset", Kind::integer},
    {"accessors/*/sparse/indices/componentType", Kind::integer, {}, needed},
    {"accessors/*/sparse/values", Kind::object, {}, needed},
    {"accessors/*/sparse/values/bufferView", Kind::index, "bufferViews", needed},
    {"accessors/*/sparse/values/byteOffset", Kind::integer},

    {"images", Kind::array},
    {"images/*", Kind::object},
    {"images/*/name", Kind::string},
    {"images/*/uri", Kind::string},
    {"images/*/mimeType", Kind::string},
    {"images/*/bufferView", Kind::index, "bufferViews"},

    {"samplers", Kind::array},
    {"samplers/*", Kind::object},
    {"samplers/*/magFilter", Kind::integer},
    {"samplers/*/minFilter", Kind::integer},
    {"samplers/*/wrapS", Kind::integer},
    {"samplers/*/wrapT", Kind::integer},

    {"textures", Kind::array},
    {"textures/*", Kind::object},
    {"textures/*/sampler", Kind::index, "samplers"},
    {"textures/*/source", Kind::index, "images"},
    {"textures/*/extensions", Kind::object},
    {"textures/*/extensions/EXT_texture_webp", Kind::object},
    {"textures/*/extensions/EXT_texture_webp/source", Kind::index, "images"},
    {"textures/*/extensions/KHR_texture_basisu", Kind::object},
    {"textures/*/extensions/KHR_texture_basisu/source", Kind::index, "images"},

    {"materials", Kind::array},
    {"materials/*", Kind::object},
    {"materials/*/name", Kind::string},
    {"materials/*/pbrMetallicRoughness", Kind::object},
    {"materials/*/pbrMetallicRoughness/baseColorFactor", Kind::numbers, {}, false, 0, 4},
    {"materials/*/pbrMetallicRoughness/metallicFactor", Kind::number},
    {"materials/*/pbrMetallicRoughness/roughnessFactor", Kind::number},
    {"materials/*/normalTexture/scale", Kind::number},
    {"materials/*/occlusionTexture/strength", Kind::number},
    {"materials/*/emissiveFactor", Kind::numbers, {}, false, 0, 3},
    {"materials/*/alphaMode", Kind::string},
    {"materials/*/alphaCutoff", Kind::number},
    {"materials/*/doubleSided", Kind::boolean},
    {"materials/*/extensions", Kind::object},
    {"materials/*/extensions/*", Kind::object},
    {"materials/*/extensions/KHR_materials_emissive_strength/emissiveStrength", Kind::number},
    {"materials/*/extensions/KHR_materials_ior/ior", Kind::number},
    {"materials/*/extensions/KHR_materials_specular/specularFactor", Kind::number},
    {"materials/*/extensions/KHR_materials_specular/specularColorFactor", Kind::numbers, {}, false, 0, 3},
    {"materials/*/extensions/KHR_materials_clearcoat/clearcoatFactor", Kind::number},
    {"materials/*/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", Kind::number},
    {"materials/*/extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", Kind::number},
    {"materials/*/extensions/KHR_materials_sheen/sheenColorFactor", Kind::numbers, {}, false, 0, 3},
    {"materials/*/extensions/KHR_materials_sheen/sheenRoughnessFactor", Kind::number},
    {"materials/*/extensions/KHR_materials_iridescence/iridescenceFactor", Kind::number},
    {"materials/*/extensions/KHR_materials_iridescence/iridescenceIor", Kind::number},
    {"materials/*/extensions/KHR_materials_iridescence/iridescenceThicknessMinimum", Kind::number},
    {"materials/*/extensions/KHR_materials_iridescence/iridescenceThicknessMaximum", Kind::number},
    {"materials/*/extensions/KHR_materials_anisotropy/anisotropyStrength", Kind::number},
    {"materials/*/extensions/KHR_materials_anisotropy/anisotropyRotation", Kind::number},
    {"materials/*/extensions/KHR_materials_transmission/transmissionFactor", Kind::number},
    {"materials/*/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionFactor", Kind::number},
    {"materials/*/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor",
     Kind::numbers,
     {},
     false,
     0,
     3},
    {"materials/*/extensions/KHR_materials_volume/thicknessFactor", Kind::number},
    {"materials/*/extensions/KHR_materials_volume/attenuationDistance", Kind::number},
    {"materials/*/extensions/KHR_materials_volume/attenuationColor", Kind::numbers, {}, false, 0, 3},
    {"materials/*/extensions/KHR_materials_dispersion/dispersion", Kind::number},
    {"materials/*/extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", Kind::numbers, {}, false, 0, 4},
    {"materials/*/extensions/KHR_materials_pbrSpecularGlossiness/specularFactor", Kind::numbers, {}, false, 0, 3},
    {"materials/*/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor", Kind::number},

    {"extensions/KHR_materials_variants", Kind::object},
    {"extensions/KHR_materials_variants/variants", Kind::array, {}, needed},
    {"extensions/KHR_materials_variants/variants/*", Kind::object},
    {"extensions/KHR_materials_variants/variants/*/name", Kind::string, {}, needed},

    {"meshes", Kind::array},
    {"meshes/*", Kind::object},
    {"meshes/*/name", Kind::string},
    {"meshes/*/weights", Kind::numbers},
    {"meshes/*/primitives", Kind::array, {}, needed},
    {"meshes/*/primitives/*", Kind::object},
    {"meshes/*/primitives/*/mode", Kind::integer},
    {"meshes/*/primitives/*/material", Kind::index, "materials"},
    {"meshes/*/primitives/*/indices", Kind::index, "accessors"},
    {"meshes/*/primitives/*/attributes", Kind::object, {}, needed},
    {"meshes/*/primitives/*/attributes/*", Kind::index, "accessors"},
    {"meshes/*/primitives/*/targets", Kind::array},
    {"meshes/*/primitives/*/targets/*", Kind::object},
    {"meshes/*/primitives/*/targets/*/*", Kind::index, "accessors"},
    {"meshes/*/primitives/*/extensions", Kind::object},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants", Kind::object},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings", Kind::array, {}, needed},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*", Kind::object},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/material", Kind::index, "materials", needed},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/variants", Kind::array, {}, needed},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/variants/*", Kind::index, variants_path},
    {"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression", Kind::object},
    {"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/bufferView", Kind::index, "bufferViews", needed},
    {"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/attributes", Kind::object, {}, needed},
    {"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/attributes/*", Kind::integer},

    {"cameras", Kind::array},
    {"cameras/*", Kind::object},
    {"cameras/*/name", Kind::string},
    {"cameras/*/type", Kind::string, {}, needed},
    {"cameras/*/perspective", Kind::object},
    {"cameras/*/perspective/yfov", Kind::number, {}, needed},
    {"cameras/*/perspective/aspectRatio", Kind::number},
    {"cameras/*/orthographic", Kind::object},
    {"cameras/*/orthographic/xmag", Kind::number, {}, needed},
    {"cameras/*/orthographic/ymag", Kind::number, {}, needed},

    {"extensions/KHR_lights_punctual/lights", Kind::array, {}, needed},
    {"extensions/KHR_lights_punctual/lights/*", Kind::object},
    {"extensions/KHR_lights_punctual/lights/*/type", Kind::string, {}, needed},
    {"extensions/KHR_lights_punctual/lights/*/name", Kind::string},
    {"extensions/KHR_lights_punctual/lights/*/color", Kind::numbers, {}, false, 0, 3},
    {"extensions/KHR_lights_punctual/lights/*/intensity", Kind::number},
    {"extensions/KHR_lights_punctual/lights/*/range", Kind::number},
    {"extensions/KHR_lights_punctual/lights/*/spot", Kind::object},
    {"extensions/KHR_lights_punctual/lights/*/spot/innerConeAngle", Kind::number},
    {"extensions/KHR_lights_punctual/lights/*/spot/outerConeAngle", Kind::number},

    {"skins", Kind::array},
    {"skins/*", Kind::object},
    {"skins/*/name", Kind::string},
    {"skins/*/inverseBindMatrices", Kind::index, "accessors"},
    {"skins/*/skeleton", Kind::index, "nodes"},
    {"skins/*/joints", Kind::array, {}, needed},
    {"skins/*/joints/*", Kind::index, "nodes"},

    {"extensions/EXT_lights_image_based", Kind::object},
    {"extensions/EXT_lights_image_based/lights", Kind::array, {}, needed},
    {"extensions/EXT_lights_image_based/lights/*", Kind::object},
    {"extensions/EXT_lights_image_based/lights/*/intensity", Kind::number},
    {"extensions/EXT_lights_image_based/lights/*/rotation", Kind::numbers, {}, false, 0, 4},
    {"extensions/EXT_lights_image_based/lights/*/specularImages", Kind::array, {}, needed},
    {"extensions/EXT_lights_image_based/lights/*/specularImages/*", Kind::array},
    {"extensions/EXT_lights_image_based/lights/*/specularImages/*/*", Kind::index, "images"},

    {"nodes", Kind::array},
    {"nodes/*", Kind::object},
    {"nodes/*/name", Kind::string},
    {"nodes/*/children", Kind::array},
    {"nodes/*/children/*", Kind::index, "nodes"},
    {"nodes/*/mesh", Kind::index, "meshes"},
    {"nodes/*/camera", Kind::index, "cameras"},
    {"nodes/*/skin", Kind::index, "skins"},
    {"nodes/*/matrix", Kind::numbers, {}, false, 0, 16},
    {"nodes/*/translation", Kind::numbers, {}, false, 0, 3},
    {"nodes/*/rotation", Kind::numbers, {}, false, 0, 4},
    {"nodes/*/scale", Kind::numbers, {}, false, 0, 3},
    {"nodes/*/weights", Kind::numbers},
    {"nodes/*/extensions", Kind::object},
    {"nodes/*/extensions/KHR_node_visibility", Kind::object},
    {"nodes/*/extensions/KHR_node_visibility/visible", Kind::boolean},
    {"nodes/*/extensions/EXT_mesh_gpu_instancing", Kind::object},
    {"nodes/*/extensions/EXT_mesh_gpu_instancing/attributes", Kind::object, {}, needed},
    {"nodes/*/extensions/EXT_mesh_gpu_instancing/attributes/*", Kind::index, "accessors"},
    {"nodes/*/extensions/KHR_lights_punctual", Kind::object},
    {"nodes/*/extensions/KHR_lights_punctual/light", Kind::index, lights_path, needed},

    {"scenes", Kind::array},
    {"scenes/*", Kind::object},
    {"scenes/*/name", Kind::string},
    {"scenes/*/nodes", Kind::array},
    {"scenes/*/nodes/*", Kind::index, "nodes"},
    {"scenes/*/extensions", Kind::object},
    {"scenes/*/extensions/EXT_lights_image_based", Kind::object},
    {"scenes/*/extensions/EXT_lights_image_based/light", Kind::index, image_lights_path, needed},
    {"scene", Kind::index, "scenes"},

    {"animations", Kind::array},
    {"animations/*", Kind::object},
    {"animations/*/name", Kind::string},
    {"animations/*/channels", Kind::array, {}, needed},
    {"animations/*/channels/*", Kind::object},
    {"animations/*/channels/*/sampler", Kind::integer, {}, needed},
    {"animations/*/channels/*/target", Kind::object, {}, needed},
    {"animations/*/channels/*/target/node", Kind::index, "nodes"},
    {"animations/*/channels/*/target/path", Kind::string, {}, needed},
    {"animations/*/channels/*/target/extensions", Kind::object},
    {"animations/*/channels/*/target/extensions/KHR_animation_pointer", Kind::object},
    {"animations/*/channels/*/target/extensions/KHR_animation_pointer/pointer", Kind::string, {}, needed},
    {"animations/*/samplers", Kind::array, {}, needed},
    {"animations/*/samplers/*", Kind::object},
    {"animations/*/samplers/*/input", Kind::index, "accessors", needed},
    {"animations/*/samplers/*/output", Kind::index, "accessors", needed},
    {"animations/*/samplers/*/interpolation", Kind::string},
};

// Where a textureInfo may stand.
constexpr std::string_view texture_infos[] = {
    "materials/*/pbrMetallicRoughness/baseColorTexture",
    "materials/*/pbrMetallicRoughness/metallicRoughnessTexture",
    "materials/*/normalTexture",
    "materials/*/occlusionTexture",
    "materials/*/emissiveTexture",
    "materials/*/extensions/KHR_materials_specular/specularTexture",
    "materials/*/extensions/KHR_materials_specular/specularColorTexture",
    "materials/*/extensions/KHR_materials_clearcoat/clearcoatTexture",
    "materials/*/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture",
    "materials/*/extensions/KHR_materials_clearcoat/clearcoatNormalTexture",
    "materials/*/extensions/KHR_materials_sheen/sheenColorTexture",
    "materials/*/extensions/KHR_materials_sheen/sheenRoughnessTexture",
    "materials/*/extensions/KHR_materials_iridescence/iridescenceTexture",
    "materials/*/extensions/KHR_materials_iridescence/iridescenceThicknessTexture",
    "materials/*/extensions/KHR_materials_anisotropy/anisotropyTexture",
    "materials/*/extensions/KHR_materials_transmission/transmissionTexture",
    "materials/*/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionTexture",
    "materials/*/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorTexture",
    "materials/*/extensions/KHR_materials_volume/thicknessTexture",
    "materials/*/extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture",
    "materials/*/extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture",
};
constexpr Rule texture_info_rules[] = {
    {"", Kind::object},
    {"/index", Kind::index, "textures", needed},
    {"/texCoord", Kind::integer},
    {"/extensions", Kind::object},
    {"/extensions/KHR_texture_transform", Kind::object},
    {"/extensions/KHR_texture_transform/offset", Kind::numbers, {}, false, 0, 2},
    {"/extensions/KHR_texture_transform/scale", Kind::numbers, {}, false, 0, 2},
    {"/extensions/KHR_texture_transform/rotation", Kind::number},
    {"/extensions/KHR_texture_transform/texCoord", Kind::integer},
};

const char* kind_name(Kind kind) {
    switch (kind) {
        case Kind::object:
            return "an object";
        case Kind::array:
            return "an array";
        case Kind::string:
            return "a string";
        case Kind::boolean:
            return "true or false";
        case Kind::integer:
            return "an integer";
        case Kind::number:
            return "a number";
        case Kind::numbers:
            return "an array of numbers";
        case Kind::index:
            return "an index";
    }
    return "";
}

class Validator {
  public:
    Validator(LoadContext& context, Json& document) : context_(context), document_(document) {}

    void apply(const Rule& rule, std::string_view path) {
        rule_ = &rule;
        target_size_ = rule.kind == Kind::index ? array_size(rule.target) : 0;
        pointer_.clear();
        walk(document_, path);
    }

  private:
    size_t array_size(std::string_view path) const {
        const Json* at = &document_;
        while (!path.empty()) {
            const size_t slash = path.find('/');
            const auto member = at->find(std::string(path.substr(0, slash)));
            if (member == at->end()) return 0;
            at = &*member;
            path = slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1);
        }
        return at->is_array() ? at->size() : 0;
    }

    void walk(Json& value, std::string_view path) {
        if (path.empty()) {
            check(value);
            return;
        }
        const size_t slash = path.find('/');
        const std::string_view token = path.substr(0, slash);
        const std::string_view rest = slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1);
        const size_t length = pointer_.size();
        if (token == "*" && value.is_array()) {
            for (size_t i = 0; i < value.size(); ++i) {
                pointer_ += "/" + std::to_string(i);
                walk(value[i], rest);
                pointer_.resize(length);
            }
        } else if (token == "*" && value.is_object()) {
            for (auto member = value.begin(); member != value.end(); ++member) {
                pointer_ += "/" + pointer_token(member.key());
                walk(member.value(), rest);
                pointer_.resize(length);
            }
        } else if (token != "*" && value.is_object()) {
            const auto member = value.find(std::string(token));
            pointer_ += "/" + std::string(token);
            if (member != value.end()) {
                walk(*member, rest);
            } else if (rest.empty() && rule_->required) {
                context_.fail(pointer_, "is required but missing");
            }
            pointer_.resize(length);
        }
    }

    // Writers may spell an integer as 3.0 or 3e0.
    static bool as_integer(Json& value) {
        if (value.is_number_float()) {
            const double number = value.get<double>();
            constexpr double exact = 9007199254740992.0;  // 2^53
            if (number != std::floor(number) || std::abs(number) > exact) return false;
            value = static_cast<int64_t>(number);
        }
        if (value.is_number_unsigned()) {
            return value.get<uint64_t>() <= static_cast<uint64_t>(std::numeric_limits<int64_t>::max());
        }
        return value.is_number_integer();
    }

    // Stored as floating point, for tinygltf cuts integers in extensions to 32 bits.
    void check_number(Json& value, const std::string& where) const {
        if (!value.is_number()) context_.fail(where, "should be a number");
        const double number = value.get<double>();
        if (!(std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max()))) {
            context_.fail(where, "is beyond the range of single precision");
        }
        value = number;
    }

    void check(Json& value) const {
        const Rule& rule = *rule_;
        bool matches = false;
        switch (rule.kind) {
            case Kind::object:
                matches = value.is_object();
                break;
            case Kind::array:
                matches = value.is_array();
                break;
            case Kind::string:
                matches = value.is_string();
                break;
            case Kind::boolean:
                matches = value.is_boolean();
                break;
            case Kind::integer:
            case Kind::index:
                matches = as_integer(value);
                break;
            case Kind::number:
                matches = value.is_number();
                break;
            case Kind::numbers:
                matches = value.is_array();
                break;
        }
        if (!matches) context_.fail(pointer_, std::string("should be ") + kind_name(rule.kind));
        if (rule.kind == Kind::number) check_number(value, pointer_);
        if (rule.kind == Kind::integer && value.get<int64_t>() < rule.minimum) {
            context_.fail(pointer_, "is " + value.dump() + ", less than " + std::to_string(rule.minimum));
        }
        if (rule.kind == Kind::index) {
            const int64_t index = value.get<int64_t>();
            if (index < 0 || static_cast<uint64_t>(index) >= target_size_) {
                context_.fail(pointer_, "points to /" + std::string(rule.target) + "/" + std::to_string(index) +
                                            ", but there are only " + std::to_string(target_size_));
            }
        }
        if (rule.kind == Kind::numbers) {
            if (rule.length != 0 && value.size() != rule.length) {
                context_.fail(pointer_, "has " + std::to_string(value.size()) + " numbers, should have " +
                                            std::to_string(rule.length));
            }
            for (size_t i = 0; i < value.size(); ++i)
                check_number(value[i], pointer_to(pointer_, i));
        }
    }

    LoadContext& context_;
    Json& document_;
    const Rule* rule_ = nullptr;
    size_t target_size_ = 0;
    std::string pointer_;
};

void check_version(LoadContext& context, const Json& document) {
    for (const char* member : {"version", "minVersion"}) {
        const auto version = document["asset"].find(member);
        if (version == document["asset"].end()) continue;
        const std::string& text = version->get_ref<const std::string&>();
        const bool is_minimum = std::string_view(member) == "minVersion";
        if (text.rfind("2.", 0) != 0 || (is_minimum && text != "2.0")) {
            context.fail(std::string("/asset/") + member, "glTF version \"" + text + "\" is not supported, only 2.0");
        }
    }
}

}  // namespace

void validate_document(LoadContext& context, Json& document) {
    Validator validator(context, document);
    for (const Rule& rule : rules) {
        validator.apply(rule, rule.path);
        if (rule.path == "asset/minVersion") check_version(context, document);
    }
    for (const std::string_view place : texture_infos) {
        for (const Rule& rule : texture_info_rules)
            validator.apply(rule, std::string(place) + std::string(rule.path));
    }
}

}  // namespace candela
