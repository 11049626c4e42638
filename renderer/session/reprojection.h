// SPDX-License-Identifier: MIT
// While the camera moves: the picture of the view that was left, seen from where the camera is now. Only to look at: no
// sample of it enters a film.
#pragma once

#include <vector>

#include "renderer/film/film.h"
#include "renderer/integrator/integrator.h"

namespace candela {

// What a pixel shows, as a pinhole sees it through the pixel's centre: tells whether two pictures show the same.
struct SurfaceGuide {
    Vec3 position{std::numeric_limits<float>::quiet_NaN()};  // NaN: not known; far away where nothing is hit
    Vec3 normal{0};                                          // of the surface, towards the eye; 0: nothing is hit
};

SurfaceGuide trace_guide(const World& world, const View& view, Vec2u pixel) noexcept;

// Of the pixels whose coordinates are multiples of the stride.
class GuideLattice {
  public:
    GuideLattice() = default;
    GuideLattice(Vec2u extent, uint32_t stride);

    Vec2u size() const { return size_; }
    uint32_t stride() const { return stride_; }
    SurfaceGuide& at(Vec2u i) { return guides_[size_t{i.y} * size_.x + i.x]; }
    const SurfaceGuide& at(Vec2u i) const { return guides_[size_t{i.y} * size_.x + i.x]; }
    // Row i.y of the lattice; any thread.
    void trace_row(const World& world, const View& view, uint32_t row) noexcept;

  private:
    Vec2u size_{0};
    uint32_t stride_ = 1;
    std::vector<SurfaceGuide> guides_;
};

// World points to pixels: (0.5, 0.5) is the middle of the first; z is the distance along the view axis.
class PixelProjection {
  public:
    explicit PixelProjection(const View& view);
    Vec3 operator()(const Vec3& world_point) const noexcept;

  private:
    View view_;
    Mat3 pixel_from_world_{1.0f};
    Vec3 eye_{0};
    bool perspective_ = false, panorama_ = false;
    float aspect_ = 1;
};

// From which view of the same world: its film and what each of its pixels shows (a lattice of stride 1).
struct ReprojectionSource {
    const Film* film = nullptr;
    const GuideLattice* guides = nullptr;
    View view;
    std::span<const Vec3> weights = {};  // of the film's light groups
};

// Fills rows [row_begin, row_end) of out, which has the extent of both views: the source's mean radiance and alpha
// where it shows what the view shows, red NaN where it does not: where depth or normal disagree with those of the
// view's own lattice. step: of a square of so many pixels along its sides, a divisor of row_begin, one is looked for
// and fills it.
void reproject_rows(const ReprojectionSource& source, const View& view, const GuideLattice& lattice, uint32_t row_begin,
                    uint32_t row_end, ImageRgba32f& out, uint32_t step = 1) noexcept;

// Rows of a picture to look at: out = image, which the film was resolved to, led over from what was reprojected. A
// pixel needs most_reprojected_samples of its own until nothing is left of that.
inline constexpr uint32_t most_reprojected_samples = 16;
void blend_reprojected_rows(const Film& film, const ImageRgba32f& image, const ImageRgba32f& reprojected,
                            uint32_t row_begin, uint32_t row_end, ImageRgba32f& out) noexcept;

}  // namespace candela
