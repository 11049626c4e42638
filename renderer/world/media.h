// SPDX-License-Identifier: MIT
// The bodies of a world that light enters.
#pragma once

#include "renderer/world/world.h"

namespace candela {

// Fills world.media, one for every placed material with a volume, and Surface::medium; warns of faces that two bodies
// share, where no ray can tell which of them it crosses first.
void gather_media(World& world);

}  // namespace candela
