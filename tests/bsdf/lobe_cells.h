// SPDX-License-Identifier: MIT
// Cells of the sphere of directions by the slope of the facet that sends light there from wo, on either side: a lobe of
// any width fills as many of them as any other, and what peaks over directions is smooth over slopes.
#pragma once

#include <vector>

#include "renderer/bsdf/bsdf.h"

namespace candela::test {

class LobeCells {
  public:
    // Slopes are measured from that of `normal`, in units of alpha along x and y: those of the narrowest lobe. eta: the
    // index below over the index on wo's side where light is refracted; 0: what leaves below mirrors what is reflected.
    LobeCells(const Vec3& wo, const Vec3& normal, const Vec2& alpha, float eta)
        : wo_(wo), center_(glm::dvec2(normal) / static_cast<double>(normal.z)), alpha_(alpha), eta_(eta) {
        // Facets that reflect lean by 2/wo.z at most; those that refract without limit, but are rare.
        const double steepest = (eta > 0.0f ? 1e3 : 2.0 / wo_.z) + glm::length(center_);
        growth_ = std::log1p(steepest / std::min(alpha_.x, alpha_.y) / linear_up_to);
    }

    size_t size() const { return size_t{2} * rings * sectors; }

    size_t cell_of(const Vec3& wi) const {
        const bool below = wi.z < 0.0f;
        glm::dvec3 h = facet_between(glm::dvec3(wi), below);
        h /= h.z;
        const glm::dvec2 slope = (glm::dvec2(-h.x, -h.y) + center_) / alpha_;
        const double ring = std::log1p(glm::length(slope) / linear_up_to) / growth_ * rings;
        const double sector = (std::atan2(slope.y, slope.x) / two_pi + 0.5) * sectors;
        return index(below ? 1 : 0, std::min(static_cast<int>(ring), rings - 1),
                     std::min(static_cast<int>(sector), sectors - 1));
    }

    // The integral of a density per solid angle over each cell; each subdivided until it changes no more.
    template <typename Density>
    std::vector<double> integrate(const Density& density) const {
        std::vector<double> out(size());
        for (int side = 0; side < 2; ++side) {
            const auto over_chart = [&](double r, double s) {
                const Point p = point_at(side == 1, r, s);
                return p.solid_angle > 0 ? static_cast<double>(density(p.wi)) * p.solid_angle : 0.0;
            };
            for (int ring = 0; ring < rings; ++ring) {
                for (int sector = 0; sector < sectors; ++sector) {
                    const glm::dvec2 corner(static_cast<double>(ring) / rings, static_cast<double>(sector) / sectors);
                    const glm::dvec2 extent(1.0 / rings, 1.0 / sectors);
                    out[index(side, ring, sector)] =
                        refined(over_chart, corner, extent, gauss(over_chart, corner, extent), 0);
                }
            }
        }
        return out;
    }

  private:
    static constexpr int rings = 24, sectors = 12;
    static constexpr double two_pi = 6.283185307179586;
    static constexpr double linear_up_to = 0.5;  // in alphas; beyond it rings grow in proportion

    struct Point {
        Vec3 wi{0};
        double solid_angle = 0;  // per unit of the chart; 0: no direction
    };

    static size_t index(int side, int ring, int sector) {
        return (static_cast<size_t>(side) * rings + static_cast<size_t>(ring)) * sectors + static_cast<size_t>(sector);
    }

    // The facet's normal, of any length, z > 0; Walter et al. 2007, equations 13 and 16.
    glm::dvec3 facet_between(glm::dvec3 wi, bool below) const {
        if (below && eta_ > 0.0f) {
            const glm::dvec3 h = wo_ + static_cast<double>(eta_) * wi;
            return h.z < 0 ? -h : h;
        }
        return wo_ + glm::dvec3(wi.x, wi.y, std::abs(wi.z));
    }

    Point point_at(bool below, double r, double s) const {
        // The facet and its solid angle: dω = cos³θ dslope².
        const double t = linear_up_to * std::expm1(growth_ * r);
        const double phi = two_pi * (s - 0.5);
        const glm::dvec2 slope = alpha_ * (t * glm::dvec2(std::cos(phi), std::sin(phi))) - center_;
        const glm::dvec3 h = glm::normalize(glm::dvec3(-slope.x, -slope.y, 1.0));
        const double facet_angle = h.z * h.z * h.z * alpha_.x * alpha_.y * t * (t + linear_up_to) * growth_ * two_pi;
        const double cos_o = glm::dot(wo_, h);
        if (cos_o <= 0) return {};
        if (!below || !(eta_ > 0.0f)) {
            const glm::dvec3 wi = 2 * cos_o * h - wo_;
            if (wi.z <= 0) return {};
            return {Vec3(wi.x, wi.y, below ? -wi.z : wi.z), facet_angle * 4 * cos_o};
        }
        // Snell's law, and the Jacobian of refraction: equation 17.
        const double eta = static_cast<double>(eta_);
        const double sine_squared = (1 - cos_o * cos_o) / (eta * eta);
        if (sine_squared >= 1) return {};
        const double cos_t = std::sqrt(1 - sine_squared);
        const glm::dvec3 wi = (cos_o / eta - cos_t) * h - wo_ / eta;
        if (wi.z >= 0) return {};
        const double root = cos_o - eta * cos_t;
        return {Vec3(wi), facet_angle * root * root / (eta * eta * cos_t)};
    }

    template <typename Function>
    static double gauss(const Function& f, const glm::dvec2& corner, const glm::dvec2& extent) {
        constexpr double node[3] = {0.5 - 0.3872983346207417, 0.5, 0.5 + 0.3872983346207417};
        constexpr double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j)
                sum += weight[i] * weight[j] * f(corner.x + extent.x * node[i], corner.y + extent.y * node[j]);
        }
        return sum * extent.x * extent.y;
    }

    template <typename Function>
    static double refined(const Function& f, const glm::dvec2& corner, const glm::dvec2& extent, double coarse,
                          int depth) {
        constexpr double tolerance = 2e-5;
        // A needle that nine points miss, most of 144 do not.
        constexpr int shallowest = 1, deepest = 6;
        const glm::dvec2 half = 0.5 * extent;
        double quarter[4], sum = 0;
        for (int k = 0; k < 4; ++k) {
            quarter[k] = gauss(f, corner + half * glm::dvec2(k & 1, k >> 1), half);
            sum += quarter[k];
        }
        if (depth == deepest || (depth >= shallowest && std::abs(sum - coarse) < tolerance)) return sum;
        sum = 0;
        for (int k = 0; k < 4; ++k)
            sum += refined(f, corner + half * glm::dvec2(k & 1, k >> 1), half, quarter[k], depth + 1);
        return sum;
    }

    glm::dvec3 wo_;
    glm::dvec2 center_;
    glm::dvec2 alpha_;
    float eta_;
    double growth_ = 1;
};

}  // namespace candela::test
