// SPDX-License-Identifier: MIT
// The KHR_materials extensions that add layers and parameters to a material.
#pragma once

#include <string>

#include "renderer/io/load_context.h"
#include "renderer/io/tinygltf.h"

namespace candela {

// Reads factors and textures of materials into a scene whose textures are already there.
class MaterialReader {
  public:
    MaterialReader(LoadContext& context, const Scene& scene) : context_(context), scene_(scene) {}

    // A texture that has no image, or a texture coordinate set that is not read, is left out with a warning.
    TextureRef texture(int index, int tex_coord, const tinygltf::Value* transform, const std::string& where) const;
    // The textureInfo `name` of an extension; invalid where absent.
    TextureRef texture(const tinygltf::Value& extension, const char* name, const std::string& where) const;

    // Out of range: the nearest value in it, and a warning.
    float clamped(double value, double lowest, double highest, const std::string& where) const;
    float factor(const tinygltf::Value& extension, const char* name, double missing, double highest,
                 const std::string& where) const;
    Vec3 color(const tinygltf::Value& extension, const char* name, double missing, double highest,
               const std::string& where) const;

    void warn(const std::string& where, const std::string& what) const { context_.warn(where, what); }

  private:
    LoadContext& context_;
    const Scene& scene_;
};

// where: the JSON pointer of the material. Needs the core material read before.
void read_material_layers(const MaterialReader& reader, const TinyExtensions& extensions, const std::string& where,
                          Material& out);

}  // namespace candela
