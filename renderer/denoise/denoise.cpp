// SPDX-License-Identifier: MIT
#include "renderer/denoise/denoise.h"

#include <bit>

#include "renderer/denoise/plane.h"
#include "renderer/film/replicates.h"
#include "renderer/math/parallel.h"

namespace candela {

namespace {

// A pixel is a weighted mean of those so far around it; how alike two of them are is seen in squares around both.
constexpr int window_radius = 8;
constexpr int patch_radius = 3;
constexpr int patch_side = 2 * patch_radius + 1;
constexpr int margin = window_radius + patch_radius;
constexpr int strip_rows = 32;

// How far two pixels may differ: in units of their noise, and of each guide. The depth's is of its logarithm.
constexpr float noise_tolerance = 0.6f;
constexpr float albedo_tolerance = 0.2f;
constexpr float normal_tolerance = 0.4f;
constexpr float depth_tolerance = 0.02f;

// Darker albedos do not divide their pixel's colour any more.
constexpr float least_albedo = 0.02f;
// A pixel is no brighter than the so many-th of its alike neighbours, so many pixels around: what fewer samples than
// that have brought is not a light that a preview can show.
constexpr size_t firefly_rank = 3;
constexpr int firefly_radius = 3;
constexpr float same_face = 0.1f;  // of squared differences of normals

float square(float x) {
    return x * x;
}

// exp(-x) for x ≥ 0, within 1e-4: a Taylor polynomial for the fraction of the power of two, bits for the whole.
float exp_of_minus(float x) {
    const float power = std::min(x, 80.0f) * -1.44269504f;
    const int whole = static_cast<int>(power);
    const float f = power - static_cast<float>(whole);
    const float fraction =
        1.0f + f * (0.69314718f + f * (0.24022651f + f * (0.05550411f + f * (0.00961813f + f * 0.00133336f))));
    return fraction * std::bit_cast<float>((whole + 127) << 23);
}

Vec3 demodulating_albedo(const Guides& guides, int x, int y) {
    return glm::max(guides.albedo(x, y) / static_cast<float>(guides.passes), Vec3(least_albedo));
}

// What the filter looks at, each in a plane of its own, as vectors like it.
struct Planes {
    Planes(int w, int h) : width(w), height(h) {}

    int width, height;
    // Of the picture divided by the albedo; variance: of the luminance.
    Plane luminance = plane(), variance = plane();
    Plane color[3] = {plane(), plane(), plane()};
    Plane albedo[3] = {plane(), plane(), plane()};
    Plane normal[3] = {plane(), plane(), plane()};
    Plane log_depth = plane(), depth_scale = plane();  // of squared differences
    Plane inside = plane();                            // 1 in the picture, 0 around it and where nothing is known

    Plane plane() const { return {width, height, margin}; }
};

// The half difference of the replicates is as large as the error of their mean (film/statistics.cpp); a pixel that has
// but one sample knows nothing of it.
void read_film(const Film& film, const Guides& guides, Planes& p, Plane& raw_variance) {
    parallel_for_each(static_cast<size_t>(p.height), 8, [&](size_t row) {
        const int y = static_cast<int>(row);
        const float share = 1.0f / static_cast<float>(guides.passes);
        for (int x = 0; x < p.width; ++x) {
            const FilmPixel& pixel = film.at({x, y});
            const Vec3 albedo = demodulating_albedo(guides, x, y), normal = guides.normal(x, y) * share;
            const float scale = 1.0f / luminance(albedo);
            const Vec3 color = pixel.radiance_sum / (static_cast<float>(std::max(pixel.count, 1u)) * albedo);
            p.luminance(x, y) = mean_of(pixel) * scale;
            raw_variance(x, y) = square(std::max(half_difference(pixel), 0.0f) * scale);
            for (int c = 0; c < 3; ++c) {
                p.color[c](x, y) = color[c];
                p.albedo[c](x, y) = albedo[c];
                p.normal[c](x, y) = normal[c];
            }
            p.log_depth(x, y) = std::log(1e-6f + guides.depth(x, y) * share);
            p.inside(x, y) = pixel.count > 0 ? 1.0f : 0.0f;
        }
    });
    for (Plane* plane : {&p.albedo[0], &p.albedo[1], &p.albedo[2], &p.normal[0], &p.normal[1], &p.normal[2],
                         &p.log_depth, &p.luminance})
        plane->extend();
}

void tame_fireflies(Planes& p, Plane& raw_variance) {
    const Plane luminance = p.luminance;
    parallel_for_each(static_cast<size_t>(p.height), 8, [&](size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < p.width; ++x) {
            // The brightest of the others on the same face, brightest first.
            std::array<float, firefly_rank> brightest{};
            size_t alike = 0;
            for (int v = std::max(y - firefly_radius, 0); v <= std::min(y + firefly_radius, p.height - 1); ++v) {
                for (int u = std::max(x - firefly_radius, 0); u <= std::min(x + firefly_radius, p.width - 1); ++u) {
                    float turned = 0;
                    for (const Plane& n : p.normal)
                        turned += square(n(u, v) - n(x, y));
                    if (turned >= same_face || (u == x && v == y)) continue;
                    ++alike;
                    float value = luminance(u, v);
                    for (float& each : brightest) {
                        if (value > each) std::swap(value, each);
                    }
                }
            }
            // What both replicates have seen is a lamp.
            const float here = luminance(x, y), dimmer = here - std::sqrt(raw_variance(x, y));
            const float bound = std::max(brightest.back(), dimmer);
            if (alike < 2 * firefly_rank || here <= bound) continue;
            const float scale = bound / here;
            p.luminance(x, y) *= scale;
            for (Plane& c : p.color)
                c(x, y) *= scale;
            raw_variance(x, y) *= scale * scale;
        }
    });
}

// Depths may differ as far as the slope of the surface lets them.
void scale_depths(Planes& p) {
    parallel_for_each(static_cast<size_t>(p.height), 8, [&](size_t row) {
        const int y = static_cast<int>(row);
        const Plane& z = p.log_depth;
        for (int x = 0; x < p.width; ++x) {
            const float right = std::min(std::abs(z(x + 1, y) - z(x, y)), std::abs(z(x, y) - z(x - 1, y)));
            const float down = std::min(std::abs(z(x, y + 1) - z(x, y)), std::abs(z(x, y) - z(x, y - 1)));
            p.depth_scale(x, y) =
                1.0f / (square(depth_tolerance) + square(window_radius) * (right * right + down * down));
        }
    });
}

// One difference of replicates says little of its pixel: variances are pooled over a patch, as far as the guides are
// alike (the edge of a lamp says nothing of the wall beside it), but a pixel that is worse than that is believed by
// half.
void pool_variance(const Plane& raw_variance, Planes& p) {
    parallel_for_each(static_cast<size_t>(p.height), 8, [&](size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < p.width; ++x) {
            float sum = 0, weights = 0;
            for (int v = std::max(y - patch_radius, 0); v <= std::min(y + patch_radius, p.height - 1); ++v) {
                for (int u = std::max(x - patch_radius, 0); u <= std::min(x + patch_radius, p.width - 1); ++u) {
                    float albedo = 0, normal = 0;
                    for (int c = 0; c < 3; ++c) {
                        albedo += square(p.albedo[c](u, v) - p.albedo[c](x, y));
                        normal += square(p.normal[c](u, v) - p.normal[c](x, y));
                    }
                    const float weight =
                        exp_of_minus(std::max(albedo / square(albedo_tolerance), normal / square(normal_tolerance)));
                    sum += weight * raw_variance(u, v);
                    weights += weight;
                }
            }
            p.variance(x, y) = std::max(sum / weights, 0.5f * raw_variance(x, y));
        }
    });
}

// Rows [begin, end) of the picture, by one offset between pixel and neighbour after the other.
class Strip {
  public:
    Strip(const Planes& planes, int begin, int end)
        : p_(planes),
          begin_(begin),
          end_(end),
          width_(static_cast<size_t>(planes.width)),
          distance_(width_ + patch_side - 1),
          boxed_(width_ * static_cast<size_t>(end - begin + patch_side - 1)),
          sums_(4 * width_ * static_cast<size_t>(end - begin)) {}

    void add_neighbours(int dx, int dy) noexcept {
        for (int y = begin_ - patch_radius; y < end_ + patch_radius; ++y)
            compare_row(y, dx, dy);
        for (int y = begin_; y < end_; ++y)
            weigh_row(y, dx, dy);
    }
    Vec3 mean(int x, int y) const noexcept {
        const float* sum = sums_.data() + 4 * width_ * static_cast<size_t>(y - begin_) + x;
        const float weight = sum[3 * width_];
        return weight > 0.0f ? Vec3(sum[0], sum[width_], sum[2 * width_]) / weight : Vec3(0);
    }

  private:
    // Distances of the luminance less what noise makes of them (Rousselle et al. 2012, equation 5), summed along the
    // row over a patch.
    void compare_row(int y, int dx, int dy) noexcept {
        const float *l = p_.luminance.row(y) - patch_radius, *v = p_.variance.row(y) - patch_radius;
        const float *m = p_.luminance.row(y + dy) + dx - patch_radius, *w = p_.variance.row(y + dy) + dx - patch_radius;
        float* distance = distance_.data();
        for (size_t x = 0; x < distance_.size(); ++x) {
            distance[x] = (square(l[x] - m[x]) - (v[x] + std::min(v[x], w[x]))) /
                          (1e-10f + square(noise_tolerance) * (v[x] + w[x]));
        }
        float* boxed = boxed_.data() + width_ * static_cast<size_t>(y - begin_ + patch_radius);
        for (size_t x = 0; x < width_; ++x) {
            float sum = 0;
            for (size_t i = 0; i < patch_side; ++i)
                sum += distance[x + i];
            boxed[x] = sum;
        }
    }

    // The weight falls with what differs most: the patches, or one of the guides (Rousselle et al. 2013, section 4).
    void weigh_row(int y, int dx, int dy) noexcept {
        const float* boxed = boxed_.data() + width_ * static_cast<size_t>(y - begin_);
        const auto here = [&](const Plane& plane) { return plane.row(y); };
        const auto there = [&](const Plane& plane) { return plane.row(y + dy) + dx; };
        const float *a0 = here(p_.albedo[0]), *a1 = here(p_.albedo[1]), *a2 = here(p_.albedo[2]);
        const float *b0 = there(p_.albedo[0]), *b1 = there(p_.albedo[1]), *b2 = there(p_.albedo[2]);
        const float *n0 = here(p_.normal[0]), *n1 = here(p_.normal[1]), *n2 = here(p_.normal[2]);
        const float *m0 = there(p_.normal[0]), *m1 = there(p_.normal[1]), *m2 = there(p_.normal[2]);
        const float *z = here(p_.log_depth), *depth_scale = here(p_.depth_scale), *other_z = there(p_.log_depth);
        const float *red = there(p_.color[0]), *green = there(p_.color[1]), *blue = there(p_.color[2]);
        const float* inside = there(p_.inside);
        float *sum0 = sums_.data() + 4 * width_ * static_cast<size_t>(y - begin_), *sum1 = sum0 + width_,
              *sum2 = sum1 + width_, *weights = sum2 + width_;
        for (size_t x = 0; x < width_; ++x) {
            float patch = 0;
            for (size_t i = 0; i < patch_side; ++i)
                patch += boxed[x + i * width_];
            patch *= 1.0f / square(patch_side);
            const float albedo = square(a0[x] - b0[x]) + square(a1[x] - b1[x]) + square(a2[x] - b2[x]);
            const float normal = square(n0[x] - m0[x]) + square(n1[x] - m1[x]) + square(n2[x] - m2[x]);
            const float depth = square(z[x] - other_z[x]) * depth_scale[x];
            const float guide = std::max(albedo * (1.0f / square(albedo_tolerance)),
                                         std::max(normal * (1.0f / square(normal_tolerance)), depth));
            const float weight = inside[x] * exp_of_minus(std::max(guide, std::max(patch, 0.0f)));
            sum0[x] += weight * red[x];
            sum1[x] += weight * green[x];
            sum2[x] += weight * blue[x];
            weights[x] += weight;
        }
    }

    const Planes& p_;
    int begin_, end_;
    size_t width_;
    std::vector<float> distance_, boxed_;
    std::vector<float> sums_;  // of each row: three colours, then weights
};

}  // namespace

ImageRgba32f denoise(const Film& film, const Guides& guides, const std::atomic<bool>* cancel) {
    const auto stopped = [&] { return cancel != nullptr && cancel->load(std::memory_order_relaxed); };
    const int width = static_cast<int>(film.extent().x), height = static_cast<int>(film.extent().y);
    Planes planes(width, height);
    Plane raw_variance = planes.plane();
    read_film(film, guides, planes, raw_variance);
    tame_fireflies(planes, raw_variance);
    scale_depths(planes);
    pool_variance(raw_variance, planes);
    for (Plane* plane : {&planes.luminance, &planes.variance, &planes.color[0], &planes.color[1], &planes.color[2]})
        plane->extend();

    ImageRgba32f out(width, height);
    parallel_for_each(static_cast<size_t>((height + strip_rows - 1) / strip_rows), 1, [&](size_t i) {
        const int begin = static_cast<int>(i) * strip_rows, end = std::min(begin + strip_rows, height);
        Strip strip(planes, begin, end);
        for (int dy = -window_radius; dy <= window_radius; ++dy) {
            if (stopped()) return;
            for (int dx = -window_radius; dx <= window_radius; ++dx)
                strip.add_neighbours(dx, dy);
        }
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x) {
                const FilmPixel& pixel = film.at({x, y});
                const float alpha = pixel.alpha_sum / static_cast<float>(std::max(pixel.count, 1u));
                out(x, y) = Vec4(strip.mean(x, y) * demodulating_albedo(guides, x, y), alpha);
            }
        }
    });
    if (stopped()) return {};
    return out;
}

}  // namespace candela
