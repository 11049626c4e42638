// SPDX-License-Identifier: MIT
#include "tests/models/repack.h"

#include <meshoptimizer.h>
#include <webp/encode.h>

#include <cctype>
#include <fstream>
#include <stdexcept>

#include "renderer/image/codec.h"
#include "tests/io/document.h"

namespace candela::test {
namespace {

using Json = RawGltf::Json;

constexpr const char* meshopt_name = "EXT_meshopt_compression";
constexpr const char* webp_name = "EXT_texture_webp";

bool is_png(const std::string& bytes) {
    return bytes.compare(1, 3, "PNG") == 0;
}

std::string type_of(const std::string& bytes) {
    if (is_png(bytes)) return "image/png";
    return bytes.compare(0, 4, "RIFF") == 0  ? "image/webp"
           : bytes.compare(1, 3, "KTX") == 0 ? "image/ktx2"
                                             : "image/jpeg";
}

std::string base64(const std::string& bytes) {
    const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            out += i + k <= bytes.size() ? alphabet[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

std::string percent_decoded(const std::string& uri) {
    std::string out;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size()) {
            out += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            out += uri[i];
        }
    }
    return out;
}

std::filesystem::path write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
}

// Lossless, colours under transparent texels included.
std::string encode_webp(const ImageRgba8& image) {
    WebPConfig config;
    WebPPicture picture;
    if (WebPConfigInit(&config) == 0 || WebPPictureInit(&picture) == 0) throw std::runtime_error("libwebp");
    config.lossless = config.exact = 1;
    config.method = 0;
    picture.use_argb = 1;
    picture.width = image.width();
    picture.height = image.height();
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    if (WebPPictureImportRGBA(&picture, &image.data()->r, 4 * image.width()) == 0 || WebPEncode(&config, &picture) == 0)
        throw std::runtime_error("libwebp");
    std::string out(reinterpret_cast<const char*>(writer.mem), writer.size);
    WebPPictureFree(&picture);
    WebPMemoryWriterClear(&writer);
    return out;
}

void require(Json& document, const char* extension) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        if (!document.contains(list)) document[list] = Json::array();
        document[list].push_back(extension);
    }
}

// Bytes of a view's elements, 0 where nothing tells: those of the accessors that read it.
struct ViewUse {
    size_t stride = 0;
    bool is_indices = false, is_mixed = false;
};

std::vector<ViewUse> uses_of_views(const Json& document) {
    std::vector<ViewUse> out(document["bufferViews"].size());
    std::vector<bool> holds_indices(document["accessors"].size(), false);
    for (const Json& mesh : document.value("meshes", Json::array())) {
        for (const Json& primitive : mesh["primitives"]) {
            if (primitive.contains("indices")) holds_indices[primitive["indices"].get<size_t>()] = true;
        }
    }
    for (size_t a = 0; a < document["accessors"].size(); ++a) {
        const Json& accessor = document["accessors"][a];
        if (!accessor.contains("bufferView")) continue;
        const auto v = accessor["bufferView"].get<size_t>();
        const size_t stride =
            document["bufferViews"][v].value("byteStride", RawGltf::components_of(accessor["type"]) *
                                                               RawGltf::size_of(accessor["componentType"].get<int>()));
        if (out[v].stride != 0 && (out[v].stride != stride || out[v].is_indices != holds_indices[a]))
            out[v].is_mixed = true;
        out[v].stride = stride;
        out[v].is_indices = holds_indices[a];
    }
    return out;
}

std::string encode_meshopt(const std::string& bytes, const ViewUse& use) {
    const size_t count = bytes.size() / use.stride;
    std::vector<unsigned char> out;
    if (use.is_indices) {
        std::vector<uint32_t> indices(count, 0);
        for (size_t i = 0; i < count; ++i)
            std::memcpy(&indices[i], bytes.data() + i * use.stride, use.stride);
        out.resize(meshopt_encodeIndexSequenceBound(count, 1u << 31));
        out.resize(meshopt_encodeIndexSequence(out.data(), out.size(), indices.data(), count));
    } else {
        out.resize(meshopt_encodeVertexBufferBound(count, use.stride));
        out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), bytes.data(), count, use.stride));
    }
    return {reinterpret_cast<const char*>(out.data()), out.size()};
}

void append_aligned(std::string& to, const std::string& bytes) {
    to.resize((to.size() + 7) / 8 * 8, '\0');
    to += bytes;
}

std::string bytes_of_view(const RawGltf& gltf, const Json& view) {
    return gltf.buffers()
        .at(view["buffer"].get<size_t>())
        .substr(view.value("byteOffset", size_t{0}), view["byteLength"]);
}

}  // namespace

Repacker::Repacker(const std::filesystem::path& file) : gltf_(file) {
    for (const Json& image : gltf_.json.value("images", Json::array())) {
        if (image.contains("bufferView")) {
            images_.push_back(bytes_of_view(gltf_, gltf_.json["bufferViews"][image["bufferView"].get<size_t>()]));
            continue;
        }
        const std::string uri = image["uri"];
        images_.push_back(uri.compare(0, 5, "data:") == 0
                              ? RawGltf::from_data_uri(uri)
                              : RawGltf::contents(file.parent_path() / percent_decoded(uri)));
    }
}

size_t Repacker::png_count() const {
    size_t out = 0;
    for (const std::string& image : images_)
        out += is_png(image);
    return out;
}

Json Repacker::with_images(const std::vector<std::string>& uris) const {
    Json document = gltf_.json;
    for (size_t i = 0; i < uris.size(); ++i) {
        Json& image = document["images"][i];
        image.erase("bufferView");
        image["uri"] = uris[i];
    }
    return document;
}

std::vector<std::string> Repacker::write_images(const std::filesystem::path& folder) const {
    std::vector<std::string> names;
    for (size_t i = 0; i < images_.size(); ++i) {
        names.push_back("image" + std::to_string(i));
        write(folder / names.back(), images_[i]);
    }
    return names;
}

// One buffer, pictures in views of it.
std::filesystem::path Repacker::as_glb(const std::filesystem::path& folder) const {
    Json document = gltf_.json;
    std::string bin;
    std::vector<size_t> offsets;
    for (const std::string& buffer : gltf_.buffers()) {
        append_aligned(bin, "");
        offsets.push_back(bin.size());
        bin += buffer;
    }
    for (Json& view : document["bufferViews"]) {
        view["byteOffset"] = view.value("byteOffset", size_t{0}) + offsets.at(view["buffer"].get<size_t>());
        view["buffer"] = 0;
    }
    for (size_t i = 0; i < images_.size(); ++i) {
        append_aligned(bin, "");
        document["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", images_[i].size()}});
        bin += images_[i];
        Json& image = document["images"][i];
        image.erase("uri");
        image["mimeType"] = type_of(images_[i]);
        image["bufferView"] = document["bufferViews"].size() - 1;
    }
    document["buffers"] = {{{"byteLength", bin.size()}}};
    return write(folder / "model.glb", glb_bytes(document.dump(), bin));
}

std::filesystem::path Repacker::as_embedded(const std::filesystem::path& folder) const {
    std::vector<std::string> uris;
    for (const std::string& image : images_)
        uris.push_back("data:" + type_of(image) + ";base64," + base64(image));
    Json document = with_images(uris);
    for (size_t b = 0; b < gltf_.buffers().size(); ++b) {
        document["buffers"][b]["uri"] = "data:application/octet-stream;base64," +
                                        base64(gltf_.buffers()[b].substr(0, document["buffers"][b]["byteLength"]));
    }
    return write(folder / "embedded.gltf", document.dump());
}

// Views that the extension has a mode for are compressed in buffer 0, the others copied there; buffer 1 has no bytes.
std::filesystem::path Repacker::as_meshopt(const std::filesystem::path& folder) const {
    Json document = with_images(write_images(folder));
    const std::vector<ViewUse> uses = uses_of_views(document);
    std::string bin;
    size_t uncompressed = 0;
    for (size_t v = 0; v < uses.size(); ++v) {
        Json& view = document["bufferViews"][v];
        const std::string bytes = bytes_of_view(gltf_, view);
        const ViewUse& use = uses[v];
        append_aligned(bin, "");
        const bool has_mode = use.stride != 0 && !use.is_mixed && bytes.size() % use.stride == 0 &&
                              (use.is_indices ? use.stride > 1 : use.stride % 4 == 0 && use.stride <= 256);
        if (!has_mode) {
            view["buffer"] = 0;
            view["byteOffset"] = bin.size();
            bin += bytes;
            continue;
        }
        const std::string encoded = encode_meshopt(bytes, use);
        view["buffer"] = 1;
        view["byteOffset"] = uncompressed;
        uncompressed += (bytes.size() + 7) / 8 * 8;
        view["extensions"][meshopt_name] = {{"buffer", 0},
                                            {"byteOffset", bin.size()},
                                            {"byteLength", encoded.size()},
                                            {"byteStride", use.stride},
                                            {"count", bytes.size() / use.stride},
                                            {"mode", use.is_indices ? "INDICES" : "ATTRIBUTES"}};
        bin += encoded;
    }
    require(document, meshopt_name);
    write(folder / "meshopt.bin", bin);
    document["buffers"] = {{{"byteLength", bin.size()}, {"uri", "meshopt.bin"}}};
    if (uncompressed > 0) {
        document["buffers"].push_back(
            {{"byteLength", uncompressed}, {"extensions", {{meshopt_name, {{"fallback", true}}}}}});
    }
    return write(folder / "meshopt.gltf", document.dump());
}

std::filesystem::path Repacker::as_webp(const std::filesystem::path& folder) const {
    std::vector<std::string> names = write_images(folder);
    for (size_t i = 0; i < images_.size(); ++i) {
        if (!is_png(images_[i])) continue;
        const ImageRgba8 image = decode_ldr({reinterpret_cast<const std::byte*>(images_[i].data()), images_[i].size()});
        write(folder / names[i], encode_webp(image));
    }
    Json document = with_images(names);
    for (Json& texture : document["textures"]) {
        if (!texture.contains("source") || !is_png(images_.at(texture["source"].get<size_t>()))) continue;
        document["images"][texture["source"].get<size_t>()]["mimeType"] = "image/webp";
        texture["extensions"][webp_name]["source"] = texture["source"];
        texture.erase("source");
    }
    for (size_t b = 0; b < gltf_.buffers().size(); ++b) {
        const std::string name = "buffer" + std::to_string(b);
        write(folder / name, gltf_.buffers()[b]);
        document["buffers"][b]["uri"] = name;
    }
    require(document, webp_name);
    return write(folder / "webp.gltf", document.dump());
}

}  // namespace candela::test
