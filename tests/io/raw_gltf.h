// SPDX-License-Identifier: MIT
// A second, plain reading of glTF in double precision, for tests that compare: no checks, no repairs, no compression.
#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace candela::test {

class RawGltf {
  public:
    using Json = nlohmann::json;

    explicit RawGltf(const std::filesystem::path& file) {
        const std::string bytes = contents(file);
        std::string text = bytes, bin;
        if (bytes.compare(0, 4, "glTF") == 0) {
            uint32_t length = 0;
            std::memcpy(&length, bytes.data() + 12, 4);
            text = bytes.substr(20, length);
            if (bytes.size() > 28 + length) bin = bytes.substr(28 + length);
        }
        json = Json::parse(text);
        for (const Json& buffer : json["buffers"]) {
            if (!buffer.contains("uri")) {
                buffers_.push_back(bin);
                continue;
            }
            const std::string uri = buffer["uri"];
            const bool is_data = uri.compare(0, 5, "data:") == 0;
            buffers_.push_back(is_data ? from_data_uri(uri) : contents(file.parent_path() / uri));
        }
    }

    // Components of all elements, one after the other; sparse values included.
    std::vector<double> read(size_t index) const {
        const Json& accessor = json["accessors"][index];
        const int type = accessor["componentType"];
        const size_t components = components_of(accessor["type"]);
        const size_t count = accessor["count"];
        const bool normalized = accessor.value("normalized", false);
        std::vector<double> out(count * components, 0.0);
        if (accessor.contains("bufferView")) {
            const Json& view = json["bufferViews"][accessor["bufferView"].get<size_t>()];
            const size_t stride = view.value("byteStride", components * size_of(type));
            const char* from = at(view) + accessor.value("byteOffset", size_t{0});
            for (size_t i = 0; i < count; ++i) {
                for (size_t c = 0; c < components; ++c)
                    out[i * components + c] = component(from + i * stride + c * size_of(type), type, normalized);
            }
        }
        if (accessor.contains("sparse")) {
            const Json& sparse = accessor["sparse"];
            const int index_type = sparse["indices"]["componentType"];
            const char* indices = at(json["bufferViews"][sparse["indices"]["bufferView"].get<size_t>()]) +
                                  sparse["indices"].value("byteOffset", size_t{0});
            const char* values = at(json["bufferViews"][sparse["values"]["bufferView"].get<size_t>()]) +
                                 sparse["values"].value("byteOffset", size_t{0});
            for (size_t i = 0; i < sparse["count"].get<size_t>(); ++i) {
                const auto to = static_cast<size_t>(component(indices + i * size_of(index_type), index_type, false));
                for (size_t c = 0; c < components; ++c) {
                    out[to * components + c] =
                        component(values + (i * components + c) * size_of(type), type, normalized);
                }
            }
        }
        return out;
    }
    std::vector<glm::dvec3> read3(size_t index) const {
        const std::vector<double> flat = read(index);
        std::vector<glm::dvec3> out;
        for (size_t i = 0; i < flat.size(); i += 3)
            out.emplace_back(flat[i], flat[i + 1], flat[i + 2]);
        return out;
    }

    // All bytes of each buffer.
    const std::vector<std::string>& buffers() const { return buffers_; }

    static std::string contents(const std::filesystem::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    // The bytes of a "data:" URI.
    static std::string from_data_uri(const std::string& uri) { return from_base64(uri.substr(uri.find(',') + 1)); }

    static size_t components_of(const std::string& type) {
        if (type == "MAT4") return 16;
        return type == "SCALAR" ? 1 : static_cast<size_t>(type.back() - '0');
    }
    static size_t size_of(int type) { return type <= 5121 ? 1 : type <= 5123 ? 2 : 4; }

    Json json;

  private:
    static std::string from_base64(const std::string& text) {
        const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string out;
        uint32_t bits = 0;
        int count = 0;
        for (const char c : text) {
            const size_t value = alphabet.find(c);
            if (value == std::string::npos) continue;
            bits = bits << 6 | static_cast<uint32_t>(value);
            count += 6;
            if (count < 8) continue;
            count -= 8;
            out.push_back(static_cast<char>(bits >> count & 0xff));
        }
        return out;
    }
    template <typename T>
    static double load(const char* from, bool normalized) {
        T value;
        std::memcpy(&value, from, sizeof(T));
        const auto number = static_cast<double>(value);
        if (!normalized || !std::numeric_limits<T>::is_integer) return number;
        return std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
    }
    static double component(const char* from, int type, bool normalized) {
        switch (type) {
            case 5120:
                return load<int8_t>(from, normalized);
            case 5121:
                return load<uint8_t>(from, normalized);
            case 5122:
                return load<int16_t>(from, normalized);
            case 5123:
                return load<uint16_t>(from, normalized);
            case 5125:
                return load<uint32_t>(from, normalized);
            default:
                return load<float>(from, normalized);
        }
    }
    const char* at(const Json& view) const {
        return buffers_[view["buffer"].get<size_t>()].data() + view.value("byteOffset", size_t{0});
    }

    std::vector<std::string> buffers_;
};

}  // namespace candela::test
