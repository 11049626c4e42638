// SPDX-License-Identifier: MIT
// LDR-FLIP: Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images". Section and equation numbers
// are those of the paper.
#include <stdexcept>

#include "renderer/image/compare.h"

namespace candela {

namespace {

constexpr float pixels_per_degree = 67.0f;
using Plane = Image<Vec3>;

// Colour spaces around the D65 white point (section 3).
const Vec3 white(0.950428545f, 1.0f, 1.088900371f);

Vec3 xyz_from_linear(const Vec3& c) {
    return {0.412390799f * c.r + 0.357584339f * c.g + 0.180480788f * c.b,
            0.212639006f * c.r + 0.715168679f * c.g + 0.072192315f * c.b,
            0.019330819f * c.r + 0.119194780f * c.g + 0.950532152f * c.b};
}

Vec3 linear_from_xyz(const Vec3& c) {
    return {3.240969942f * c.x - 1.537383178f * c.y - 0.498610760f * c.z,
            -0.969243636f * c.x + 1.875967502f * c.y + 0.041555057f * c.z,
            0.055630080f * c.x - 0.203976959f * c.y + 1.056971514f * c.z};
}

Vec3 ycxcz_from_linear(const Vec3& c) {
    const Vec3 n = xyz_from_linear(c) / white;
    return {116.0f * n.y - 16.0f, 500.0f * (n.x - n.y), 200.0f * (n.y - n.z)};
}

Vec3 linear_from_ycxcz(const Vec3& c) {
    const float y = (c.x + 16.0f) / 116.0f;
    return linear_from_xyz(Vec3(y + c.y / 500.0f, y, y - c.z / 200.0f) * white);
}

Vec3 lab_from_linear(const Vec3& c) {
    const Vec3 n = xyz_from_linear(c) / white;
    const auto f = [](float t) {
        constexpr float delta = 6.0f / 29.0f;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
    };
    return {116.0f * f(n.y) - 16.0f, 500.0f * (f(n.x) - f(n.y)), 200.0f * (f(n.y) - f(n.z))};
}

// The Hunt effect scales chroma with lightness (section 4.1.2).
Vec3 hunt(const Vec3& lab) {
    return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

// HyAB distance, to the power of 0.7 (equations 9 and 10).
float hyab(const Vec3& a, const Vec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// Convolves along one axis with a kernel per channel; edges repeat.
Plane convolve(const Plane& in, const std::vector<Vec3>& kernel, bool along_x) {
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane out(in.width(), in.height(), Vec3(0));
    for (int y = 0; y < in.height(); ++y) {
        for (int x = 0; x < in.width(); ++x) {
            Vec3 sum(0);
            for (int k = -radius; k <= radius; ++k) {
                const int u = along_x ? std::clamp(x + k, 0, in.width() - 1) : x;
                const int v = along_x ? y : std::clamp(y + k, 0, in.height() - 1);
                sum += kernel.begin()[k + radius] * in(u, v);
            }
            out(x, y) = sum;
        }
    }
    return out;
}

// The contrast sensitivity functions as sums of Gaussians (section 4.1.1, table 1): a1, b1, a2, b2 for each opponent
// channel.
struct Sensitivity {
    float a1, b1, a2, b2;
};
constexpr Sensitivity achromatic{1.0f, 0.0047f, 0.0f, 1e-5f};
constexpr Sensitivity red_green{1.0f, 0.0053f, 0.0f, 1e-5f};
constexpr Sensitivity blue_yellow{34.1f, 0.04f, 13.5f, 0.025f};

std::vector<float> gaussian(float b, int radius) {
    std::vector<float> out;
    for (int k = -radius; k <= radius; ++k) {
        const float x = static_cast<float>(k) / pixels_per_degree;
        out.push_back(std::exp(-pi * pi * x * x / b));
    }
    return out;
}

// A sum of two isotropic Gaussians is not separable, but each of them is: filter twice and add, with the joint weight
// normalised.
Plane filter_by_sensitivity(const Plane& in) {
    const int radius = static_cast<int>(std::ceil(3.0f * std::sqrt(0.04f / (2.0f * pi * pi)) * pixels_per_degree));
    const Sensitivity channels[3] = {achromatic, red_green, blue_yellow};
    Plane out(in.width(), in.height(), Vec3(0));
    Vec3 total(0);
    for (int term = 0; term < 2; ++term) {
        std::vector<Vec3> kernel(2 * static_cast<size_t>(radius) + 1);
        Vec3 amplitude(0);
        for (int c = 0; c < 3; ++c) {
            const float a = term == 0 ? channels[c].a1 : channels[c].a2;
            const float b = term == 0 ? channels[c].b1 : channels[c].b2;
            amplitude[c] = a * std::sqrt(pi / b) * std::sqrt(pi / b);
            const std::vector<float> g = gaussian(b, radius);
            float sum = 0;
            for (size_t k = 0; k < g.size(); ++k) {
                kernel[k][c] = g[k];
                sum += g[k];
            }
            total[c] += amplitude[c] * sum * sum;
        }
        const Plane part = convolve(convolve(in, kernel, true), kernel, false);
        for (size_t i = 0; i < out.size(); ++i)
            out.pixels()[i] += amplitude * part.pixels()[i];
    }
    for (Vec3& p : out.pixels())
        p /= total;
    return out;
}

// Edges and points by the first and second derivative of a Gaussian of 0.082 degrees (section 4.2).
struct Features {
    Image<float> edges, points;
};

Features find_features(const Plane& lightness) {
    const float sigma = 0.5f * 0.082f * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0f * sigma));
    std::vector<Vec3> smooth, first, second;
    float sum = 0, first_sum = 0, second_positive = 0, second_negative = 0;
    for (int k = -radius; k <= radius; ++k) {
        const auto x = static_cast<float>(k);
        const float g = std::exp(-x * x / (2 * sigma * sigma));
        const float d1 = -x * g;
        const float d2 = (x * x / (sigma * sigma) - 1.0f) * g;
        smooth.emplace_back(g);
        first.emplace_back(d1);
        second.emplace_back(d2);
        sum += g;
        first_sum += std::max(d1, 0.0f);
        (d2 > 0 ? second_positive : second_negative) += std::abs(d2);
    }
    for (size_t k = 0; k < smooth.size(); ++k) {
        smooth[k] /= sum;
        first[k] /= first_sum;
        second[k] /= second[k].x > 0 ? second_positive : second_negative;
    }
    const Plane smooth_y = convolve(lightness, smooth, false), smooth_x = convolve(lightness, smooth, true);
    const Plane dx = convolve(smooth_y, first, true), dy = convolve(smooth_x, first, false);
    const Plane dxx = convolve(smooth_y, second, true), dyy = convolve(smooth_x, second, false);
    Features out{Image<float>(lightness.width(), lightness.height()),
                 Image<float>(lightness.width(), lightness.height())};
    for (size_t i = 0; i < lightness.size(); ++i) {
        out.edges.pixels()[i] = std::hypot(dx.pixels()[i].x, dy.pixels()[i].x);
        out.points.pixels()[i] = std::hypot(dxx.pixels()[i].x, dyy.pixels()[i].x);
    }
    return out;
}

struct Perceived {
    Plane lab;  // what the filtered picture looks like, Hunt-adjusted
    Features features;
};

Perceived perceive(const ImageRgba32f& image) {
    Plane opponent(image.width(), image.height());
    Plane lightness(image.width(), image.height());
    for (size_t i = 0; i < image.size(); ++i) {
        const Vec3 c = ycxcz_from_linear(glm::clamp(Vec3(image.pixels()[i]), 0.0f, 1.0f));
        opponent.pixels()[i] = c;
        lightness.pixels()[i] = Vec3((c.x + 16.0f) / 116.0f);
    }
    Perceived out{filter_by_sensitivity(opponent), find_features(lightness)};
    for (Vec3& p : out.lab.pixels())
        p = hunt(lab_from_linear(glm::clamp(linear_from_ycxcz(p), 0.0f, 1.0f)));
    return out;
}

}  // namespace

Image<float> flip_map(const ImageRgba32f& a, const ImageRgba32f& b) {
    if (a.width() != b.width() || a.height() != b.height()) throw std::invalid_argument("the pictures differ in size");
    constexpr float color_exponent = 0.7f, color_knee = 0.4f, color_share = 0.95f, feature_exponent = 0.5f;
    // The largest colour difference there is lies between green and blue (equation 11).
    const float largest =
        std::pow(hyab(hunt(lab_from_linear(Vec3(0, 1, 0))), hunt(lab_from_linear(Vec3(0, 0, 1)))), color_exponent);
    const float knee = color_knee * largest;

    const Perceived test = perceive(a), reference = perceive(b);
    Image<float> out(a.width(), a.height());
    for (size_t i = 0; i < out.size(); ++i) {
        const float d = std::pow(hyab(test.lab.pixels()[i], reference.lab.pixels()[i]), color_exponent);
        const float color =
            d < knee ? color_share / knee * d : color_share + (d - knee) / (largest - knee) * (1.0f - color_share);
        const float feature =
            std::max(std::abs(test.features.edges.pixels()[i] - reference.features.edges.pixels()[i]),
                     std::abs(test.features.points.pixels()[i] - reference.features.points.pixels()[i]));
        const float weight = std::pow(std::clamp(feature * std::sqrt(0.5f), 0.0f, 1.0f), feature_exponent);
        // Features amplify colour differences (equation 19).
        out.pixels()[i] = std::pow(std::clamp(color, 0.0f, 1.0f), 1.0f - weight);
    }
    return out;
}

}  // namespace candela
