// SPDX-License-Identifier: MIT
#include "app/validation/report.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/validation/svg_plot.h"

namespace candela {

namespace {

size_t failures(const std::vector<ValidationResult>& results) {
    return static_cast<size_t>(
        std::count_if(results.begin(), results.end(), [](const ValidationResult& r) { return !r.passed(); }));
}

// What is plotted of results of one group and technique, over the parameter in their names.
PlotSeries measured(const std::vector<ValidationResult>& results, const std::string& group, const char* parameter,
                    const ValidationTechnique& technique) {
    PlotSeries series;
    series.label = name_of(technique);
    series.style = PlotStyle::points;
    for (const ValidationResult& r : results) {
        const size_t at = r.of->name.find(parameter);
        if (r.of->group != group || at == std::string::npos || name_of(r.technique) != name_of(technique)) continue;
        series.points.push_back(
            {std::atof(r.of->name.c_str() + at + std::strlen(parameter)), r.estimate, largest_z * r.standard_error});
    }
    return series;
}

PlotSeries curve(const std::string& label, double from, double to, bool logarithmic, double (*f)(double)) {
    PlotSeries series;
    series.label = label;
    series.style = PlotStyle::line;
    constexpr int steps = 200;
    for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const double x = logarithmic ? from * std::pow(to / from, t) : from + (to - from) * t;
        series.points.push_back({x, f(x), 0});
    }
    return series;
}

}  // namespace

double ConvergenceCurve::slope() const {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (size_t i = 0; i < samples.size(); ++i) {
        if (!(errors[i] > 0)) continue;
        const double x = std::log(static_cast<double>(samples[i])), y = std::log(errors[i]);
        n += 1;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    const double spread = n * sxx - sx * sx;
    return spread > 0 ? (n * sxy - sx * sy) / spread : 0;
}

std::string table_header() {
    return fmt::format("{:<13}{:<40}{:<18}{:>12}{:>12}{:>11}{:>7}{:>10}  {}\n", "group", "case", "technique", "exact",
                       "estimate", "std error", "z", "samples", "verdict");
}

std::string table_row(const ValidationResult& r) {
    return fmt::format("{:<13}{:<40}{:<18}{:>12.7g}{:>12.7g}{:>11.1e}{:>7.2f}{:>10}  {}\n", r.of->group, r.of->name,
                       name_of(r.technique), r.of->exact, r.estimate, r.standard_error, r.z(), r.samples,
                       r.passed() ? "ok" : "FAILED");
}

std::string table_summary(const std::vector<ValidationResult>& results, double seconds) {
    const size_t failed = failures(results);
    return fmt::format(
        "\n{} of {} agree with the exact values within {:g} standard errors of at most {:g} % ({:.0f} s)\n",
        results.size() - failed, results.size(), largest_z, 100 * largest_relative_error, seconds);
}

std::string validation_json(const std::vector<ValidationResult>& results, const std::vector<ConvergenceCurve>& curves,
                            double seconds) {
    using Json = nlohmann::ordered_json;
    Json cases = Json::array();
    for (const ValidationResult& r : results) {
        cases.push_back({{"group", r.of->group},
                         {"case", r.of->name},
                         {"technique", name_of(r.technique)},
                         {"formula", r.of->formula},
                         {"scene", r.of->scene},
                         {"exact", r.of->exact},
                         {"estimate", r.estimate},
                         {"standard_error", r.standard_error},
                         {"z", std::isfinite(r.z()) ? Json(r.z()) : Json(nullptr)},
                         {"samples", r.samples},
                         {"non_finite", r.non_finite},
                         {"passed", r.passed()}});
    }
    Json convergence = Json::array();
    for (const ConvergenceCurve& c : curves) {
        convergence.push_back({{"technique", name_of(c.technique)},
                               {"samples", c.samples},
                               {"relative_rmse", c.errors},
                               {"slope", c.slope()}});
    }
    const Json out{{"passed", failures(results) == 0},
                   {"failed", failures(results)},
                   {"seconds", seconds},
                   {"cases", cases},
                   {"convergence", convergence}};
    return out.dump(2) + "\n";
}

std::string strip_light_plot(const std::vector<ValidationResult>& results) {
    SvgPlot plot;
    plot.title = "Strip light over a white plane: reflected radiance, bars of 4 standard errors";
    plot.x = {"p, distance from the middle [m]", -0.15, 3.2, false};
    plot.y = {"L(p)", 0, 0.8, false};
    plot.series.push_back(curve("exact", plot.x.lower, 3.2, false, strip_light_radiance));
    for (const Estimator estimator : {Estimator::mis, Estimator::light, Estimator::bsdf})
        plot.series.push_back(measured(results, "strip light", "p = ", {estimator, SamplerKind::sobol}));
    // The bars are smaller than the dots there: the differences by themselves.
    SvgPlot difference;
    difference.title = "Estimate over exact value, bars of 4 standard errors";
    difference.x = plot.x;
    difference.y = {"difference [%]", -0.4, 0.4, false};
    difference.series.push_back(curve("exact", difference.x.lower, 3.2, false, [](double) { return 0.0; }));
    for (size_t k = 1; k < plot.series.size(); ++k) {
        PlotSeries series = plot.series[k];
        for (PlotPoint& p : series.points) {
            const double exact = strip_light_radiance(p.x);
            p = {p.x, 100 * (p.y / exact - 1), 100 * p.bar / exact};
        }
        difference.series.push_back(series);
    }
    return stack_plots({plot, difference});
}

std::string point_light_plot(const std::vector<ValidationResult>& results) {
    SvgPlot irradiance;
    irradiance.title = "Point light of 100 W, 1 m above a plane: irradiance";
    irradiance.x = {"r [m]", -0.15, 5.2, false};
    irradiance.y = {"E(r) [W/m2]", 0, 9, false};
    irradiance.series.push_back(curve("exact", 0, 5.2, false, point_light_irradiance));
    irradiance.series.push_back(measured(results, "point light", "r = ", {}));
    SvgPlot flux;
    flux.title = "Its flux through growing discs: towards half of the light, 50 W";
    flux.x = {"R [m]", 0.5, 200, true};
    flux.y = {"flux [W]", 0, 60, false};
    flux.series.push_back(curve("exact", 0.5, 200, true, point_light_flux));
    flux.series.push_back(measured(results, "point light", "R = ", {}));
    return stack_plots({irradiance, flux});
}

std::string convergence_plot(const std::vector<ConvergenceCurve>& curves) {
    SvgPlot plot;
    plot.title = "Strip light, p = 0.5: relative error over samples";
    plot.x = {"samples", 1, 1, true};
    plot.y = {"RMSE / exact", 1, 1e-3, true};
    for (const ConvergenceCurve& c : curves) {
        PlotSeries series;
        series.label = fmt::format("{}: slope {:.2f}", name_of(c.technique), c.slope());
        series.style = PlotStyle::line_with_points;
        for (size_t i = 0; i < c.samples.size(); ++i) {
            if (!(c.errors[i] > 0)) continue;
            const auto samples = static_cast<double>(c.samples[i]);
            series.points.push_back({samples, c.errors[i], 0});
            plot.x.upper = std::max(plot.x.upper, samples);
            plot.y.lower = std::min(plot.y.lower, c.errors[i]);
            plot.y.upper = std::max(plot.y.upper, c.errors[i]);
        }
        plot.series.push_back(series);
    }
    // Whole decades.
    plot.x.upper = std::pow(10.0, std::ceil(std::log10(plot.x.upper)));
    plot.y.lower = std::pow(10.0, std::floor(std::log10(plot.y.lower)));
    plot.y.upper = std::pow(10.0, std::ceil(std::log10(plot.y.upper)));
    return plot.text();
}

}  // namespace candela
