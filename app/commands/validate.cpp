// SPDX-License-Identifier: MIT
// candela validate: the path tracer against exact answers.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/progress_bar.h"
#include "app/render_job.h"
#include "app/stopwatch.h"
#include "app/validation/report.h"
#include "renderer/image/atomic_file.h"
#include "renderer/image/codec.h"

namespace candela {

namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
    try {
        write_file_atomically(path, text);
    } catch (const ImageError& error) {
        throw CommandError(ExitStatus::unwritable_output, path.string() + ": " + error.what());
    }
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error && std::filesystem::is_directory(folder)) return;
    throw CommandError(ExitStatus::unwritable_output, folder.string() + ": the folder can't be made: " +
                                                          (error ? error.message() : "a file is there"));
}

// The three estimators on the strip light, with independent samples and all three again by one Sobol curve.
std::vector<ConvergenceCurve> measure_convergence(ValidationRunner& runner, const std::vector<ValidationCase>& cases,
                                                  const std::function<void(double)>& progress) {
    const auto strip = std::find_if(cases.begin(), cases.end(), [](const ValidationCase& c) {
        return c.group == "strip light" && c.name.find("p = 0.5") != std::string::npos;
    });
    std::vector<ConvergenceCurve> curves;
    for (const ValidationTechnique& technique : {ValidationTechnique{Estimator::mis, SamplerKind::independent},
                                                 ValidationTechnique{Estimator::light, SamplerKind::independent},
                                                 ValidationTechnique{Estimator::bsdf, SamplerKind::independent},
                                                 ValidationTechnique{Estimator::mis, SamplerKind::sobol}}) {
        ConvergenceCurve curve{technique, {}, {}};
        for (uint32_t n = 1; n <= 4096; n *= 4)
            curve.samples.push_back(n);
        curve.errors = runner.convergence(*strip, technique, curve.samples);
        curves.push_back(curve);
        progress(static_cast<double>(curves.size()) / 4);
    }
    return curves;
}

}  // namespace

ExitStatus run_validate(const ValidateOptions& options) {
    if (!options.output.empty()) make_folder(options.output);
    const InterruptGuard guard;
    const std::filesystem::path folder = assets_folder() / "validation";
    const std::vector<ValidationCase> cases = validation_cases();
    ValidationRunner runner(folder.string(), options.threads, options.seed, InterruptGuard::flag());
    ProgressBar bar(options.quiet, false);

    // Run all cases, each by all of its techniques, and print each row as it is known.
    size_t total = 0;
    for (const ValidationCase& c : cases)
        total += c.techniques.size();
    const Clock::time_point start = Clock::now();
    std::vector<ValidationResult> results;
    if (!options.json) fmt::print("{}", table_header());
    for (const ValidationCase& c : cases) {
        for (const ValidationTechnique& technique : c.techniques) {
            bar.show("validate", static_cast<double>(results.size()) / static_cast<double>(total), c.name);
            const ValidationResult result = runner.run(c, technique);
            if (InterruptGuard::interrupted()) return ExitStatus::interrupted;
            results.push_back(result);
            if (options.json) continue;
            bar.clear();
            fmt::print("{}", table_row(result));
            std::fflush(stdout);
        }
    }
    std::vector<ConvergenceCurve> curves;
    if (!options.output.empty()) {
        curves = measure_convergence(runner, cases, [&](double done) { bar.show("convergence", done); });
        if (InterruptGuard::interrupted()) return ExitStatus::interrupted;
    }
    bar.clear();

    // Report.
    const double seconds = seconds_since(start);
    const std::string json = validation_json(results, curves, seconds);
    fmt::print("{}", options.json ? json : table_summary(results, seconds));
    if (!options.output.empty()) {
        const std::filesystem::path out = options.output;
        write_text(out / "validation.json", json);
        write_text(out / "strip_light.svg", strip_light_plot(results));
        write_text(out / "point_light.svg", point_light_plot(results));
        write_text(out / "convergence.svg", convergence_plot(curves));
    }
    const bool passed =
        std::all_of(results.begin(), results.end(), [](const ValidationResult& r) { return r.passed(); });
    return passed ? ExitStatus::done : ExitStatus::check_failed;
}

}  // namespace candela
