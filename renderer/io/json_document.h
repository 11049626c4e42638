// SPDX-License-Identifier: MIT
// JSON text to a document, with limits that hold before anything recursive sees it.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "renderer/io/load_context.h"

namespace candela {

using Json = nlohmann::json;

// Throws LoadError with line and column for malformed text, for text that is too long, nested too deeply or counts too
// many objects, and for roots other than objects.
Json parse_json(LoadContext& context, std::string_view text);

// A member name as one token of a JSON pointer (RFC 6901: ~ as ~0, / as ~1).
std::string pointer_token(std::string_view name);

}  // namespace candela
