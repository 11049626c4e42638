// SPDX-License-Identifier: MIT
#include "app/viewer/steady_figures.h"

namespace candela {

namespace {

constexpr double seconds_per_sample = 0.1;

}  // namespace

void make_steady(SessionStatus& status) {
    status.render_seconds = seconds_per_sample * status.spp;
    status.rays_per_second = status.spp > 0 ? static_cast<double>(status.rays.total()) / status.render_seconds : 0;
    status.last_cancel_seconds = status.last_first_frame_seconds = status.last_reproject_seconds = 0;
}

ErrorHistory steady(const ErrorHistory& history) {
    ErrorHistory out;
    for (ErrorPoint point : history.points()) {
        point.seconds = seconds_per_sample * point.spp;
        out.add(point);
    }
    return out;
}

}  // namespace candela
