// SPDX-License-Identifier: MIT
// The validation itself: it passes what is right, fails what is wrong, and says so in every form.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "app/validation/report.h"
#include "app/validation/svg_plot.h"

namespace candela {
namespace {

const std::string folder = "assets/validation";

ValidationCase find_case(const std::string& group, const std::string& name) {
    for (const ValidationCase& c : validation_cases()) {
        if (c.group == group && c.name.find(name) != std::string::npos) return c;
    }
    throw std::runtime_error("no case " + name);
}

TEST(Validation, ExactValuesAreThoseOfTheLiterature) {
    EXPECT_NEAR(strip_light_radiance(0), 0.7071068, 1e-7);
    EXPECT_NEAR(strip_light_radiance(1), 0.4472136, 1e-7);
    EXPECT_NEAR(strip_light_radiance(5), 0.0081257, 1e-7);
    EXPECT_NEAR(point_light_irradiance(0), 7.957747, 1e-6);
    EXPECT_NEAR(point_light_irradiance(1), 2.813488, 1e-6);
    EXPECT_NEAR(point_light_flux(1), 14.644661, 1e-6);
    EXPECT_NEAR(point_light_flux(100), 49.500025, 1e-6);
    // A disc of 64 corners is 0.16 % smaller than the circle, whose form is R²/(R² + h²).
    EXPECT_NEAR(find_case("lights", "disc").exact, 0.2, 0.2 * 2e-3);
    EXPECT_NEAR(find_case("lights", "ball").exact, 0.0625, 0.0625 * 2e-3);
}

TEST(Validation, EveryCaseHasAProbeAndATechnique) {
    const std::vector<ValidationCase> cases = validation_cases();
    EXPECT_GE(cases.size(), 30u);
    for (const ValidationCase& c : cases) {
        EXPECT_TRUE(c.probe) << c.name;
        EXPECT_FALSE(c.techniques.empty()) << c.name;
        EXPECT_TRUE(std::filesystem::exists(folder + "/" + c.scene)) << c.scene;
    }
}

TEST(Validation, PassesWhatIsRightAndFailsWhatIsWrong) {
    for (const auto& [group, name] : {std::pair{"strip light", "p = 1)"}, std::pair{"point light", "r = 1)"},
                                      std::pair{"interfaces", "n = 1"}, std::pair{"lights", "0.9 rad"}}) {
        ValidationCase c = find_case(group, name);
        ValidationRunner runner(folder, 2, 0, nullptr);
        const ValidationResult right = runner.run(c, c.techniques.front());
        EXPECT_TRUE(right.passed()) << name << " z " << right.z();
        c.exact = c.exact * 1.005 + (c.exact == 0 ? 1e-3 : 0);
        const ValidationResult wrong = runner.run(c, c.techniques.front());
        EXPECT_FALSE(wrong.passed()) << name << " z " << wrong.z();
    }
}

TEST(Validation, DoesNotDependOnTheNumberOfThreads) {
    const ValidationCase c = find_case("strip light", "p = 0.5");
    const ValidationResult one = ValidationRunner(folder, 1, 3, nullptr).run(c, c.techniques.front());
    const ValidationResult five = ValidationRunner(folder, 5, 3, nullptr).run(c, c.techniques.front());
    EXPECT_EQ(one.estimate, five.estimate);
    EXPECT_EQ(one.standard_error, five.standard_error);
    const ValidationResult other_seed = ValidationRunner(folder, 1, 4, nullptr).run(c, c.techniques.front());
    EXPECT_NE(one.estimate, other_seed.estimate);
}

TEST(Validation, TooNoisyIsNoProof) {
    ValidationCase c = find_case("strip light", "p = 1)");
    ValidationResult result;
    result.of = &c;
    result.samples = 100;
    result.estimate = c.exact;
    result.standard_error = 0.01 * c.exact;
    EXPECT_FALSE(result.passed());
    result.standard_error = 0.0005 * c.exact;
    EXPECT_TRUE(result.passed());
    result.non_finite = 1;
    EXPECT_FALSE(result.passed());
}

TEST(Validation, ErrorFallsWithTheRootOfIndependentSamples) {
    const ValidationCase c = find_case("strip light", "p = 0.5");
    ValidationRunner runner(folder, 2, 0, nullptr);
    ConvergenceCurve curve{{Estimator::light, SamplerKind::independent}, {4, 16, 64, 256, 1024}, {}};
    curve.errors = runner.convergence(c, curve.technique, curve.samples);
    EXPECT_NEAR(curve.slope(), -0.5, 0.06);
    curve.technique.sampler = SamplerKind::sobol;
    curve.errors = runner.convergence(c, curve.technique, curve.samples);
    EXPECT_LT(curve.slope(), -0.6);
}

TEST(Validation, ReportsAreWellFormed) {
    const ValidationCase strip = find_case("strip light", "p = 1)"), point = find_case("point light", "R = 100");
    std::vector<ValidationResult> results(2);
    results[0].of = &strip;
    results[0].estimate = strip.exact;
    results[0].standard_error = 1e-4;
    results[0].samples = 10;
    results[1].of = &point;
    results[1].estimate = 2;
    results[1].samples = 10;
    const ConvergenceCurve curve{{}, {1, 4, 16}, {0.4, 0.2, 0.1}};
    EXPECT_NEAR(curve.slope(), -0.5, 1e-9);
    const auto json = nlohmann::json::parse(validation_json(results, {curve}, 1.5));
    EXPECT_EQ(json["passed"], false);
    EXPECT_EQ(json["failed"], 1);
    EXPECT_EQ(json["cases"].size(), 2u);
    EXPECT_EQ(json["cases"][0]["passed"], true);
    EXPECT_EQ(json["cases"][1]["technique"], "mis, sobol");
    EXPECT_NE(table_row(results[1]).find("FAILED"), std::string::npos);
    EXPECT_NE(table_summary(results, 1).find("1 of 2"), std::string::npos);

    for (const std::string& svg : {strip_light_plot(results), point_light_plot(results), convergence_plot({curve})}) {
        EXPECT_EQ(svg.rfind("<svg ", 0), 0u);
        EXPECT_EQ(std::count(svg.begin(), svg.end(), '<'), std::count(svg.begin(), svg.end(), '>'));
        EXPECT_NE(svg.find("<circle"), std::string::npos) << "measured points are drawn";
        EXPECT_NE(svg.find("</svg>"), std::string::npos);
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(svg.find("inf"), std::string::npos);
    }
}

TEST(Validation, AxesHaveRoundTicks) {
    EXPECT_EQ((PlotAxis{"", 0, 3.2, false}.ticks().size()), 7u);
    const std::vector<double> decades = PlotAxis{"", 1, 1000, true}.ticks();
    ASSERT_EQ(decades.size(), 4u);
    EXPECT_NEAR(decades[3], 1000, 1e-9);
    EXPECT_NEAR((PlotAxis{"", 1, 100, true}.position(10)), 0.5, 1e-12);
}

}  // namespace
}  // namespace candela
