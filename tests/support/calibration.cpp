// SPDX-License-Identifier: MIT
#include "tests/support/calibration.h"

#include <atomic>
#include <limits>
#include <thread>

#include "renderer/session/schedule.h"

namespace candela::test {

namespace {

// One picture after some samples.
struct State {
    std::vector<double> luminance;
    FilmStatistics stated;
};

// As a session has it: samples share their paths where that pays.
void add_samples(const World& world, const View& view, const IntegratorSettings& settings, uint32_t spp,
                 unsigned threads, Schedule& schedule, Film& film) {
    while (schedule.complete_samples() < spp) {
        const Slice pass = schedule.next(std::numeric_limits<uint32_t>::max());
        std::atomic<uint32_t> next{0};
        const auto work = [&] {
            RayCounts counts;
            std::vector<PixelSample> samples;
            std::vector<RadianceSample> out(max_batch);
            for (uint32_t t = next.fetch_add(1); t < pass.size(); t = next.fetch_add(1)) {
                schedule.list(pass, pass.tile(t), samples);
                trace_batch(world, view, settings, samples, out, counts);
                schedule.note(pass.tile(t), samples, out);
                for (size_t i = 0; i < samples.size(); ++i)
                    film.add({samples[i].x, samples[i].y}, samples[i].index, out[i].radiance, out[i].alpha);
            }
        };
        std::vector<std::thread> others;
        for (unsigned i = 1; i < threads; ++i)
            others.emplace_back(work);
        work();
        for (std::thread& other : others)
            other.join();
    }
}

std::vector<double> luminances(const Film& film) {
    std::vector<double> out;
    out.reserve(film.pixels().size());
    for (const FilmPixel& pixel : film.pixels())
        out.push_back(static_cast<double>(luminance(pixel.radiance_sum)) / std::max(pixel.count, 1u));
    return out;
}

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double each : values)
        sum += each;
    return sum / static_cast<double>(values.size());
}

// Relative errors of one seed's picture against the mean of the others' last ones.
std::vector<double> errors_against_others(const std::vector<std::vector<State>>& states, size_t seed, size_t level) {
    const std::vector<double>& picture = states[seed][level].luminance;
    std::vector<double> reference(picture.size());
    for (size_t other = 0; other < states.size(); ++other) {
        if (other == seed) continue;
        for (size_t i = 0; i < reference.size(); ++i)
            reference[i] += states[other].back().luminance[i] / static_cast<double>(states.size() - 1);
    }
    const double floor = 0.1 * mean_of(reference);
    std::vector<double> out(picture.size());
    for (size_t i = 0; i < out.size(); ++i) {
        const double scale = reference[i] + floor;
        out[i] = scale > 0 ? std::abs(picture[i] - reference[i]) / scale : 0;
    }
    return out;
}

}  // namespace

std::vector<Calibration> calibrate(const World& world, const View& view, const IntegratorSettings& settings,
                                   const std::vector<uint32_t>& levels, uint32_t seeds, unsigned threads,
                                   Statement statement) {
    std::vector<std::vector<State>> states(seeds);
    for (uint32_t seed = 0; seed < seeds; ++seed) {
        IntegratorSettings own = settings;
        own.seed = settings.seed + seed;
        Film film(view.extent);
        Schedule schedule(view.extent, 1, own.may_reuse_paths());
        for (const uint32_t level : levels) {
            add_samples(world, view, own, level, threads, schedule, film);
            states[seed].push_back({luminances(film), statement(film)});
        }
    }

    // What is measured against the others is e² + last²/(n − 1), e being the true error.
    const auto n = static_cast<double>(seeds);
    const auto measured_at = [&](size_t level) {
        double sum = 0;
        for (size_t seed = 0; seed < seeds; ++seed)
            sum += mean_of(errors_against_others(states, seed, level));
        return sum / n;
    };
    const double last_error = measured_at(levels.size() - 1) / std::sqrt(n / (n - 1));

    std::vector<Calibration> out;
    for (size_t level = 0; level < levels.size(); ++level) {
        const double measured = measured_at(level);
        const double share = last_error / measured;
        const double inflation = 1 / std::sqrt(1 - share * share / (n - 1));
        Calibration row{levels[level], measured / inflation, 0, 1, 0};
        for (size_t seed = 0; seed < seeds; ++seed) {
            const FilmStatistics& stated = states[seed][level].stated;
            const std::vector<double> errors = errors_against_others(states, seed, level);
            size_t within = 0;
            for (const double e : errors)
                within += e / inflation <= stated.relative_error_95 ? 1 : 0;
            row.covered += static_cast<double>(within) / static_cast<double>(errors.size()) / n;
            row.stated_error += stated.relative_error / n;
            const double ratio = stated.relative_error / (mean_of(errors) / inflation);
            if (std::abs(std::log(ratio)) > std::abs(std::log(row.worst_ratio))) row.worst_ratio = ratio;
        }
        out.push_back(row);
    }
    return out;
}

}  // namespace candela::test
