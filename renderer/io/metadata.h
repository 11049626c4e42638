// SPDX-License-Identifier: MIT
// What a file says about itself: asset, and the packets of KHR_xmp_json_ld and of the older KHR_xmp.
#pragma once

#include "renderer/io/json_document.h"

namespace candela {

// Fills scene.metadata: at most max_metadata_entries, each cut to max_metadata_bytes.
void load_metadata(LoadContext& context, const Json& document, Scene& scene);

inline constexpr size_t max_metadata_entries = 1000;
inline constexpr size_t max_metadata_bytes = 500;

}  // namespace candela
