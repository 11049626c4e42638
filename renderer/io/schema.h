// SPDX-License-Identifier: MIT
// The parts of glTF's schema that later steps rely on: types, lengths, and every index in range.
#pragma once

#include "renderer/io/json_document.h"

namespace candela {

// Throws LoadError with the pointer of the first property that breaks a rule. Afterwards integers are stored as
// integers and numbers as floating point, whichever way the file wrote them ("3.0" for 3 is legal JSON for an index).
void validate_document(LoadContext& context, Json& document);

}  // namespace candela
