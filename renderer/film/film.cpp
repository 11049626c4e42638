// SPDX-License-Identifier: MIT
#include "renderer/film/film.h"

#include "renderer/sampling/sampler.h"

namespace candela {

Film::Film(Vec2u extent, size_t light_groups)
    : extent_(extent),
      pixels_(size_t{extent.x} * extent.y),
      light_groups_(light_groups),
      by_light_(pixels_.size() * light_groups) {}

void Film::clear() {
    clear_rows(0, extent_.y);
}

void Film::clear_rows(uint32_t row_begin, uint32_t row_end) noexcept {
    std::fill_n(pixels_.begin() + static_cast<std::ptrdiff_t>(size_t{row_begin} * extent_.x),
                size_t{row_end - row_begin} * extent_.x, FilmPixel{});
    const size_t row = extent_.x * light_groups_;
    std::fill_n(by_light_.begin() + static_cast<std::ptrdiff_t>(row_begin * row), (row_end - row_begin) * row, Vec3(0));
}

void Film::add(Vec2u pixel, uint32_t sample_index, const Vec3& radiance, float alpha, PathCost cost,
               std::span<const Vec3> by_light) noexcept {
    FilmPixel& p = pixels_[size_t{pixel.y} * extent_.x + pixel.x];
    p.segments += cost.segments;
    p.shadow_rays += cost.shadow_rays;
    if (!is_finite(radiance) || !std::isfinite(alpha)) {
        ++p.non_finite;
        return;
    }
    p.radiance_sum += radiance;
    p.alpha_sum += alpha;
    if (sample_index % replicate_count == 0) p.even_luminance_sum += luminance(radiance);
    ++p.count;
    Vec3* sums = by_light_.data() + static_cast<size_t>(&p - pixels_.data()) * light_groups_;
    for (size_t group = 0; group < std::min(by_light.size(), light_groups_); ++group)
        sums[group] += by_light[group];
}

Vec3 Film::weighted_sum(size_t index, std::span<const Vec3> weights) const noexcept {
    Vec3 out(0);
    for (size_t group = 0; group < light_groups_; ++group)
        out += weights[group] * by_light_[index * light_groups_ + group];
    return out;
}

Vec4 Film::mean(const FilmPixel& pixel, std::span<const Vec3> weights) const noexcept {
    if (pixel.count == 0) return Vec4(0);
    const float scale = 1.0f / static_cast<float>(pixel.count);
    const bool plain = light_groups_ == 0 || weights.size() != light_groups_;
    const Vec3 sum = plain ? pixel.radiance_sum : weighted_sum(static_cast<size_t>(&pixel - pixels_.data()), weights);
    return Vec4(sum * scale, pixel.alpha_sum * scale);
}

Film Film::reweighted(std::span<const Vec3> weights) const {
    Film out = *this;
    if (light_groups_ == 0 || weights.size() != light_groups_) return out;
    for (size_t i = 0; i < pixels_.size(); ++i) {
        FilmPixel& pixel = out.pixels_[i];
        const float before = luminance(pixel.radiance_sum);
        pixel.radiance_sum = weighted_sum(i, weights);
        if (before > 0) pixel.even_luminance_sum *= luminance(pixel.radiance_sum) / before;
    }
    return out;
}

}  // namespace candela
