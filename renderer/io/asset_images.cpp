// SPDX-License-Identifier: MIT
#include "renderer/io/asset_images.h"

#include <utility>

#include "renderer/image/picture_size.h"
#include "renderer/io/materials.h"
#include "renderer/scene/color_mips.h"

namespace candela {

namespace {

// What of a picture's head is looked at before it is decoded.
constexpr uint64_t head_bytes = uint64_t{1} << 16;

}  // namespace

// What is known of an image: how materials use it, and what became of it.
struct AssetImages::State {
    bool color = false, data = false;  // used as sRGB colours, as plain numbers
    bool replaceable = true;           // every texture that uses it has a fallback
    bool tried = false, lost = false;
    std::optional<MipColors> mips;  // as they were asked for
};

AssetImages::AssetImages(LoadContext& context, const Layout& layout, const AssetFiles& files, BufferStore& buffers)
    : context_(context), layout_(layout), files_(files), buffers_(buffers), states_(layout.images.size()) {}

AssetImages::~AssetImages() = default;

void AssetImages::list(Scene& scene) const {
    for (const ImageLayout& image : layout_.images) {
        const bool is_file = image.uri && !is_data_uri(*image.uri);
        scene.images.emplace_back().name = image.name.empty() && is_file ? *image.uri : image.name;
    }
}

std::span<const std::byte> AssetImages::encoded(size_t index) {
    const ImageLayout& image = layout_.images[index];
    const std::string where = pointer_to("/images", index);
    if (image.view) return buffers_.view(*image.view);
    if (!image.uri) {
        context_.warn(where, "has neither uri nor bufferView");
        return {};
    }
    RawBytes& bytes = owned_.emplace_back();
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
        context_.warn(where + "/uri", error.what());
    }
    return bytes;
}

void AssetImages::measure(Scene& scene) {
    for (size_t i = 0; i < scene.images.size(); ++i) {
        context_.check_cancel();
        const std::optional<PictureSize> size = picture_size(encoded(i));
        if (size) scene.images[i].pixel_count = uint64_t{size->width} * size->height;
    }
}

ImageDecodeOptions AssetImages::decode_options() const {
    ImageDecodeOptions options;
    options.max_total_bytes = context_.bytes_left();
    options.limits = image_limits(context_.options());
    options.progress = [this](float fraction) { context_.progress(0.4f + 0.6f * fraction, "images"); };
    options.cancel = context_.options().cancel;
    return options;
}

std::vector<ImageRgba8> AssetImages::decode_apart(const std::vector<uint32_t>& indices) {
    std::vector<std::span<const std::byte>> sources;
    sources.reserve(indices.size());
    for (const uint32_t index : indices)
        sources.push_back(encoded(index));
    std::vector<DecodedImage> decoded = decode_images(sources, decode_options());
    context_.check_cancel();
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

// Occlusion is no use: a path tracer computes it.
void AssetImages::note_uses(const Scene& scene) {
    for (const Material& material : scene.materials) {
        for (const TextureSlot& slot : texture_slots(material)) {
            if (slot.ref == &material.occlusion) continue;
            const Texture& texture = scene.textures[slot.ref->texture.value];
            State& state = states_[texture.image.value];
            (slot.color ? state.color : state.data) = true;
            if (!texture.fallback.valid()) state.replaceable = false;
        }
    }
}

AssetImages::Begun AssetImages::source_of(uint32_t index) {
    Begun out;
    out.image = index;
    out.source.as_color = states_[index].color;
    out.source.as_data = states_[index].data;
    const ImageLayout& image = layout_.images[index];
    const std::string where = pointer_to("/images", index) + "/uri";
    if (image.view) {
        out.source.source = buffers_.view(*image.view);
    } else if (!image.uri) {
        out.unread = "has neither uri nor bufferView";
    } else if (is_data_uri(*image.uri)) {
        out.source_bytes = data_uri_bound_bytes(*image.uri);
        out.source.source = DataUri{*image.uri};
    } else {
        try {
            const std::filesystem::path file = files_.resolve(*image.uri);
            out.source_bytes = file_size_bytes(file);
            out.source.source = file;
        } catch (const FileError& error) {
            out.unread = error.what();
        }
    }
    context_.charge(out.source_bytes, where);
    return out;
}

std::vector<AssetImages::Begun> AssetImages::sources_of_untried(const Scene& scene) {
    const std::vector<std::optional<MipColors>> mips = wanted_mips(scene);
    std::vector<Begun> out;
    for (uint32_t image = 0; image < states_.size(); ++image) {
        State& state = states_[image];
        if (state.tried || !(state.color || state.data)) continue;
        context_.check_cancel();
        state.tried = true;
        out.push_back(source_of(image));
        out.back().source.mips = state.mips = mips[image];
    }
    return out;
}

void AssetImages::begin(Scene& scene) {
    note_uses(scene);
    begun_ = sources_of_untried(scene);
    if (begun_.empty()) return;

    // Which of those whose alpha decides anything have none.
    std::vector<uint8_t> decides(states_.size(), 0);
    for (const Material& material : scene.materials) {
        if (material.alpha_mode != AlphaMode::opaque && material.base_color.valid())
            decides[scene.textures[material.base_color.texture.value].image.value] = 1;
    }
    for (const Begun& each : begun_) {
        if (decides[each.image] == 0 || !each.unread.empty()) continue;
        std::optional<PictureSize> size;
        if (const auto* bytes = std::get_if<std::span<const std::byte>>(&each.source.source)) {
            size = picture_size(*bytes);
        } else if (const auto* file = std::get_if<std::filesystem::path>(&each.source.source)) {
            try {
                size = picture_size(read_file(*file, head_bytes));
            } catch (const FileError&) {
                size.reset();  // the decoder will say it
            }
        }
        if (size && size->opaque) scene.images[each.image].alpha = ImageAlpha::opaque;
    }
    start();
    context_.set_relief([this] { drop(); });
}

void AssetImages::start() {
    ImageDecodeOptions options = decode_options();
    options.book = [this](uint64_t bytes) {
        if (!context_.try_charge(bytes)) return false;
        booked_bytes_ += bytes;
        return true;
    };
    std::vector<EncodedImage> sources;
    sources.reserve(begun_.size());
    for (const Begun& each : begun_)
        sources.push_back(each.source);
    decoding_ = std::make_unique<ImageDecoding>(std::move(sources), options);
}

void AssetImages::drop() {
    decoding_.reset();
    context_.release(booked_bytes_.exchange(0));
}

// What was begun. Where there was not memory enough for it beside the rest of the load, all is decoded now in the order
// of the file, which tells what still fits.
std::vector<DecodedImage> AssetImages::collect() {
    context_.set_relief(nullptr);
    std::vector<DecodedImage> out;
    if (decoding_) {
        out = decoding_->finish();
        decoding_.reset();
        context_.check_cancel();
        const bool complete =
            std::none_of(out.begin(), out.end(), [](const DecodedImage& image) { return image.too_much; });
        if (complete) {
            booked_bytes_ = 0;
            return out;
        }
        out.clear();
        drop();
    }
    std::vector<EncodedImage> sources;
    for (const Begun& each : begun_)
        sources.push_back(each.source);
    ImageDecodeOptions options = decode_options();
    options.threads = 1;
    out = ImageDecoding(std::move(sources), options).finish();
    context_.check_cancel();
    for (size_t i = 0; i < out.size(); ++i)
        context_.charge(out[i].booked_bytes, pointer_to("/images", begun_[i].image));
    return out;
}

// Gives the scene what was begun.
void AssetImages::take(Scene& scene) {
    std::vector<DecodedImage> decoded = collect();
    for (size_t i = 0; i < begun_.size(); ++i) {
        const Begun& each = begun_[i];
        State& state = states_[each.image];
        DecodedImage& result = decoded[i];
        const std::string where = pointer_to("/images", each.image);
        context_.release(each.source_bytes);
        if (each.unread.empty() && result.error.empty() && !result.pixels.empty()) {
            // A picture whose head says nothing was not booked.
            if (result.booked_bytes == 0) context_.charge(result.pixels.size(), sizeof(Rgba8), where);
            SceneImage& image = scene.images[each.image];
            image.pixels = std::make_shared<const ImageRgba8>(std::move(result.pixels));
            image.alpha = result.alpha;
            if (each.source.mips)
                image.smaller = std::make_shared<const std::vector<ImageRgba8>>(std::move(result.smaller));
            for (const std::string& oddity : result.oddities)
                context_.warn(where, oddity);
            continue;
        }
        state.lost = true;
        scene.images[each.image].alpha = ImageAlpha::unknown;
        const char* consequence =
            state.replaceable ? "; the texture's other image is used in its place" : "; white is used in its place";
        const bool no_source = !each.unread.empty() && !layout_.images[each.image].uri;
        const bool of_uri = !no_source && (!each.unread.empty() || result.unread);
        context_.warn(of_uri ? where + "/uri" : where,
                      (each.unread.empty() ? result.error : each.unread) + consequence);
        context_.release(result.booked_bytes);
    }
    begun_.clear();
}

void AssetImages::finish(Scene& scene) {
    take(scene);
    // A second round for textures that have another image.
    bool replaced = false;
    for (Texture& texture : scene.textures) {
        if (!texture.image.valid() || !states_[texture.image.value].lost || !texture.fallback.valid()) continue;
        texture.image = std::exchange(texture.fallback, ImageId{});
        replaced = true;
    }
    if (replaced) {
        note_uses(scene);
        begun_ = sources_of_untried(scene);
        start();
        take(scene);
    }
    // A texture that has changed its image may want other smaller levels of it.
    const std::vector<std::optional<MipColors>> mips = wanted_mips(scene);
    for (size_t i = 0; i < mips.size(); ++i) {
        if (mips[i] != states_[i].mips) scene.images[i].smaller.reset();
    }
    make_color_mips(scene);

    // Whatever has no pixels now reads as white; white as a normal map would tilt every normal.
    const auto white_texel = std::make_shared<const ImageRgba8>(1, 1, Rgba8(255));
    for (SceneImage& image : scene.images) {
        if (!image.pixels) {
            image.pixels = white_texel;
            image.alpha = ImageAlpha::opaque;
        }
    }
    for (Material& material : scene.materials) {
        for (TextureRef* normal : {&material.normal, &material.clearcoat.normal}) {
            if (normal->valid() && states_[scene.textures[normal->texture.value].image.value].lost)
                *normal = TextureRef{};
        }
        // White would turn and strengthen every highlight.
        if (TextureRef& direction = material.anisotropy.texture;
            direction.valid() && states_[scene.textures[direction.texture.value].image.value].lost) {
            direction = TextureRef{};
        }
    }
}

}  // namespace candela
