// SPDX-License-Identifier: MIT
// What a closed form says a scene must show, and how to ask the path tracer.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderer/integrator/integrator.h"

namespace candela {

struct ValidationTechnique {
    Estimator estimator = Estimator::mis;
    SamplerKind sampler = SamplerKind::sobol;
    bool shares_paths = false;  // between the pixels of a picture of the probe
};

std::string name_of(const ValidationTechnique& technique);

// Where one sample looks, and what its radiance counts.
struct Probe {
    View view;
    double weight = 1;
};

struct ValidationCase {
    std::string group;    // "strip light"
    std::string name;     // "L(p = 0.5)"
    std::string formula;  // of the exact value
    std::string scene;    // file name in assets/validation
    double exact = 0;
    std::optional<float> sky = {};  // radiance of a constant environment
    // u uniform in [0,1)²; a constant for cases that look at one point.
    std::function<Probe(const Vec2& u)> probe = {};
    std::vector<ValidationTechnique> techniques = {};
    // A point of a diffuse surface that shows the radiance exact · radiance_per_unit from wherever one looks.
    std::optional<Vec3> point = {};
    double radiance_per_unit = 1;
};

// Every closed form, in the order of the report.
std::vector<ValidationCase> validation_cases();

// L(p) of the strip light of width 2 and radiance 1, one unit above a white plane.
double strip_light_radiance(double p);
// The view of the point p on the plane under the strip.
View strip_light_view(double p);
// Irradiance at distance r from the foot of a point light of 100 W one unit above the plane, and the flux through the
// disc of that radius.
double point_light_irradiance(double r);
double point_light_flux(double radius);

}  // namespace candela
