// SPDX-License-Identifier: MIT
// What the validation found, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "app/validation/runner.h"

namespace candela {

// RMSE relative to the exact value after each count of samples.
struct ConvergenceCurve {
    ValidationTechnique technique;
    std::vector<uint32_t> samples;
    std::vector<double> errors;

    // Of log error over log samples, by least squares.
    double slope() const;
};

std::string table_header();
std::string table_row(const ValidationResult& result);
std::string table_summary(const std::vector<ValidationResult>& results, double seconds);

std::string validation_json(const std::vector<ValidationResult>& results, const std::vector<ConvergenceCurve>& curves,
                            double seconds);

// The plots as SVG texts: L(p) of the strip light, E(r) and the flux of the point light, and convergence.
std::string strip_light_plot(const std::vector<ValidationResult>& results);
std::string point_light_plot(const std::vector<ValidationResult>& results);
std::string convergence_plot(const std::vector<ConvergenceCurve>& curves);

}  // namespace candela
