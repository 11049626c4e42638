// SPDX-License-Identifier: MIT
// The bodies of a world that light enters.
#pragma once

#include "renderer/world/world.h"

namespace candela {

// Fills world.media, one for every placed material with a volume, and Surface::medium.
void gather_media(World& world);

// Warns of faces that two bodies share, where no ray can tell which of them it crosses first.
void warn_of_shared_faces(World& world);

}  // namespace candela
