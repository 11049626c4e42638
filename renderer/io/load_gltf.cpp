// SPDX-License-Identifier: MIT
#include "renderer/io/load_gltf.h"

#include <nlohmann/json.hpp>

#include "renderer/io/accessors.h"
#include "renderer/io/extensions.h"
#include "renderer/io/glb_container.h"
#include "renderer/io/images.h"
#include "renderer/io/materials.h"
#include "renderer/io/meshes.h"
#include "renderer/io/nodes.h"
#include "renderer/io/schema.h"
#include "renderer/io/structure.h"
#include "renderer/io/tinygltf.h"

namespace candela {
namespace {

std::vector<std::byte> read_asset(LoadContext& context, const std::filesystem::path& path) {
    try {
        const uint64_t size = file_size_bytes(path);
        context.charge(size, "");
        return read_file(path);
    } catch (const FileError& error) {
        context.fail("", error.what());
    }
}

// The images that some material looks at; occlusion is not looked at, since light transport computes it.
std::vector<bool> images_in_use(Scene& scene) {
    std::vector<bool> used(scene.images.size(), false);
    for (Material& material : scene.materials) {
        for (const TextureSlot& slot : texture_slots(material)) {
            if (slot.ref == &material.occlusion || !slot.ref->valid()) continue;
            const ImageId image = scene.textures[slot.ref->texture.value].image;
            if (image.valid()) used[image.value] = true;
        }
    }
    return used;
}

// Encoded bytes of every image in use; those that cannot be read are empty, with a warning.
class EncodedImages {
  public:
    EncodedImages(LoadContext& context, const Layout& layout, BufferStore& buffers, const AssetFiles& files,
                  const std::vector<bool>& used)
        : bytes(layout.images.size()), owned_(layout.images.size()) {
        for (size_t i = 0; i < layout.images.size(); ++i) {
            if (!used[i]) continue;
            const ImageLayout& image = layout.images[i];
            try {
                if (image.view) {
                    bytes[i] = buffers.view(*image.view);
                } else if (image.uri) {
                    owned_[i] = is_data_uri(*image.uri) ? decode_data_uri(*image.uri) : read_file(files.resolve(*image.uri));
                    bytes[i] = owned_[i];
                }
            } catch (const FileError& error) {
                context.warn(pointer_to("/images", i), std::string(error.what()) + "; white is used");
                unreadable.push_back(i);
            }
        }
    }

    std::vector<std::span<const std::byte>> bytes;
    std::vector<size_t> unreadable;

  private:
    std::vector<std::vector<std::byte>> owned_;
};

void load_images(LoadContext& context, const Layout& layout, BufferStore& buffers, const AssetFiles& files, Scene& scene) {
    const std::vector<bool> used = images_in_use(scene);
    const EncodedImages encoded(context, layout, buffers, files, used);
    std::vector<size_t> which;
    std::vector<std::span<const std::byte>> spans;
    for (size_t i = 0; i < used.size(); ++i) {
        const bool unreadable =
            std::find(encoded.unreadable.begin(), encoded.unreadable.end(), i) != encoded.unreadable.end();
        if (!used[i] || unreadable) continue;
        which.push_back(i);
        spans.push_back(encoded.bytes[i]);
    }
    ImageDecodeOptions options;
    options.max_total_bytes = context.bytes_left();
    options.cancel = context.options().cancel;
    options.progress = [&](float fraction) { context.progress(0.4f + 0.6f * fraction, "images"); };
    std::vector<DecodedImage> decoded = decode_images(spans, options);
    context.check_cancel();
    for (size_t k = 0; k < which.size(); ++k) {
        if (!decoded[k].error.empty()) {
            context.warn(pointer_to("/images", which[k]), decoded[k].error + "; white is used");
        }
        scene.images[which[k]].pixels = std::move(decoded[k].pixels);
    }
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, Diagnostics& diagnostics, const LoadOptions& options) try {
    LoadContext context(path.string(), diagnostics, options);
    context.progress(0.0f, "reading");

    // Take the container apart.
    const std::vector<std::byte> bytes = read_asset(context, path);
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::optional<std::span<const std::byte>> glb_bin;
    if (looks_like_glb(bytes)) {
        try {
            const GlbChunks chunks = parse_glb(bytes);
            text = chunks.json;
            glb_bin = chunks.bin;
        } catch (const std::runtime_error& error) {
            context.fail("", error.what());
        }
    }

    // Check the document before anything else reads it.
    Json document = parse_json(context, text);
    validate_document(context, document);
    Scene scene;
    scene.source = path.string();
    scene.extensions = treat_extensions(context, document);
    const Layout layout = read_layout(context, document);
    tinygltf::Model model;
    read_structure(context, document, model);
    document = Json();

    // Translate it, bytes first.
    const AssetFiles files(path);
    BufferStore buffers(context, layout, files, glb_bin);
    context.progress(0.1f, "meshes");
    scene.images.resize(layout.images.size());
    for (size_t i = 0; i < layout.images.size(); ++i) scene.images[i].name = layout.images[i].name;
    load_materials(context, model, scene);
    AccessorReader accessors(context, layout, buffers);
    load_meshes(context, model, accessors, scene);
    load_nodes(context, model, scene);
    for (const tinygltf::Animation& animation : model.animations) scene.animation_names.push_back(animation.name);
    if (options.decode_images) load_images(context, layout, buffers, files, scene);
    context.progress(1.0f, "done");
    return scene;
} catch (const std::bad_alloc&) {
    throw LoadError(path.string(), "", "there is not enough memory to load it");
}

}  // namespace candela
