// SPDX-License-Identifier: MIT
// The closed forms. Each is derived in the literature of radiometry; the comments give the formula with its terms.
#include "app/validation/case.h"

#include <cmath>

namespace candela {

namespace {

constexpr double pi_d = 3.14159265358979323846;

// A view of one pixel, 2e-5 m high: one point.
View look_at_point(const Vec3& eye, const Vec3& target) {
    View view;
    view.camera.world_from_camera = look_at(eye, target, Vec3(0, 1, 0));
    view.camera.projection = Projection::orthographic;
    view.camera.ortho_half_height_m = 1e-5f;
    return view;
}

std::function<Probe(const Vec2&)> at_point(const Vec3& eye, const Vec3& target) {
    const Probe probe{look_at_point(eye, target), 1};
    return [probe](const Vec2&) { return probe; };
}

// A point of the plane y = 0, seen from close above: below whatever shines on it.
std::function<Probe(const Vec2&)> on_plane(double x) {
    const Vec3 target(static_cast<float>(x), 0, 0);
    return at_point(target + Vec3(0.02f, 0.3f, 0.03f), target);
}

const std::vector<ValidationTechnique> every_technique = {{Estimator::mis, SamplerKind::sobol},
                                                          {Estimator::light, SamplerKind::sobol},
                                                          {Estimator::bsdf, SamplerKind::sobol},
                                                          {Estimator::mis, SamplerKind::independent},
                                                          {Estimator::mis, SamplerKind::sobol, true}};
// A light without extent is found by sampling it, whatever the estimator.
// Paths that few samples take need more of them than anyone wants to wait for, unless they are spread well.
const std::vector<ValidationTechnique> sobol_techniques = {{Estimator::mis, SamplerKind::sobol},
                                                           {Estimator::light, SamplerKind::sobol},
                                                           {Estimator::bsdf, SamplerKind::sobol}};
const std::vector<ValidationTechnique> both_samplers = {{Estimator::mis, SamplerKind::sobol},
                                                        {Estimator::mis, SamplerKind::independent}};

// Irradiance from a convex polygon of radiance 1, corners counter-clockwise as the receiver at the origin with normal
// +Y sees them: E = ½ Σ βᵢ cos Γᵢ (Lambert 1760; Arvo 1995, equation 1).
double polygon_irradiance(const std::vector<glm::dvec3>& corners) {
    double sum = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i]), b = glm::normalize(corners[(i + 1) % corners.size()]);
        const double angle = std::acos(std::min(1.0, glm::dot(a, b)));
        sum += angle * glm::normalize(glm::cross(a, b)).y;
    }
    return 0.5 * std::abs(sum);
}

double ring_irradiance(double radius, double height, int corners) {
    std::vector<glm::dvec3> ring;
    for (int k = 0; k < corners; ++k) {
        const double phi = 2 * pi_d * k / corners;
        ring.emplace_back(radius * std::cos(phi), height, radius * std::sin(phi));
    }
    return polygon_irradiance(ring);
}

double fresnel_at_normal(double n) {
    return std::pow((n - 1) / (n + 1), 2);
}

// KHR_lights_punctual's ramp for the cosine to the axis.
double spot_ramp(double cosine, double inner, double outer) {
    const double scale = 1 / std::max(0.001, std::cos(inner) - std::cos(outer));
    const double t = std::min(1.0, std::max(0.0, (cosine - std::cos(outer)) * scale));
    return t * t;
}

// The case added last looks at a diffuse point.
void show_at(std::vector<ValidationCase>& cases, const Vec3& point) {
    cases.back().point = point;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

void add_point_light(std::vector<ValidationCase>& cases) {
    for (const double r : {0.0, 0.5, 1.0, 2.0, 5.0}) {
        ValidationCase c{"point light", "E(r = " + number(r) + ")", "Phi d / (4 pi (r^2 + d^2)^1.5)",
                         "point_light_plane.glb", point_light_irradiance(r)};
        // The plane is white: L = E/π.
        const auto look = on_plane(r);
        c.probe = [look](const Vec2& u) { return Probe{look(u).view, pi_d}; };
        c.point = Vec3(static_cast<float>(r), 0, 0);
        c.radiance_per_unit = 1 / pi_d;
        c.techniques = both_samplers;
        cases.push_back(c);
    }
    for (const double radius : {1.0, 10.0, 100.0}) {
        ValidationCase c{"point light", "flux through R = " + number(radius), "Phi/2 (1 - d / sqrt(R^2 + d^2))",
                         "point_light_plane.glb", point_light_flux(radius)};
        // Radii are drawn with pdf 2r / ((r² + 1) ln(1 + R²)): about where the flux is.
        c.probe = [radius](const Vec2& u) {
            const double log_range = std::log1p(radius * radius);
            const double r = std::sqrt(std::max(0.0, std::expm1(static_cast<double>(u.x) * log_range)));
            const double phi = 2 * pi_d * static_cast<double>(u.y);
            const Vec3 target(static_cast<float>(r * std::cos(phi)), 0, static_cast<float>(r * std::sin(phi)));
            return Probe{look_at_point(target + Vec3(0.02f, 0.3f, 0.03f), target),
                         pi_d * pi_d * (r * r + 1) * log_range};
        };
        c.techniques = both_samplers;
        cases.push_back(c);
    }
}

void add_strip_light(std::vector<ValidationCase>& cases) {
    for (const double p : {0.0, 0.5, 1.0, 1.5, 2.0, 3.0}) {
        ValidationCase c{"strip light", "L(p = " + number(p) + ")",
                         "((1-p)/sqrt((1-p)^2+1) + (1+p)/sqrt((1+p)^2+1)) / 2", "strip_light.glb",
                         strip_light_radiance(p)};
        const Probe probe{strip_light_view(p), 1};
        c.probe = [probe](const Vec2&) { return probe; };
        c.techniques = every_technique;
        c.point = Vec3(static_cast<float>(p), 0, 0);
        cases.push_back(c);
    }
}

void add_energy(std::vector<ValidationCase>& cases) {
    const Vec3 eye(0.31f, 0.22f, 5), target(0.31f, 0.22f, 0);
    cases.push_back({"energy", "white Lambert ball in a furnace", "1", "furnace_sphere.glb", 1.0, 1.0f,
                     at_point(eye, target), every_technique});
    show_at(cases, Vec3(0, 0, 1));
    cases.push_back({"energy", "white ball in glass in a furnace", "1", "furnace_glass.glb", 1.0, 1.0f,
                     at_point(eye, target), every_technique});
    cases.push_back({"energy", "ice, drink and glass in a furnace", "1", "furnace_drink.glb", 1.0, 1.0f,
                     at_point(eye, target), every_technique});
    const Vec3 inside(0.1f, 0.2f, 0), wall(0.7f, 0.5f, 0.3f);
    cases.push_back({"energy",
                     "integrating sphere, albedo 0.5",
                     "Le / (1 - rho)",
                     "integrating_sphere.glb",
                     2.0,
                     {},
                     at_point(inside, wall),
                     every_technique});
    show_at(cases, Vec3(0, 0, -1));
    cases.push_back({"energy",
                     "integrating sphere, albedo 0.9",
                     "Le / (1 - rho)",
                     "integrating_sphere_dark.glb",
                     10.0,
                     {},
                     at_point(inside, wall),
                     every_technique});
    show_at(cases, Vec3(0, 0, -1));
    cases.push_back({"energy", "plane of albedo 0.25 under a sky of 2", "rho L", "sky_plane.glb", 0.5, 2.0f,
                     on_plane(0), every_technique});
    show_at(cases, Vec3(0));
}

void add_lights(std::vector<ValidationCase>& cases) {
    // All planes are white: they show E/π.
    cases.push_back({"lights",
                     "directional light at 30 degrees",
                     "E cos(theta) / pi",
                     "directional_light.glb",
                     2 * std::cos(pi_d / 6) / pi_d,
                     {},
                     on_plane(0),
                     both_samplers});
    show_at(cases, Vec3(0));
    for (const double angle : {0.2, 0.6, 0.9}) {
        const double cosine = std::cos(angle);
        const double exact = angle > 0.8 ? 0.0 : 10 * spot_ramp(cosine, 0.4, 0.8) * std::pow(cosine, 3) / pi_d;
        cases.push_back({"lights",
                         "spot light at " + number(angle) + " rad",
                         "I ramp cos^3(theta) / (pi d^2)",
                         "spot_light.glb",
                         exact,
                         {},
                         on_plane(std::tan(angle)),
                         both_samplers});
        show_at(cases, Vec3(static_cast<float>(std::tan(angle)), 0, 0));
    }
    cases.push_back({"lights",
                     "disc light of 64 corners",
                     "Lambert's formula for a polygon, / pi",
                     "disc_light.glb",
                     ring_irradiance(0.5, 1, 64) / pi_d,
                     {},
                     on_plane(0),
                     every_technique});
    show_at(cases, Vec3(0));
    // From the origin the ball's outline is its ring of corners on the cone of tangents.
    const double tangent = std::acos(0.5 / 2);
    cases.push_back({"lights",
                     "ball light of 64 corners",
                     "Lambert's formula for its outline, / pi",
                     "sphere_light.glb",
                     ring_irradiance(0.5 * std::sin(tangent), 2 - 0.5 * std::cos(tangent), 64) / pi_d,
                     {},
                     on_plane(0),
                     every_technique});
    show_at(cases, Vec3(0));
    ValidationCase squares{"lights", "opposed unit squares", "form factor F", "facing_squares.glb", 0.19982490};
    squares.probe = [](const Vec2& u) {
        const Vec3 target(u.x - 0.5f, 0, u.y - 0.5f);
        return Probe{look_at_point(target + Vec3(0.02f, 0.3f, 0.03f), target), 1};
    };
    squares.techniques = every_technique;
    cases.push_back(squares);
}

void add_interfaces(std::vector<ValidationCase>& cases) {
    // The slab is one unit thick; its colour of 0.25 is reached after 2 units: τ = √0.25.
    const double f = fresnel_at_normal(1.5), tau = 0.5;
    const auto through = at_point(Vec3(0.123f, 0.234f, 3), Vec3(0.123f, 0.234f, 0.5f));
    cases.push_back({"interfaces",
                     "clear slab, n = 1.5, transmitted",
                     "(1 - F0) / (1 + F0)",
                     "slab_clear.glb",
                     (1 - f) / (1 + f),
                     {},
                     through,
                     every_technique});
    cases.push_back({"interfaces",
                     "clear slab, n = 1.5, reflected",
                     "2 F0 / (1 + F0)",
                     "slab_mirror.glb",
                     2 * f / (1 + f),
                     {},
                     through,
                     sobol_techniques});
    cases.push_back({"interfaces",
                     "absorbing slab, n = 1.5",
                     "(1 - F0)^2 tau / (1 - F0^2 tau^2)",
                     "slab_absorbing.glb",
                     (1 - f) * (1 - f) * tau / (1 - f * f * tau * tau),
                     {},
                     through,
                     every_technique});
    cases.push_back(
        {"interfaces", "absorbing slab, n = 1", "tau", "slab_index_one.glb", tau, {}, through, every_technique});
}

void add_camera(std::vector<ValidationCase>& cases) {
    // A lamp of 64 corners and radius 0.005 lies inside the blur circle that the lens, out of focus, spreads over its
    // plane, of diameter A |s − f| / f there (A |s − f| / s on the plane in focus): the share of lens points that see
    // it is the ratio of the areas.
    constexpr double aperture = 0.1, distance = 2.0, focus = 1.5;
    const double blur = aperture * std::abs(distance - focus) / focus;
    const double lamp_area = 32 * 0.005 * 0.005 * std::sin(2 * pi_d / 64);
    Probe probe{look_at_point(Vec3(0, 0, static_cast<float>(distance)), Vec3(0)), 1};
    probe.view.camera.projection = Projection::perspective;
    probe.view.camera.yfov_radians = 1e-6f;
    probe.view.camera.aperture_diameter_m = static_cast<float>(aperture);
    probe.view.camera.focus_distance_m = static_cast<float>(focus);
    cases.push_back({"camera",
                     "lamp blurred by a thin lens",
                     "lamp area / (pi (A |s - f| / 2f)^2)",
                     "lens_target.glb",
                     lamp_area / (pi_d * 0.25 * blur * blur),
                     {},
                     [probe](const Vec2&) { return probe; },
                     sobol_techniques});
}

}  // namespace

std::string name_of(const ValidationTechnique& technique) {
    const char* estimators[] = {"mis", "light", "bsdf"};
    return std::string(estimators[static_cast<int>(technique.estimator)]) +
           (technique.sampler == SamplerKind::sobol ? ", sobol" : ", independent") +
           (technique.shares_paths ? ", shared paths" : "");
}

double strip_light_radiance(double p) {
    const double a = 1 - p, b = 1 + p;
    return 0.5 * (a / std::sqrt(a * a + 1) + b / std::sqrt(b * b + 1));
}

View strip_light_view(double p) {
    const Vec3 target(static_cast<float>(p), 0, 0);
    return look_at_point(target + Vec3(0.2f, 0.5f, 0.3f), target);
}

double point_light_irradiance(double r) {
    return 100 / (4 * pi_d * std::pow(r * r + 1, 1.5));
}

double point_light_flux(double radius) {
    return 50 * (1 - 1 / std::sqrt(radius * radius + 1));
}

std::vector<ValidationCase> validation_cases() {
    std::vector<ValidationCase> cases;
    add_point_light(cases);
    add_strip_light(cases);
    add_energy(cases);
    add_lights(cases);
    add_interfaces(cases);
    add_camera(cases);
    return cases;
}

}  // namespace candela
