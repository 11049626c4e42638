// SPDX-License-Identifier: MIT
#include "renderer/film/film.h"

#include "renderer/sampling/sampler.h"

namespace candela {

Film::Film(Vec2u extent) : extent_(extent), pixels_(size_t{extent.x} * extent.y) {}

void Film::clear() {
    clear_rows(0, extent_.y);
}

void Film::clear_rows(uint32_t row_begin, uint32_t row_end) noexcept {
    std::fill_n(pixels_.begin() + static_cast<std::ptrdiff_t>(size_t{row_begin} * extent_.x),
                size_t{row_end - row_begin} * extent_.x, FilmPixel{});
}

void Film::add(Vec2u pixel, uint32_t sample_index, const Vec3& radiance, float alpha, PathCost cost) noexcept {
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
}

}  // namespace candela
