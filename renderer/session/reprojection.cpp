// SPDX-License-Identifier: MIT
#include "renderer/session/reprojection.h"

#include <algorithm>
#include <array>

#include "renderer/world/surface_point.h"

namespace candela {

namespace {

// Directions that hit nothing count as points this many times the scene's size away.
constexpr float sky_distance = 1e4f;
// How far off a surface may be, as a part of its distance, and how far turned, to be the same one.
constexpr float depth_tolerance = 0.02f;
constexpr float normal_tolerance_cos = 0.7f;
// Nearer than this, in pixels, is the same pixel; where the new view stretches a surface, the nearest one that there is
// may be this far off.
constexpr float pixel_tolerance = 0.71f, stretched_tolerance = 1.6f;
constexpr int most_steps = 3;
// A reprojected pixel counts as so many samples while the pixel has none of its own.
constexpr float reprojected_weight = 8;

bool is_known(const SurfaceGuide& guide) {
    return std::isfinite(guide.position.x);
}

// A point of the view's lattice, and where the source shows it.
struct Corner {
    SurfaceGuide guide;
    Vec3 at{0};            // in the view's pixels, and its depth
    Vec2 offset{0};        // from there to the source's pixels
    bool is_seen = false;  // by the source
};

bool agree(const SurfaceGuide& found, float depth, const Corner& corner) {
    const Vec3& normal = corner.guide.normal;
    const bool found_sky = found.normal == Vec3(0), corner_sky = normal == Vec3(0);
    if (found_sky || corner_sky) return found_sky && corner_sky;
    if (glm::dot(found.normal, normal) < normal_tolerance_cos) return false;
    const float allowed = depth_tolerance * std::abs(corner.at.z);
    return std::abs(depth - corner.at.z) < allowed ||
           std::abs(glm::dot(normal, found.position - corner.guide.position)) < 0.25f * allowed;
}

// One row of the view against the source.
class RowSearch {
  public:
    RowSearch(const ReprojectionSource& source, const PixelProjection& to_view) : source_(source), to_view_(to_view) {}

    // Which pixel of the source shows what the view's pixel shows, if its offset is about that (Bowles et al. 2012,
    // "Iterative Image Warping", section 3: the fixed point of the flow).
    std::optional<Vec2u> search(const Vec2& pixel, Vec2& offset) {
        const Vec2 extent(source_.view.extent);
        float best = stretched_tolerance;
        std::optional<Vec2u> out;
        for (int step = 0; step < most_steps; ++step) {
            const Vec2 at = pixel + offset;
            if (!(at.x >= 0 && at.y >= 0 && at.x < extent.x && at.y < extent.y)) return out;
            const Vec2u candidate(at);
            const SurfaceGuide& guide = source_.guides->at(candidate);
            if (!is_known(guide)) return out;
            const Vec3 seen = to_view_(guide.position);
            // The candidate's centre is seen there: the rest is how far the offset is off.
            const Vec2 miss = pixel - Vec2(seen);
            const float distance = std::max(std::abs(miss.x), std::abs(miss.y));
            if (distance < best) {
                best = distance;
                out = candidate;
                found_ = guide;
                depth_ = seen.z;
            }
            if (distance < pixel_tolerance) return out;
            offset = Vec2(candidate) + 0.5f + miss - pixel;
        }
        return out;
    }
    const SurfaceGuide& found() const { return found_; }
    float depth() const { return depth_; }

  private:
    const ReprojectionSource& source_;
    const PixelProjection& to_view_;
    SurfaceGuide found_;
    float depth_ = 0;
};

Corner make_corner(const SurfaceGuide& guide, const PixelProjection& to_view, const PixelProjection& to_source,
                   RowSearch& row) {
    Corner out;
    out.guide = guide;
    if (!is_known(guide)) return out;
    out.at = to_view(guide.position);
    out.offset = Vec2(to_source(guide.position)) - Vec2(out.at);
    Vec2 offset = out.offset;
    out.is_seen = row.search(Vec2(out.at), offset) && agree(row.found(), row.depth(), out);
    return out;
}

// Nearest first; `flat` where all of them are about as far away.
struct Cell {
    std::array<const Corner*, 4> corners;
    bool flat = false;

    Cell(const Corner& a, const Corner& b, const Corner& c, const Corner& d) : corners{&a, &b, &c, &d} {
        std::sort(corners.begin(), corners.end(), [](const Corner* x, const Corner* y) { return x->at.z < y->at.z; });
        flat = corners[3]->at.z - corners[0]->at.z < 2 * depth_tolerance * corners[0]->at.z;
    }
};

}  // namespace

SurfaceGuide trace_guide(const World& world, const View& view, Vec2u pixel) noexcept {
    Camera pinhole = view.camera;
    pinhole.aperture_diameter_m = 0.0f;
    const Vec2 extent(view.extent);
    const Ray ray = generate_ray(pinhole, extent.x / extent.y, (Vec2(pixel) + 0.5f) / extent, Vec2(0.5f));
    const Hit hit = world.accel->intersect(ray, 0);
    if (!hit.valid()) {
        const float size = glm::length(world.bounds.upper - world.bounds.lower);
        return {ray.origin + ray.direction * (sky_distance * std::max(size, 1e-3f)), Vec3(0)};
    }
    const SurfacePoint point = make_surface_point(world, hit, -ray.direction);
    return {point.position, point.geometric_normal};
}

GuideLattice::GuideLattice(Vec2u extent, uint32_t stride)
    : size_((extent + stride - 1u) / stride), stride_(stride), guides_(size_t{size_.x} * size_.y) {}

void GuideLattice::trace_row(const World& world, const View& view, uint32_t row) noexcept {
    for (uint32_t i = 0; i < size_.x; ++i)
        at({i, row}) = trace_guide(world, view, Vec2u(i, row) * stride_);
}

PixelProjection::PixelProjection(const View& view)
    : view_(view),
      eye_(view.camera.position()),
      perspective_(view.camera.projection == Projection::perspective),
      panorama_(view.camera.projection == Projection::panorama) {
    const Vec2 extent(view.extent);
    aspect_ = extent.x / extent.y;
    const float half_height =
        perspective_ ? std::tan(0.5f * view.camera.yfov_radians) : view.camera.ortho_half_height_m;
    const Vec2 scale = 0.5f * extent / (half_height * Vec2(aspect_, 1.0f));
    const Mat3 camera_from_world = glm::transpose(Mat3(view.camera.world_from_camera));
    pixel_from_world_ = Mat3(Vec3(scale.x, 0, 0), Vec3(0, -scale.y, 0), Vec3(0, 0, -1)) * camera_from_world;
}

Vec3 PixelProjection::operator()(const Vec3& world_point) const noexcept {
    const Vec2 extent(view_.extent);
    if (panorama_) {
        const Vec3 p = project(view_.camera, aspect_, world_point);
        return {Vec2(p) * extent, p.z};
    }
    const Vec3 p = pixel_from_world_ * (world_point - eye_);
    // Behind a perspective camera nothing is seen.
    if (perspective_ && !(p.z > 0)) return Vec3(-infinity);
    return {Vec2(p) * (perspective_ ? 1.0f / p.z : 1.0f) + 0.5f * extent, p.z};
}

void reproject_rows(const ReprojectionSource& source, const View& view, const GuideLattice& lattice, uint32_t row_begin,
                    uint32_t row_end, ImageRgba32f& out, uint32_t step) noexcept {
    const PixelProjection to_view(view), to_source(source.view);
    const Vec2u last = lattice.size() - 1u;
    std::vector<Corner> above(lattice.size().x), below(lattice.size().x);
    uint32_t corners_of = invalid_index;
    RowSearch row(source, to_view);
    for (uint32_t y = row_begin; y < row_end; y += step) {
        const uint32_t top = y / lattice.stride();
        if (corners_of != top) {
            for (uint32_t i = 0; i < lattice.size().x; ++i) {
                above[i] = make_corner(lattice.at({i, top}), to_view, to_source, row);
                below[i] = make_corner(lattice.at({i, std::min(top + 1, last.y)}), to_view, to_source, row);
            }
            corners_of = top;
        }
        for (uint32_t left = 0; left < lattice.size().x; ++left) {
            const uint32_t right = std::min(left + 1, last.x);
            const Cell cell(above[left], above[right], below[left], below[right]);
            const auto agrees = [&] {
                return std::any_of(cell.corners.begin(), cell.corners.end(),
                                   [&](const Corner* corner) { return agree(row.found(), row.depth(), *corner); });
            };
            const uint32_t end = std::min((left + 1) * lattice.stride(), view.extent.x);
            std::optional<Vec2> before;
            for (uint32_t x = (left * lattice.stride() + step - 1) / step * step; x < end; x += step) {
                const Vec2 pixel = Vec2(Vec2u(x, y) + step / 2) + 0.5f;
                std::optional<Vec2u> found;
                // On one surface neighbours move alike; at an edge the nearer surface is asked for first.
                if (cell.flat && before) {
                    found = row.search(pixel, *before);
                    if (found && !agrees()) found.reset();
                }
                for (size_t c = 0; c < 4 && !found; ++c) {
                    // What the source does not see at all may reach to here, and hides what lies behind it.
                    if (!cell.corners[c]->is_seen) {
                        if (cell.flat) continue;
                        break;
                    }
                    before = cell.corners[c]->offset;
                    found = row.search(pixel, *before);
                    if (found && !agrees()) found.reset();
                }
                Vec4 color(std::numeric_limits<float>::quiet_NaN(), 0, 0, 0);
                if (found) {
                    const FilmPixel& sums = source.film->at(*found);
                    if (sums.count > 0) color = source.film->mean(sums, source.weights);
                } else {
                    before.reset();
                }
                for (uint32_t j = y; j < std::min(y + step, row_end); ++j) {
                    for (uint32_t i = x; i < std::min(x + step, view.extent.x); ++i)
                        out(static_cast<int>(i), static_cast<int>(j)) = color;
                }
            }
        }
    }
}

void blend_reprojected_rows(const Film& film, const ImageRgba32f& image, const ImageRgba32f& reprojected,
                            uint32_t row_begin, uint32_t row_end, ImageRgba32f& out) noexcept {
    for (uint32_t y = row_begin; y < row_end; ++y) {
        for (uint32_t x = 0; x < film.extent().x; ++x) {
            const auto i = static_cast<int>(x), j = static_cast<int>(y);
            const Vec4& old = reprojected(i, j);
            const auto own = static_cast<float>(film.at({x, y}).count);
            const float left = 1 - own / static_cast<float>(most_reprojected_samples);
            if (std::isnan(old.x) || left <= 0) {
                out(i, j) = image(i, j);
                continue;
            }
            const float weight = reprojected_weight * left;
            out(i, j) = own > 0 ? glm::mix(image(i, j), old, weight / (weight + own)) : old;
        }
    }
}

}  // namespace candela
