// SPDX-License-Identifier: MIT
#include "renderer/io/metadata.h"

#include <nlohmann/json.hpp>

namespace candela {
namespace {

// Members of anything: null where there is none of that name.
const Json* member(const Json& object, const std::string& name) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(name);
    return found == object.end() ? nullptr : &*found;
}

// JSON-LD writes lists and sets, values with a language, and alternatives as objects; the words in them are what a
// person reads.
std::string words_of(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    for (const char* name : {"@value", "@list", "@set", "rdf:_1"}) {
        if (const Json* inner = member(value, name)) return words_of(*inner);
    }
    if (value.is_array()) {
        std::string out;
        for (const Json& each : value)
            out += (out.empty() ? "" : ", ") + words_of(each);
        return out;
    }
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

class MetadataReader {
  public:
    MetadataReader(LoadContext& context, const Json& document, Scene& scene)
        : context_(context), document_(document), scene_(scene) {}

    void read() {
        for (const char* name : {"generator", "copyright", "version"}) {
            const Json* value = member(document_["asset"], name);
            if (value != nullptr && value->is_string()) add("/asset", name, *value);
        }
        for (const char* name : {"KHR_xmp_json_ld", "KHR_xmp"})
            read_packets(name);
    }

  private:
    // Packets say something of what refers to them.
    void read_packets(const std::string& name) {
        const Json* extensions = member(document_, "extensions");
        const Json* extension = extensions == nullptr ? nullptr : member(*extensions, name);
        const Json* packets = extension == nullptr ? nullptr : member(*extension, "packets");
        if (packets == nullptr || !packets->is_array()) return;
        std::vector<std::string> owners(packets->size());
        note_owner(document_["asset"], "/asset", name, owners);
        for (const char* part : {"scenes", "nodes", "meshes", "materials", "images", "animations"}) {
            const Json* list = member(document_, part);
            if (list == nullptr || !list->is_array()) continue;
            for (size_t i = 0; i < list->size(); ++i)
                note_owner((*list)[i], pointer_to(std::string("/") + part, i), name, owners);
        }
        for (size_t p = 0; p < packets->size(); ++p) {
            if (!(*packets)[p].is_object()) continue;
            const std::string own_place = pointer_to("/extensions/" + name + "/packets", p);
            for (const auto& [key, value] : (*packets)[p].items()) {
                if (key != "@context") add(owners[p].empty() ? own_place : owners[p], key, value);
            }
        }
    }

    static void note_owner(const Json& object, const std::string& where, const std::string& name,
                           std::vector<std::string>& owners) {
        const Json* extensions = member(object, "extensions");
        const Json* extension = extensions == nullptr ? nullptr : member(*extensions, name);
        const Json* packet = extension == nullptr ? nullptr : member(*extension, "packet");
        if (packet == nullptr || !packet->is_number_unsigned()) return;
        const auto index = packet->get<uint64_t>();
        if (index < owners.size()) owners[index] += (owners[index].empty() ? "" : " ") + where;
    }

    void add(const std::string& where, const std::string& key, const Json& value) {
        if (scene_.metadata.size() >= max_metadata_entries) return;
        const auto cut = [](std::string text) {
            if (text.size() > max_metadata_bytes) text = text.substr(0, max_metadata_bytes) + "…";
            return text;
        };
        context_.charge(3 * max_metadata_bytes, where);
        scene_.metadata.push_back({cut(where), cut(key), cut(words_of(value))});
    }

    LoadContext& context_;
    const Json& document_;
    Scene& scene_;
};

}  // namespace

void load_metadata(LoadContext& context, const Json& document, Scene& scene) {
    MetadataReader(context, document, scene).read();
}

}  // namespace candela
