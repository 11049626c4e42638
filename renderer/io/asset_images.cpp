// SPDX-License-Identifier: MIT
#include "renderer/io/asset_images.h"

#include <utility>

#include "renderer/image/picture_size.h"
#include "renderer/io/materials.h"

namespace candela {

void AssetImages::list(Scene& scene) const {
    for (const ImageLayout& image : layout_.images) {
        const bool is_file = image.uri && !is_data_uri(*image.uri);
        scene.images.emplace_back().name = image.name.empty() && is_file ? *image.uri : image.name;
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

void AssetImages::measure(Scene& scene) {
    for (size_t i = 0; i < scene.images.size(); ++i) {
        context_.check_cancel();
        const std::optional<PictureSize> size = picture_size(encoded(i, ""));
        if (size) scene.images[i].pixel_count = uint64_t{size->width} * size->height;
    }
}

std::vector<DecodedImage> AssetImages::decode_all(std::span<const std::span<const std::byte>> sources) {
    ImageDecodeOptions options;
    options.max_total_bytes = context_.bytes_left();
    options.limits = image_limits(context_.options());
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

// What is known of an image: how materials use it, and what became of it.
struct AssetImages::State {
    bool color = false, data = false;  // used as sRGB colours, as plain numbers
    bool replaceable = true;           // every texture that uses it has a fallback
    bool tried = false, lost = false;
};

// Decodes the images in use that have not been tried yet. Occlusion is no use: a path tracer computes it.
void AssetImages::decode_used(Scene& scene, std::vector<State>& states) {
    for (const Material& material : scene.materials) {
        for (const TextureSlot& slot : texture_slots(material)) {
            if (slot.ref == &material.occlusion) continue;
            const Texture& texture = scene.textures[slot.ref->texture.value];
            State& state = states[texture.image.value];
            (slot.color ? state.color : state.data) = true;
            if (!texture.fallback.valid()) state.replaceable = false;
        }
    }
    const auto consequence = [&](uint32_t image) {
        return states[image].replaceable ? "; the texture's other image is used in its place"
                                         : "; white is used in its place";
    };
    std::vector<uint32_t> in_use;
    std::vector<std::span<const std::byte>> sources;
    for (uint32_t image = 0; image < states.size(); ++image) {
        State& state = states[image];
        if (state.tried || !(state.color || state.data)) continue;
        context_.check_cancel();
        state.tried = true;
        in_use.push_back(image);
        sources.push_back(encoded(image, consequence(image)));
    }

    std::vector<DecodedImage> decoded = decode_all(sources);

    for (size_t i = 0; i < in_use.size(); ++i) {
        const uint32_t image = in_use[i];
        State& state = states[image];
        const std::string where = pointer_to("/images", image);
        if (decoded[i].error.empty() && !decoded[i].pixels.empty()) {
            context_.charge(decoded[i].pixels.size(), sizeof(Rgba8), where);
            scene.images[image].pixels = std::make_shared<const ImageRgba8>(std::move(decoded[i].pixels));
            for (const std::string& oddity : basisu_oddities(sources[i], state.color, state.data))
                context_.warn(where, oddity);
            continue;
        }
        state.lost = true;
        if (!sources[i].empty()) context_.warn(where, decoded[i].error + consequence(image));
    }
}

void AssetImages::decode(Scene& scene) {
    std::vector<State> states(scene.images.size());
    decode_used(scene, states);
    // A second round for textures that have another image.
    bool replaced = false;
    for (Texture& texture : scene.textures) {
        if (!texture.image.valid() || !states[texture.image.value].lost || !texture.fallback.valid()) continue;
        texture.image = std::exchange(texture.fallback, ImageId{});
        replaced = true;
    }
    if (replaced) decode_used(scene, states);

    // Whatever has no pixels now reads as white; white as a normal map would tilt every normal.
    const auto white_texel = std::make_shared<const ImageRgba8>(1, 1, Rgba8(255));
    for (SceneImage& image : scene.images) {
        if (!image.pixels) image.pixels = white_texel;
    }
    for (Material& material : scene.materials) {
        for (TextureRef* normal : {&material.normal, &material.clearcoat.normal}) {
            if (normal->valid() && states[scene.textures[normal->texture.value].image.value].lost)
                *normal = TextureRef{};
        }
        // White would turn and strengthen every highlight.
        if (TextureRef& direction = material.anisotropy.texture;
            direction.valid() && states[scene.textures[direction.texture.value].image.value].lost) {
            direction = TextureRef{};
        }
    }
}

}  // namespace candela
