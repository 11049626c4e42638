// SPDX-License-Identifier: MIT
// What becomes of each extension a file names: rendered, approximated, ignored with a warning, or refused.
#pragma once

#include <vector>

#include "renderer/io/json_document.h"

namespace candela {

// One entry per name in extensionsUsed and extensionsRequired. Throws LoadError for the first required one that is not
// supported, naming it; warns of the others that are not or not wholly supported. Needs a validated document, or at
// least one whose extension lists are arrays of strings.
std::vector<ExtensionUse> treat_extensions(LoadContext& context, const Json& document);

}  // namespace candela
