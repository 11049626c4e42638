// SPDX-License-Identifier: MIT
#include "renderer/film/film.h"

namespace candela {

void resolve_rows(const Film& film, uint32_t row_begin, uint32_t row_end, Frame& frame,
                  std::span<const Vec3> weights) noexcept {
    constexpr uint32_t coarsest = 64;
    const uint32_t width = film.extent().x;
    for (uint32_t y = row_begin; y < row_end; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            // A pixel without samples looks at the lattice points above and to the left of it, finest first.
            const FilmPixel* pixel = &film.at({x, y});
            for (uint32_t stride = 2; pixel->count == 0 && stride <= coarsest; stride *= 2) {
                pixel = &film.at({x & ~(stride - 1), y & ~(stride - 1)});
            }
            frame.image(static_cast<int>(x), static_cast<int>(y)) = film.mean(*pixel, weights);
        }
    }
}

}  // namespace candela
