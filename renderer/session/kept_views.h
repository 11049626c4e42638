// SPDX-License-Identifier: MIT
// The samples of views that were left, so that going back to one goes on where it stood.
#pragma once

#include <list>
#include <memory>
#include <optional>

#include "renderer/film/film.h"
#include "renderer/integrator/light_groups.h"
#include "renderer/session/schedule.h"

namespace candela {

// Everything that a render has so far: enough to go on with it later, to the bit.
struct ViewSamples {
    Film film;
    std::optional<Schedule> schedule;
    FilmStatistics statistics;
    ErrorHistory history;
    uint32_t measured_at_spp = 0;
    double render_seconds = 0;
    RayCounts rays;

    uint64_t bytes() const { return film.bytes(); }
    uint32_t complete_samples() const { return schedule ? schedule->complete_samples() : 0; }
};

// What decides every sample of a picture. Does not keep the world alive.
struct ViewKey {
    std::weak_ptr<const World> world;
    View view;
    IntegratorSettings settings;
    std::shared_ptr<const LightGroups> light_groups = nullptr;

    bool operator==(const ViewKey& other) const;
};

class KeptViews {
  public:
    explicit KeptViews(uint64_t budget_bytes) : budget_bytes_(budget_bytes) {}

    // Keeps the samples of a view; where they exceed the budget, the views that were left longest ago go first,
    // bookmarked ones last. Those of worlds that are gone go at once.
    void keep(const ViewKey& key, std::shared_ptr<ViewSamples> samples, bool bookmarked);
    // Gives them back, and keeps them no longer; null: there are none.
    std::shared_ptr<ViewSamples> take(const ViewKey& key);
    // 0: there are none.
    uint32_t samples_of(const ViewKey& key) const;

    size_t count() const { return views_.size(); }
    uint64_t bytes() const;

  private:
    struct Kept {
        ViewKey key;
        std::shared_ptr<ViewSamples> samples;
        bool bookmarked = false;
    };
    void drop_beyond_budget();

    uint64_t budget_bytes_;
    std::list<Kept> views_;  // the one that was left last at the end
};

}  // namespace candela
