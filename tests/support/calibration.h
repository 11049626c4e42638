// SPDX-License-Identifier: MIT
// Is the error that a film states its true one? Pictures of several seeds are compared with the mean of the others.
#pragma once

#include <vector>

#include "renderer/film/film.h"
#include "renderer/integrator/integrator.h"

namespace candela::test {

// After so many samples per pixel, averaged over the seeds.
struct Calibration {
    uint32_t spp = 0;
    double true_error = 0;  // mean over pixels of |picture − reference| / (reference + 0.1 · mean of the reference)
    double stated_error = 0;
    double worst_ratio = 0;  // of stated to true error, of the single picture that is farthest from 1
    double covered = 0;      // share of the pixels whose error is within what is stated for 95 % of them
};

// What to compare: the film's own statement, or another one of the same film.
using Statement = FilmStatistics (*)(const Film&);
inline FilmStatistics own_statement(const Film& film) {
    return measure(film);
}

// levels: samples per pixel, rising. The reference of a picture is the mean of the other seeds' pictures at the last
// level; its own error is taken out of the differences. Renders on that many threads.
std::vector<Calibration> calibrate(const World& world, const View& view, const IntegratorSettings& settings,
                                   const std::vector<uint32_t>& levels, uint32_t seeds, unsigned threads,
                                   Statement statement = own_statement);

}  // namespace candela::test
