// SPDX-License-Identifier: MIT
#include "renderer/scene/animation.h"

#include "renderer/math/math.h"

namespace candela {
namespace {

using glm::dvec4;

dvec4 load4(const float* from) {
    return {from[0], from[1], from[2], from[3]};
}

void store_unit(const dvec4& q, std::span<float> out) {
    const double length = glm::length(q);
    const dvec4 unit = length > 1e-12 && std::isfinite(length) ? q / length : dvec4(0, 0, 0, 1);
    for (int i = 0; i < 4; ++i)
        out[static_cast<size_t>(i)] = static_cast<float>(unit[i]);
}

// Spherical linear interpolation along the shorter arc (glTF 2.0, section C.4).
void slerp(const float* a, const float* b, double t, std::span<float> out) {
    dvec4 from = load4(a), to = load4(b);
    from /= std::max(glm::length(from), 1e-12);
    to /= std::max(glm::length(to), 1e-12);
    double cosine = glm::dot(from, to);
    if (cosine < 0.0) {
        to = -to;
        cosine = -cosine;
    }
    // Between directions that are nearly the same the arc is a line.
    const double angle = std::acos(std::min(cosine, 1.0));
    if (angle < 1e-6) return store_unit(from + t * (to - from), out);
    store_unit((std::sin((1.0 - t) * angle) * from + std::sin(t * angle) * to) / std::sin(angle), out);
}

}  // namespace

void evaluate(const AnimationSampler& sampler, float time_s, std::span<float> out) {
    const std::vector<float>& times = *sampler.times_s;
    const size_t width = sampler.width;
    const bool cubic = sampler.interpolation == Interpolation::cubic_spline;
    const size_t stride = cubic ? 3 * width : width;
    const size_t value_offset = cubic ? width : 0;
    const auto key = [&](size_t k) { return sampler.values.data() + k * stride + value_offset; };

    // The interval that the time falls into, and where in it; outside of all the nearest key.
    const auto after = static_cast<size_t>(std::upper_bound(times.begin(), times.end(), time_s) - times.begin());
    const bool outside = after == 0 || after == times.size() || !(time_s == time_s);
    const size_t k = outside && after == 0 ? 0 : after - 1;
    if (outside || sampler.interpolation == Interpolation::step) {
        std::copy_n(key(k), width, out.begin());
        if (sampler.is_rotation) store_unit(load4(key(k)), out);
        return;
    }
    const double interval_s = static_cast<double>(times[k + 1]) - static_cast<double>(times[k]);
    const double t = (static_cast<double>(time_s) - static_cast<double>(times[k])) / interval_s;
    const float *a = key(k), *b = key(k + 1);

    if (!cubic) {
        if (sampler.is_rotation) return slerp(a, b, t, out);
        for (size_t i = 0; i < width; ++i)
            out[i] = static_cast<float>((1.0 - t) * static_cast<double>(a[i]) + t * static_cast<double>(b[i]));
        return;
    }
    // Hermite's basis; tangents are per second (glTF 2.0, section C.5).
    const float *away = a + width, *towards = b - width;
    const double t2 = t * t, t3 = t2 * t;
    for (size_t i = 0; i < width; ++i) {
        out[i] = static_cast<float>((2 * t3 - 3 * t2 + 1) * static_cast<double>(a[i]) +
                                    interval_s * (t3 - 2 * t2 + t) * static_cast<double>(away[i]) +
                                    (3 * t2 - 2 * t3) * static_cast<double>(b[i]) +
                                    interval_s * (t3 - t2) * static_cast<double>(towards[i]));
    }
    if (sampler.is_rotation) store_unit(load4(out.data()), out);
}

}  // namespace candela
