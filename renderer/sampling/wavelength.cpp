// SPDX-License-Identifier: MIT
#include "renderer/sampling/wavelength.h"

#include <array>

namespace candela {

namespace {

constexpr float shortest_nm = 380.0f, longest_nm = 780.0f;
constexpr int bins = 200;
constexpr float bin_nm = (longest_nm - shortest_nm) / bins;

float lobe(float x, float mean, float below, float above) {
    const float t = (x - mean) / (x < mean ? below : above);
    return std::exp(-0.5f * t * t);
}

Vec3 unscaled_response(float nm) {
    const float x = 1.056f * lobe(nm, 599.8f, 37.9f, 31.0f) + 0.362f * lobe(nm, 442.0f, 16.0f, 26.7f) -
                    0.065f * lobe(nm, 501.1f, 20.4f, 26.2f);
    const float y = 0.821f * lobe(nm, 568.8f, 46.9f, 40.5f) + 0.286f * lobe(nm, 530.9f, 16.3f, 31.1f);
    const float z = 1.217f * lobe(nm, 437.0f, 11.8f, 36.0f) + 0.681f * lobe(nm, 459.0f, 26.0f, 13.8f);
    return {3.2404542f * x - 1.5371385f * y - 0.4985314f * z, -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
            0.0556434f * x - 0.2040259f * y + 1.0572252f * z};
}

float center_of(int bin) {
    return shortest_nm + (static_cast<float>(bin) + 0.5f) * bin_nm;
}

// Piecewise constant over bins; within a bin the response is that of the wavelength itself, so that the quadrature
// below must be finer than the bins.
struct Spectrum {
    Vec3 scale{1};
    std::array<float, bins + 1> cdf{};

    Spectrum() {
        constexpr int per_bin = 16;
        glm::dvec3 total(0);
        for (int i = 0; i < bins * per_bin; ++i) {
            total += glm::dvec3(unscaled_response(shortest_nm + (static_cast<float>(i) + 0.5f) * bin_nm / per_bin));
        }
        scale = Vec3(static_cast<double>(per_bin) / (static_cast<double>(bin_nm) * total));
        double sum = 0;
        std::array<double, bins> weights{};
        for (int i = 0; i < bins; ++i) {
            const Vec3 magnitude = glm::abs(unscaled_response(center_of(i)) * scale);
            weights[static_cast<size_t>(i)] = static_cast<double>(magnitude.x + magnitude.y + magnitude.z) + 1e-5;
            sum += weights[static_cast<size_t>(i)];
        }
        double running = 0;
        for (size_t i = 0; i < bins; ++i) {
            running += weights[i] / sum;
            cdf[i + 1] = static_cast<float>(running);
        }
        cdf[bins] = 1.0f;
    }
};

const Spectrum spectrum;

}  // namespace

Vec3 wavelength_response(float wavelength_nm) noexcept {
    return unscaled_response(wavelength_nm) * spectrum.scale;
}

float wavelength_pdf(float wavelength_nm) noexcept {
    const int bin = static_cast<int>((wavelength_nm - shortest_nm) / bin_nm);
    if (wavelength_nm < shortest_nm || bin >= bins) return 0.0f;
    const auto i = static_cast<size_t>(bin);
    return (spectrum.cdf[i + 1] - spectrum.cdf[i]) / bin_nm;
}

WavelengthSample sample_wavelength(float u) noexcept {
    const auto above = std::upper_bound(spectrum.cdf.begin() + 1, spectrum.cdf.end() - 1, u);
    const auto bin = static_cast<size_t>(above - spectrum.cdf.begin()) - 1;
    const float mass = spectrum.cdf[bin + 1] - spectrum.cdf[bin];
    WavelengthSample out;
    out.wavelength_nm =
        shortest_nm + (static_cast<float>(bin) + std::min((u - spectrum.cdf[bin]) / mass, one_minus_epsilon)) * bin_nm;
    out.weight = wavelength_response(out.wavelength_nm) * (bin_nm / mass);
    return out;
}

}  // namespace candela
