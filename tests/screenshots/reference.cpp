// SPDX-License-Identifier: MIT
#include "tests/screenshots/reference.h"

#include "renderer/image/codec.h"

namespace candela::test {

namespace {

constexpr int block_side = 8;
// Rounding to 256 levels spreads a value evenly over one of them.
constexpr double rounding_variance = 1.0 / 12 / 255 / 255;

}  // namespace

Reference make_reference(const std::vector<ImageRgba8>& renders) {
    const int width = renders.front().width(), height = renders.front().height();
    Reference out{ImageRgb32f(width, height), ImageRgb32f(width, height)};
    const auto n = static_cast<double>(renders.size());
    for (size_t i = 0; i < out.mean.size(); ++i) {
        glm::dvec3 sum(0), squares(0);
        for (const ImageRgba8& render : renders) {
            const glm::dvec3 value = glm::dvec3(render.pixels()[i]) / 255.0;
            sum += value;
            squares += value * value;
        }
        const glm::dvec3 mean = sum / n;
        out.mean.pixels()[i] = Vec3(mean);
        out.variance.pixels()[i] = Vec3(glm::max(squares - n * mean * mean, glm::dvec3(0)) / (n - 1));
    }
    return out;
}

void write_reference(const std::filesystem::path& path, const Reference& reference) {
    const int width = reference.mean.width(), height = reference.mean.height();
    ImageRgba32f stacked(width, 2 * height);
    for (size_t i = 0; i < reference.mean.size(); ++i) {
        stacked.pixels()[i] = Vec4(reference.mean.pixels()[i], 1);
        stacked.pixels()[reference.mean.size() + i] = Vec4(reference.variance.pixels()[i], 1);
    }
    write_exr(path, stacked, false, {{"content", "display values: mean above, variance below"}});
}

Reference read_reference(const std::filesystem::path& path) {
    const ImageRgba32f stacked = read_linear(path);
    const int width = stacked.width(), height = stacked.height() / 2;
    Reference out{ImageRgb32f(width, height), ImageRgb32f(width, height)};
    for (size_t i = 0; i < out.mean.size(); ++i) {
        out.mean.pixels()[i] = Vec3(stacked.pixels()[i]);
        out.variance.pixels()[i] = Vec3(stacked.pixels()[out.mean.size() + i]);
    }
    return out;
}

Deviation compare(const ImageRgba8& render, const Reference& reference) {
    Deviation out;
    constexpr double n = reference_renders;
    out.expected_mean_square_z = (n - 1) / (n - 3);
    double sum = 0, squares = 0, count = 0;
    for (int y0 = 0; y0 < render.height(); y0 += block_side) {
        for (int x0 = 0; x0 < render.width(); x0 += block_side) {
            glm::dvec3 block_sum(0);
            int block_count = 0;
            for (int y = y0; y < std::min(y0 + block_side, render.height()); ++y) {
                for (int x = x0; x < std::min(x0 + block_side, render.width()); ++x) {
                    const glm::dvec3 value = glm::dvec3(render(x, y)) / 255.0;
                    const glm::dvec3 variance = glm::dvec3(reference.variance(x, y)) * (1 + 1 / n) + rounding_variance;
                    const glm::dvec3 z = (value - glm::dvec3(reference.mean(x, y))) / glm::sqrt(variance);
                    block_sum += z;
                    ++block_count;
                    for (int c = 0; c < 3; ++c) {
                        sum += z[c] * z[c];
                        squares += std::pow(z[c], 4);
                        ++count;
                    }
                }
            }
            for (int c = 0; c < 3; ++c) {
                const double block_z = std::abs(block_sum[c]) / std::sqrt(block_count);
                if (block_z <= out.worst_block_z) continue;
                out.worst_block_z = block_z;
                out.worst_x = x0;
                out.worst_y = y0;
            }
        }
    }
    out.mean_square_z = sum / count;
    out.mean_square_z_error = std::sqrt((squares / count - out.mean_square_z * out.mean_square_z) / count);
    return out;
}

}  // namespace candela::test
