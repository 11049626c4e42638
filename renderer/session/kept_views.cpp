// SPDX-License-Identifier: MIT
#include "renderer/session/kept_views.h"

#include <algorithm>

namespace candela {

bool ViewKey::operator==(const ViewKey& other) const {
    const bool same_world = !world.owner_before(other.world) && !other.world.owner_before(world);
    return same_world && view == other.view && settings == other.settings && light_groups == other.light_groups;
}

void KeptViews::keep(const ViewKey& key, std::shared_ptr<ViewSamples> samples, bool bookmarked) {
    views_.remove_if([&](const Kept& kept) { return kept.key.world.expired() || kept.key == key; });
    views_.push_back({key, std::move(samples), bookmarked});
    drop_beyond_budget();
}

std::shared_ptr<ViewSamples> KeptViews::take(const ViewKey& key) {
    const auto found = std::find_if(views_.begin(), views_.end(), [&](const Kept& kept) { return kept.key == key; });
    if (found == views_.end()) return nullptr;
    std::shared_ptr<ViewSamples> out = std::move(found->samples);
    views_.erase(found);
    return out;
}

uint32_t KeptViews::samples_of(const ViewKey& key) const {
    const auto found = std::find_if(views_.begin(), views_.end(), [&](const Kept& kept) { return kept.key == key; });
    return found == views_.end() ? 0 : found->samples->complete_samples();
}

uint64_t KeptViews::bytes() const {
    uint64_t sum = 0;
    for (const Kept& kept : views_)
        sum += kept.samples->bytes();
    return sum;
}

void KeptViews::drop_beyond_budget() {
    for (uint64_t now = bytes(); now > budget_bytes_;) {
        auto oldest = std::find_if(views_.begin(), views_.end(), [](const Kept& kept) { return !kept.bookmarked; });
        if (oldest == views_.end()) oldest = views_.begin();
        now -= oldest->samples->bytes();
        views_.erase(oldest);
    }
}

}  // namespace candela
