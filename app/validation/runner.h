// SPDX-License-Identifier: MIT
// Runs cases: batches of samples until the standard error is small enough to mean something.
#pragma once

#include <atomic>
#include <map>
#include <memory>

#include "app/validation/case.h"
#include "renderer/session/worker_pool.h"

namespace candela {

struct ValidationResult {
    const ValidationCase* of = nullptr;
    ValidationTechnique technique;
    double estimate = 0;
    double standard_error = 0;
    uint64_t samples = 0;
    uint64_t non_finite = 0;

    // Standard errors between estimate and exact value; infinite where the exact value is 0 and the estimate is not.
    double z() const;
    bool passed() const;
};

// Within this many standard errors, at a relative standard error of at most this much.
inline constexpr double largest_z = 4.0;
inline constexpr double largest_relative_error = 1e-3;

class ValidationRunner {
  public:
    // folder: where the scenes lie. threads: 0 = all cores; the results do not depend on it.
    ValidationRunner(std::string folder, unsigned threads, uint32_t seed, const std::atomic<bool>* cancel);

    // Throws CommandError where a scene can't be read. An interrupted run returns what it has.
    ValidationResult run(const ValidationCase& validation_case, const ValidationTechnique& technique);

    // Root mean square error relative to the exact value after each of `counts` samples, over many independent runs.
    std::vector<double> convergence(const ValidationCase& validation_case, const ValidationTechnique& technique,
                                    const std::vector<uint32_t>& counts);

  private:
    // The mean of `samples` samples under a seed of its own.
    double batch(const World& world, const ValidationCase& c, const ValidationTechnique& technique, uint32_t seed,
                 uint32_t samples, std::atomic<uint64_t>& non_finite) const;
    const World& world_of(const ValidationCase& c);
    void for_each(size_t count, const std::function<void(size_t)>& work);

    std::string folder_;
    WorkerPool pool_;
    uint32_t seed_;
    const std::atomic<bool>* cancel_;
    std::map<std::string, std::shared_ptr<const World>> worlds_;
};

}  // namespace candela
