// SPDX-License-Identifier: MIT
// What a film says of its own error. The samples of a pixel belong to two independent replicates with n0 and n1 samples
// and means A and B. The pixel's value is m = (n0·A + n1·B)/n, and with n0 ≈ n1 its error m − μ = ((A − μ) + (B − μ))/2
// and the half difference (A − B)/2 = ((A − μ) − (B − μ))/2 have the same variance, whatever correlation there is
// inside a replicate; and where A is distributed symmetrically about μ they have the same distribution. So over many
// pixels, mean and quantiles of |A − B|/2 are those of the error. Nothing is assumed of a single pixel (one difference
// says next to nothing of it), nor that noise is normal.
//
// Where it falls short: for skewed A, E|A − B|/2 ≤ E|m − μ|, at worst by half where almost all light comes by rare
// bright samples that few pixels have met. And a picture's bias is not seen (textures are filtered less with every
// sample; texture.h). tests/benchmarks/calibration.cpp measures how far it holds.
#include <bit>
#include <mutex>

#include "renderer/film/replicates.h"

namespace candela {

namespace {

// Of numbers from 0 on, with 32 bins for each power of two: the leading bits of the number.
class Histogram {
  public:
    void add(float value) { ++bins_[std::bit_cast<uint32_t>(std::max(value, 0.0f)) >> shift]; }
    void add(const Histogram& other) {
        for (size_t i = 0; i < bins_.size(); ++i)
            bins_[i] += other.bins_[i];
    }
    // Interpolated within its bin.
    double quantile(double share, size_t count) const {
        double before = 0;
        const double wanted = share * static_cast<double>(count);
        for (uint32_t i = 0; i < bins_.size(); ++i) {
            const double in_bin = bins_[i];
            if (in_bin > 0 && before + in_bin >= wanted) {
                const auto low = static_cast<double>(std::bit_cast<float>(i << shift));
                const auto high = static_cast<double>(std::bit_cast<float>((i + 1) << shift));
                return low + (high - low) * (wanted - before) / in_bin;
            }
            before += in_bin;
        }
        return 0.0;
    }

  private:
    static constexpr uint32_t shift = 18;  // keeps the exponent and five bits of the mantissa
    std::vector<uint32_t> bins_ = std::vector<uint32_t>((0x7f800000u >> shift) + 1);
};

// Kept row by row and added up in their order, so that the sums do not depend on who works on which rows.
struct RowSums {
    double luminance = 0, error = 0;
    uint64_t samples = 0, non_finite = 0;
    uint32_t min_samples = 0xffffffffu;
};

RowSums sum_row(std::span<const FilmPixel> row) noexcept {
    RowSums out;
    for (const FilmPixel& pixel : row) {
        out.luminance += static_cast<double>(mean_of(pixel));
        out.samples += pixel.count;
        out.non_finite += pixel.non_finite;
        out.min_samples = std::min(out.min_samples, pixel.count);
    }
    return out;
}

}  // namespace

FilmStatistics measure(const Film& film, const RowRunner& run) {
    const uint32_t width = film.extent().x, height = film.extent().y;
    std::vector<RowSums> rows(height);
    run(height, [&](uint32_t begin, uint32_t end) {
        for (uint32_t y = begin; y < end; ++y)
            rows[y] = sum_row(film.pixels().subspan(size_t{y} * width, width));
    });
    FilmStatistics out;
    out.min_samples = film.pixels().empty() ? 0 : 0xffffffffu;
    double luminance_sum = 0;
    for (const RowSums& row : rows) {
        out.total_samples += row.samples;
        out.non_finite += row.non_finite;
        out.min_samples = std::min(out.min_samples, row.min_samples);
        luminance_sum += row.luminance;
    }
    const auto pixels = static_cast<double>(std::max<size_t>(film.pixels().size(), 1));
    out.mean_samples = static_cast<double>(out.total_samples) / pixels;
    out.mean_luminance = luminance_sum / pixels;
    out.relative_error = out.relative_error_95 = std::numeric_limits<double>::quiet_NaN();
    if (out.min_samples < 2) return out;

    // The mean and the 95th percentile of the replicates' differences.
    Histogram errors;
    std::mutex mutex;
    run(height, [&](uint32_t begin, uint32_t end) {
        Histogram here;
        std::vector<float> error(width);
        for (uint32_t y = begin; y < end; ++y) {
            relative_half_differences(film, out.mean_luminance, y, error);
            for (const float each : error) {
                rows[y].error += static_cast<double>(each);
                here.add(each);
            }
        }
        const std::lock_guard lock(mutex);
        errors.add(here);
    });
    double error_sum = 0;
    for (const RowSums& row : rows)
        error_sum += row.error;
    out.relative_error = error_sum / pixels;
    out.relative_error_95 = errors.quantile(0.95, film.pixels().size());
    return out;
}

}  // namespace candela
