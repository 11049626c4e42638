// SPDX-License-Identifier: MIT
#include "app/validation/runner.h"

#include <cmath>
#include <thread>

#include "app/render_job.h"
#include "renderer/math/hash.h"
#include "renderer/math/running_mean.h"

namespace candela {

namespace {

constexpr uint32_t samples_per_batch = 4096;
constexpr uint32_t batches_per_round = 32;
constexpr uint32_t most_rounds = 64;

bool is_set(const std::atomic<bool>* flag) {
    return flag != nullptr && flag->load(std::memory_order_relaxed);
}

}  // namespace

double ValidationResult::z() const {
    // A case without noise leaves the rounding of single precision.
    constexpr double rounding = 1.5e-6;
    const double scale = std::max(standard_error, rounding * std::abs(of->exact));
    const double difference = estimate - of->exact;
    return difference == 0 ? 0 : difference / scale;
}

bool ValidationResult::passed() const {
    if (samples == 0 || non_finite > 0) return false;
    return std::abs(z()) <= largest_z && standard_error <= largest_relative_error * std::abs(of->exact);
}

ValidationRunner::ValidationRunner(std::string folder, unsigned threads, uint32_t seed, const std::atomic<bool>* cancel)
    : folder_(std::move(folder)),
      pool_(threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency())),
      seed_(seed),
      cancel_(cancel) {}

const World& ValidationRunner::world_of(const ValidationCase& c) {
    const std::string key = c.scene + (c.sky ? " sky " + std::to_string(*c.sky) : "");
    std::shared_ptr<const World>& world = worlds_[key];
    if (!world) {
        RenderOptions options;
        options.scene = folder_ + "/" + c.scene;
        options.sky = Vec3(c.sky.value_or(0.0f));
        world = prepare_render(
                    options, [](const char*, double) {}, cancel_)
                    .world;
    }
    return *world;
}

void ValidationRunner::for_each(size_t count, const std::function<void(size_t)>& work) {
    std::atomic<size_t> next{0};
    pool_.run([&](unsigned) {
        for (size_t i = next++; i < count && !is_set(cancel_); i = next++)
            work(i);
    });
}

double ValidationRunner::batch(const World& world, const ValidationCase& c, const ValidationTechnique& technique,
                               uint32_t seed, uint32_t samples, std::atomic<uint64_t>& non_finite) const {
    IntegratorSettings settings;
    settings.estimator = technique.estimator;
    settings.sampler = technique.sampler;
    settings.filter = PixelFilter::box;
    settings.seed = seed;
    RayCounts counts;
    double sum = 0;
    const auto add = [&](const Vec3& radiance, double weight) {
        if (is_finite(radiance)) {
            sum += static_cast<double>(luminance(radiance)) * weight;
        } else {
            ++non_finite;
        }
    };
    // Those who share paths see one place from the pixels of a few groups.
    const Vec2u extent = technique.shares_paths ? Vec2u(8, 4) : Vec2u(1);
    std::vector<PixelSample> pixels(size_t{extent.x} * extent.y);
    std::vector<RadianceSample> traced(pixels.size());
    for (uint32_t i = 0; i < samples / pixels.size(); ++i) {
        // Where to look comes from a sequence of its own, so that it does not share dimensions with the path.
        Sampler where(technique.sampler, Vec2u(7919, 104729), i, hash_combine(seed, 0x5eed));
        Probe probe = c.probe(where.next_2d());
        probe.view.extent = extent;
        for (uint32_t k = 0; PixelSample & pixel : pixels) {
            pixel = {static_cast<uint16_t>(k % extent.x), static_cast<uint16_t>(k / extent.x), i,
                     technique.shares_paths ? PathSharing::group : PathSharing::none};
            ++k;
        }
        trace_samples(world, probe.view, settings, pixels, traced, counts);
        for (const RadianceSample& sample : traced)
            add(sample.radiance, probe.weight);
    }
    return sum / samples;
}

ValidationResult ValidationRunner::run(const ValidationCase& c, const ValidationTechnique& technique) {
    const World& world = world_of(c);
    ValidationResult result;
    result.of = &c;
    result.technique = technique;
    RunningMean means;
    std::atomic<uint64_t> non_finite{0};
    // Batches are independent whatever the sampler, for each has its own seed. Their scatter alone decides when to
    // stop, a little below what is demanded.
    for (uint32_t round = 0; round < most_rounds && !is_set(cancel_); ++round) {
        std::vector<double> estimates(batches_per_round);
        for_each(batches_per_round, [&](size_t b) {
            const uint32_t number = round * batches_per_round + static_cast<uint32_t>(b);
            estimates[b] = batch(world, c, technique, hash_combine(seed_, number), samples_per_batch, non_finite);
        });
        if (is_set(cancel_)) break;
        for (const double estimate : estimates)
            means.add(estimate);
        if (means.standard_error() <= 0.7 * largest_relative_error * std::abs(c.exact)) break;
    }
    result.estimate = means.mean();
    result.standard_error = means.count() > 0 ? means.standard_error() : 0;
    result.samples = means.count() * samples_per_batch;
    result.non_finite = non_finite;
    return result;
}

std::vector<double> ValidationRunner::convergence(const ValidationCase& c, const ValidationTechnique& technique,
                                                  const std::vector<uint32_t>& counts) {
    constexpr uint32_t runs = 128;
    const World& world = world_of(c);
    std::atomic<uint64_t> non_finite{0};
    std::vector<double> errors;
    for (size_t k = 0; k < counts.size(); ++k) {
        std::vector<double> estimates(runs, c.exact);
        for_each(runs, [&](size_t r) {
            const auto number = static_cast<uint32_t>(k * runs + r);
            estimates[r] = batch(world, c, technique, hash_combine(seed_ + 1, number), counts[k], non_finite);
        });
        double squares = 0;
        for (const double estimate : estimates)
            squares += (estimate / c.exact - 1) * (estimate / c.exact - 1);
        errors.push_back(std::sqrt(squares / runs));
    }
    return errors;
}

}  // namespace candela
