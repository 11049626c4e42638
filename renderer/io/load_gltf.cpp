// SPDX-License-Identifier: MIT
#include "renderer/io/load_gltf.h"

#include <new>

#include <nlohmann/json.hpp>

#include "renderer/io/animations.h"
#include "renderer/io/asset_images.h"
#include "renderer/io/extensions.h"
#include "renderer/io/glb_container.h"
#include "renderer/io/image_based_light.h"
#include "renderer/io/instancing.h"
#include "renderer/io/materials.h"
#include "renderer/io/meshes.h"
#include "renderer/io/metadata.h"
#include "renderer/io/nodes.h"
#include "renderer/io/schema.h"
#include "renderer/io/skins.h"
#include "renderer/io/strokes.h"
#include "renderer/io/structure.h"
#include "renderer/io/tinygltf.h"
#include "renderer/io/variants.h"
#include "renderer/scene/pose.h"

namespace candela {
namespace {

RawBytes read_asset(LoadContext& context, const std::filesystem::path& path) {
    try {
        context.charge(file_size_bytes(path), "");
        return read_file(path, std::numeric_limits<uint64_t>::max(), true);
    } catch (const FileError& error) {
        context.fail("", error.what());
    }
}

GlbChunks split_chunks(LoadContext& context, std::span<const std::byte> bytes) {
    if (!looks_like_glb(bytes)) {
        return {{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, std::nullopt};
    }
    try {
        return parse_glb(bytes);
    } catch (const std::runtime_error& error) {
        context.fail("", error.what());
    }
}

AssetFiles open_directory(LoadContext& context, const std::filesystem::path& path) {
    try {
        return AssetFiles(path);
    } catch (const FileError& error) {
        context.fail("", error.what());
    }
}

std::vector<std::string> files_named_by(const Layout& layout, const AssetFiles& files) {
    std::vector<std::string> out;
    const auto add = [&](const std::optional<std::string>& uri) {
        if (!uri || is_data_uri(*uri)) return;
        if (const std::filesystem::path place = files.place_of(*uri); !place.empty()) out.push_back(place.string());
    };
    for (const auto& buffer : layout.buffers)
        add(buffer.uri);
    for (const auto& image : layout.images)
        add(image.uri);
    return out;
}

void take_rest_pose(LoadContext& context, Scene& scene) {
    charge_posed_meshes(context, scene);
    mark_moving_nodes(scene);
    for (const NodeId node : pose_scene(scene)) {
        context.warn(pointer_to("/nodes", node.value),
                     "its transform in the world, or the shape of its mesh, is not finite; what it holds is not shown");
    }
}

Scene load(LoadContext& context, std::span<const std::byte> bytes, const std::filesystem::path& path) {
    const GlbChunks chunks = split_chunks(context, bytes);
    Json document = parse_json(context, chunks.json);

    // The extensions come first: what a required one means for the rest of the document is not known.
    Scene scene;
    scene.source = context.path();
    validate_document(context, document);
    scene.extensions = treat_extensions(context, document);
    load_metadata(context, document, scene);

    const Layout layout = read_layout(context, document);
    tinygltf::Model model;
    read_structure(context, document, model);
    context.check_cancel();

    const AssetFiles files = open_directory(context, path);
    scene.files = files_named_by(layout, files);
    BufferStore buffers(context, layout, files, chunks.bin);
    AccessorReader accessors(context, layout, buffers);
    AssetImages images(context, layout, files, buffers);

    context.progress(0.1f, "meshes");
    images.list(scene);
    load_materials(context, model, scene);
    load_variants(context, document, scene);
    load_nodes(context, model, scene);
    load_instancing(context, model, accessors, scene);
    load_lights(context, model, scene);
    load_cameras(context, model, scene);
    if (context.options().decode_images) images.begin(scene);
    std::vector<Mesh> meshes = load_meshes(context, model, accessors, scene);
    give_strokes_bodies(context, scene, meshes);

    context.progress(0.3f, "tangents");
    generate_missing_tangents(context, scene, meshes);
    for (Mesh& mesh : meshes)
        scene.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    load_skins(context, document, accessors, scene);
    connect_deformations(context, model, scene);
    load_animations(context, document, accessors, scene);
    take_rest_pose(context, scene);

    if (context.options().decode_images) {
        if (images.any_begun() && context.options().geometry_ready) context.options().geometry_ready(scene);
        context.progress(0.4f, "images");
        images.finish(scene);
        load_image_based_light(context, document, images, scene);
    }
    if (context.options().measure_images) images.measure(scene);
    context.progress(1.0f, "done");
    return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, Diagnostics& diagnostics, const LoadOptions& options) {
    LoadContext context(path.string(), diagnostics, options);
    try {
        context.progress(0.0f, "reading");
        return load(context, read_asset(context, path), path);
    } catch (const std::bad_alloc&) {
        context.fail("", "there is not enough memory to load it");
    }
}

Scene load_gltf(std::span<const std::byte> bytes, const std::filesystem::path& path, Diagnostics& diagnostics,
                const LoadOptions& options) {
    LoadContext context(path.string(), diagnostics, options);
    try {
        return load(context, bytes, path);
    } catch (const std::bad_alloc&) {
        context.fail("", "there is not enough memory to load it");
    }
}

}  // namespace candela
