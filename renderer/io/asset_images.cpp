// SPDX-License-Identifier: MIT
#include "renderer/io/asset_images.h"

#include "renderer/io/materials.h"

namespace candela {
namespace {

// Which images a picture depends on: occlusion is not among them, for a path tracer computes it.
std::vector<uint32_t> images_in_use(const Scene& scene) {
    std::vector<uint8_t> used(scene.images.size(), 0);
    for (const Material& material : scene.materials) {
        for (const TextureSlot& slot : texture_slots(material)) {
            if (slot.ref != &material.occlusion) used[scene.textures[slot.ref->texture.value].image.value] = 1;
        }
    }
    std::vector<uint32_t> list;
    for (uint32_t i = 0; i < used.size(); ++i) {
        if (used[i] != 0) list.push_back(i);
    }
    return list;
}

}  // namespace

void AssetImages::list(Scene& scene) const {
    for (const ImageLayout& image : layout_.images) {
        const bool is_file = image.uri && !is_data_uri(*image.uri);
        scene.images.push_back({image.name.empty() && is_file ? *image.uri : image.name, {}});
    }
}

std::span<const std::byte> AssetImages::encoded(size_t index, const char* consequence) {
    const ImageLayout& image = layout_.images[index];
    const std::string where = pointer_to("/images", index);
    if (image.view) return buffers_.view(*image.view);
    if (!image.uri) {
        context_.warn(where, std::string("has neither uri nor bufferView") + consequence);
        return {};
    }
    std::vector<std::byte>& bytes = owned_.emplace_back();
    try {
        if (is_data_uri(*image.uri)) {
            context_.charge(data_uri_bound_bytes(*image.uri), where + "/uri");
            bytes = decode_data_uri(*image.uri);
        } else {
            const std::filesystem::path file = files_.resolve(*image.uri);
            context_.charge(file_size_bytes(file), where + "/uri");
            bytes = read_file(file);
        }
    } catch (const FileError& error) {
        context_.warn(where + "/uri", std::string(error.what()) + consequence);
    }
    return bytes;
}

std::vector<DecodedImage> AssetImages::decode_all(std::span<const std::span<const std::byte>> sources) {
    ImageDecodeOptions options;
    options.max_total_bytes = context_.bytes_left();
    options.progress = [this](float fraction) { context_.progress(0.4f + 0.6f * fraction, "images"); };
    options.cancel = context_.options().cancel;
    std::vector<DecodedImage> decoded = decode_images(sources, options);
    context_.check_cancel();
    return decoded;
}

std::vector<ImageRgba8> AssetImages::decode_apart(const std::vector<uint32_t>& indices) {
    std::vector<std::span<const std::byte>> sources;
    sources.reserve(indices.size());
    for (const uint32_t index : indices)
        sources.push_back(encoded(index, ""));
    std::vector<DecodedImage> decoded = decode_all(sources);
    std::vector<ImageRgba8> out;
    out.reserve(indices.size());
    for (size_t i = 0; i < indices.size(); ++i) {
        if (!sources[i].empty() && !decoded[i].error.empty()) {
            context_.warn(pointer_to("/images", indices[i]), decoded[i].error);
        }
        context_.charge(decoded[i].pixels.size(), sizeof(Rgba8), pointer_to("/images", indices[i]));
        out.push_back(std::move(decoded[i].pixels));
    }
    return out;
}

void AssetImages::decode(Scene& scene) {
    constexpr const char* white = "; white is used in its place";
    const std::vector<uint32_t> in_use = images_in_use(scene);
    std::vector<std::span<const std::byte>> sources;
    for (const uint32_t image : in_use) {
        context_.check_cancel();
        sources.push_back(encoded(image, white));
    }

    std::vector<DecodedImage> decoded = decode_all(sources);

    std::vector<uint8_t> lost(scene.images.size(), 0);
    for (size_t i = 0; i < in_use.size(); ++i) {
        const uint32_t image = in_use[i];
        if (decoded[i].error.empty() && !decoded[i].pixels.empty()) {
            context_.charge(decoded[i].pixels.size(), sizeof(Rgba8), pointer_to("/images", image));
            scene.images[image].pixels = std::make_shared<const ImageRgba8>(std::move(decoded[i].pixels));
            continue;
        }
        lost[image] = 1;
        if (!sources[i].empty()) {
            context_.warn(pointer_to("/images", image), decoded[i].error + white);
        }
    }
    // Whatever has no pixels now reads as white; white as a normal map would tilt every normal.
    const auto white_texel = std::make_shared<const ImageRgba8>(1, 1, Rgba8(255));
    for (SceneImage& image : scene.images) {
        if (!image.pixels) image.pixels = white_texel;
    }
    for (Material& material : scene.materials) {
        for (TextureRef* normal : {&material.normal, &material.clearcoat.normal}) {
            if (normal->valid() && lost[scene.textures[normal->texture.value].image.value] != 0) *normal = TextureRef{};
        }
        // White would turn and strengthen every highlight.
        if (TextureRef& direction = material.anisotropy.texture;
            direction.valid() && lost[scene.textures[direction.texture.value].image.value] != 0) {
            direction = TextureRef{};
        }
    }
}

}  // namespace candela
