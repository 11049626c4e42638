// SPDX-License-Identifier: MIT
#include "renderer/io/structure.h"

#include <nlohmann/json.hpp>

#include "renderer/io/tinygltf.h"

namespace candela {
namespace {

void erase_extras(Json& value) {
    if (value.is_object()) value.erase("extras");
    if (value.is_structured()) {
        for (Json& member : value)
            erase_extras(member);
    }
}

Json without_bytes(const Json& document) {
    Json copy = Json::object();
    // Attribute names may be anything, "extras" too: only the parts that tinygltf reads extras from are cleaned.
    for (const char* part : {"asset", "extensions", "materials", "textures", "samplers", "cameras", "nodes", "meshes",
                             "scenes", "scene"}) {
        const auto found = document.find(part);
        if (found == document.end()) continue;
        copy[part] = *found;
        if (std::string_view(part) != "meshes") erase_extras(copy[part]);
    }
    const auto accessors = document.find("accessors");
    if (accessors != document.end()) {
        const Json dummy = {{"bufferView", 0}, {"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}};
        copy["accessors"] = Json::array();
        for (size_t i = 0; i < accessors->size(); ++i)
            copy["accessors"].push_back(dummy);
        copy["bufferViews"] = {{{"buffer", 0}, {"byteLength", 1}}};
    }
    return copy;
}

std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

}  // namespace

void read_structure(LoadContext& context, const Json& document, tinygltf::Model& model) {
    const std::string text = without_bytes(document).dump();
    tinygltf::TinyGLTF reader;
    // Nothing is left in the text that names a file; should tinygltf look for one all the same, there is none.
    tinygltf::FsCallbacks no_files;
    no_files.FileExists = [](const std::string&, void*) { return false; };
    no_files.ExpandFilePath = [](const std::string&, void*) { return std::string(); };
    no_files.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) { return false; };
    no_files.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
        return false;
    };
    no_files.user_data = nullptr;
    reader.SetFsCallbacks(no_files);
    reader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
                             int, void*) { return false; },
                          nullptr);
    if (text.size() > std::numeric_limits<unsigned int>::max()) context.fail("", "the JSON is too large");
    std::string errors, warnings;
    const bool read = reader.LoadASCIIFromString(&model, &errors, &warnings, text.c_str(),
                                                 static_cast<unsigned int>(text.size()), "", tinygltf::NO_REQUIRE);
    if (!read) context.fail("", one_line(errors.empty() ? "is not readable glTF" : errors));
}

}  // namespace candela
