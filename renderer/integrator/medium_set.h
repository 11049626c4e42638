// SPDX-License-Identifier: MIT
// The bodies that a point of a path lies in. Where they overlap, the one of the highest rank is there and hides the
// boundaries of the others (Schmidt and Budge 2002, "Simple Nested Dielectrics in Ray Traced Images").
#pragma once

#include <array>

#include "renderer/world/world.h"

namespace candela {

class MediumSet {
  public:
    // Ids index World::media. Deeper nesting than the set can hold forgets the latest.
    void enter(uint32_t medium) {
        for (uint32_t& slot : ids_) {
            if (slot == medium) return;
            if (slot != invalid_index) continue;
            slot = medium;
            return;
        }
    }
    void leave(uint32_t medium) {
        for (size_t i = 0; i < ids_.size(); ++i) {
            if (ids_[i] != medium) continue;
            for (; i + 1 < ids_.size(); ++i)
                ids_[i] = ids_[i + 1];
            ids_.back() = invalid_index;
        }
    }
    bool empty() const { return ids_[0] == invalid_index; }

    // What is there, leaving one body out; invalid_index: nothing.
    uint32_t present(const World& world, uint32_t without = invalid_index) const {
        uint32_t best = invalid_index;
        for (const uint32_t id : ids_) {
            if (id == invalid_index) break;
            if (id != without && (best == invalid_index || world.media[id].rank > world.media[best].rank)) best = id;
        }
        return best;
    }

  private:
    std::array<uint32_t, 4> ids_{invalid_index, invalid_index, invalid_index, invalid_index};
};

}  // namespace candela
