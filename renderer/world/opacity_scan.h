// SPDX-License-Identifier: MIT
// Which primitives let light through somewhere, so that only they pay for the opacity function.
#pragma once

#include "renderer/world/world.h"

namespace candela {

class OpacityScan {
  public:
    // Looks at each picture once, unless its decoder has, and writes what it sees into world.image_alpha. before: a
    // world of the same scene, or null.
    OpacityScan(World& world, const World* before);

    // Whether it may be transparent in this pose or another, in whichever of the file's variants: then switching needs
    // no other accelerator.
    bool may_be_transparent(const Primitive& primitive);

  private:
    bool lets_light_through(MaterialId id, const Primitive& primitive);
    bool texture_may_have_alpha(TextureId id);

    World& world_;
    std::vector<uint8_t> animated_, transmission_animated_;  // by material
};

}  // namespace candela
