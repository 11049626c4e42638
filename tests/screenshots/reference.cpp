// SPDX-License-Identifier: MIT
#include "tests/screenshots/reference.h"

#include "renderer/image/codec.h"

namespace candela::test {

namespace {

constexpr int block_side = 8;
// Rounding to 256 levels spreads a value evenly over one of them.
constexpr double rounding_variance = 1.0 / 12 / 255 / 255;

// Of display values, per channel.
glm::dvec3 block_mean(const ImageRgba8& render, int x0, int y0) {
    glm::dvec3 sum(0);
    int count = 0;
    for (int y = y0; y < std::min(y0 + block_side, render.height()); ++y) {
        for (int x = x0; x < std::min(x0 + block_side, render.width()); ++x) {
            sum += glm::dvec3(render(x, y)) / 255.0;
            ++count;
        }
    }
    return sum / static_cast<double>(count);
}

int blocks_along(int pixels) {
    return (pixels + block_side - 1) / block_side;
}

// The mean and the sample variance of value(render) over the renders.
template <typename Value>
std::pair<glm::dvec3, glm::dvec3> moments(const std::vector<ImageRgba8>& renders, Value value) {
    const auto n = static_cast<double>(renders.size());
    glm::dvec3 sum(0), squares(0);
    for (const ImageRgba8& render : renders) {
        const glm::dvec3 v = value(render);
        sum += v;
        squares += v * v;
    }
    const glm::dvec3 mean = sum / n;
    return {mean, glm::max(squares - n * mean * mean, glm::dvec3(0)) / (n - 1)};
}

// Of the difference between a render and the reference, from the variance of one render.
glm::dvec3 variance_of_difference(const Vec3& variance, double rounded_values) {
    return glm::dvec3(variance) * (1 + 1.0 / reference_renders) + rounding_variance / rounded_values;
}

}  // namespace

Reference make_reference(const std::vector<ImageRgba8>& renders) {
    const int width = renders.front().width(), height = renders.front().height();
    Reference out{ImageRgb32f(width, height), ImageRgb32f(width, height),
                  ImageRgb32f(blocks_along(width), blocks_along(height))};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto [mean, variance] =
                moments(renders, [&](const ImageRgba8& render) { return glm::dvec3(render(x, y)) / 255.0; });
            out.mean(x, y) = Vec3(mean);
            out.variance(x, y) = Vec3(variance);
        }
    }
    for (int y = 0; y < out.block_variance.height(); ++y) {
        for (int x = 0; x < out.block_variance.width(); ++x) {
            out.block_variance(x, y) = Vec3(moments(renders, [&](const ImageRgba8& render) {
                                                return block_mean(render, block_side * x, block_side * y);
                                            }).second);
        }
    }
    return out;
}

void write_reference(const std::filesystem::path& path, const Reference& reference) {
    const int width = reference.mean.width(), height = reference.mean.height();
    const int block_rows = reference.block_variance.height();
    ImageRgba32f stacked(width, 2 * height + block_rows);
    const auto put = [&](const ImageRgb32f& part, int from) {
        for (int y = 0; y < part.height(); ++y) {
            for (int x = 0; x < part.width(); ++x)
                stacked(x, from + y) = Vec4(part(x, y), 1);
        }
    };
    put(reference.mean, 0);
    put(reference.variance, height);
    put(reference.block_variance, 2 * height);
    write_exr(path, stacked, false, {{"content", "display values: means, variances, variances of blocks of 8x8"}});
}

Reference read_reference(const std::filesystem::path& path) {
    const ImageRgba32f stacked = read_linear(path);
    // Two rows of each row of pixels, and one of each row of blocks.
    const int width = stacked.width();
    int height = stacked.height() / 2;
    while (height > 0 && 2 * height + blocks_along(height) > stacked.height())
        --height;
    const auto get = [&](int columns, int rows, int from) {
        ImageRgb32f part(columns, rows);
        for (int y = 0; y < rows; ++y) {
            for (int x = 0; x < columns; ++x)
                part(x, y) = Vec3(stacked(x, from + y));
        }
        return part;
    };
    return {get(width, height, 0), get(width, height, height),
            get(blocks_along(width), blocks_along(height), 2 * height)};
}

Deviation compare(const ImageRgba8& render, const Reference& reference) {
    Deviation out;
    constexpr double n = reference_renders;
    out.expected_mean_square_z = (n - 1) / (n - 3);
    double sum = 0, squares = 0, count = 0;
    for (int y = 0; y < render.height(); ++y) {
        for (int x = 0; x < render.width(); ++x) {
            const glm::dvec3 difference = glm::dvec3(render(x, y)) / 255.0 - glm::dvec3(reference.mean(x, y));
            const glm::dvec3 z = difference / glm::sqrt(variance_of_difference(reference.variance(x, y), 1));
            for (int c = 0; c < 3; ++c) {
                sum += z[c] * z[c];
                squares += std::pow(z[c], 4);
                ++count;
            }
        }
    }
    for (int y0 = 0; y0 < render.height(); y0 += block_side) {
        for (int x0 = 0; x0 < render.width(); x0 += block_side) {
            glm::dvec3 expected(0);
            int pixels = 0;
            for (int y = y0; y < std::min(y0 + block_side, render.height()); ++y) {
                for (int x = x0; x < std::min(x0 + block_side, render.width()); ++x) {
                    expected += glm::dvec3(reference.mean(x, y));
                    ++pixels;
                }
            }
            const glm::dvec3 difference = block_mean(render, x0, y0) - expected / static_cast<double>(pixels);
            const glm::dvec3 z =
                glm::abs(difference) /
                glm::sqrt(variance_of_difference(reference.block_variance(x0 / block_side, y0 / block_side), pixels));
            const double worst = std::max({z.x, z.y, z.z});
            if (worst <= out.worst_block_z) continue;
            out.worst_block_z = worst;
            out.worst_x = x0;
            out.worst_y = y0;
        }
    }
    out.mean_square_z = sum / count;
    out.mean_square_z_error = std::sqrt((squares / count - out.mean_square_z * out.mean_square_z) / count);
    return out;
}

}  // namespace candela::test
