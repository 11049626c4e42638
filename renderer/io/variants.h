// SPDX-License-Identifier: MIT
// KHR_materials_variants: the names of a file's variants, and which material a primitive has in each.
#pragma once

#include "renderer/io/json_document.h"

namespace tinygltf {
struct Primitive;
}

namespace candela {

// Fills scene.variant_names and active_variant. Throws ChoiceError, naming those there are, where options.variant is
// none of them.
void load_variants(LoadContext& context, const Json& document, Scene& scene);

// Appends the mappings of a primitive; a second one of the same variant does not count, and is warned of.
void read_variant_mappings(LoadContext& context, const tinygltf::Primitive& primitive, const std::string& where,
                           std::vector<VariantMaterial>& out);

}  // namespace candela
