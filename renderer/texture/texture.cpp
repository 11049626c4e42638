// SPDX-License-Identifier: MIT
#include "renderer/texture/texture.h"

#include <array>

namespace candela {

namespace {

std::array<float, 256> make_srgb_table() {
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        const double s = static_cast<double>(i) / 255.0;
        table[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return table;
}

// IEC 61966-2-1 for every 8-bit value.
const std::array<float, 256> linear_from_srgb_byte = make_srgb_table();

int wrap(int i, int size, WrapMode mode) {
    if (mode == WrapMode::clamp_to_edge) return std::clamp(i, 0, size - 1);
    const int period = mode == WrapMode::repeat ? size : 2 * size;
    int m = i % period;
    if (m < 0) m += period;
    return m < size ? m : period - 1 - m;
}

// A coordinate in texels, small enough for int arithmetic whatever the file says; not-a-number reads as 0.
float texel_coordinate(float t, int size, WrapMode mode) {
    if (mode == WrapMode::clamp_to_edge) {
        t = std::clamp(t, -1.0f, 2.0f);
    } else if (!(std::abs(t) < 1024.0f)) {
        t = std::isfinite(t) ? std::fmod(t, 2.0f) : 0.0f;
    }
    return (std::isnan(t) ? 0.0f : t) * static_cast<float>(size);
}

// What a lookup reads: one level, and how.
struct Level {
    const Rgba8* pixels = nullptr;
    int width = 0, height = 0;
    TextureFilter filter = TextureFilter::linear;
};

Level whole(const TextureView& texture) {
    return {texture.pixels, texture.width, texture.height, texture.mag_filter};
}

// The level whose texels are as large as the sample's part of the footprint.
Level choose_level(const TextureView& texture, const TextureFootprint& footprint) {
    Level out = whole(texture);
    const float texels = footprint.uv_area * static_cast<float>(texture.width) * static_cast<float>(texture.height);
    if (!(texels > 1.0f)) return out;
    out.filter = texture.min_filter;
    const float covered = texels * footprint.share;
    if (texture.smaller.empty() || !(covered > 1.0f)) return out;
    const float level = 0.5f * std::log2(covered);
    const float offset = texture.mip_filter == MipFilter::linear ? footprint.u_level : 0.5f;
    const float last = static_cast<float>(texture.smaller.size());
    const auto chosen = static_cast<size_t>(std::min(level + offset, last));
    if (chosen == 0) return out;
    const ImageRgba8& image = texture.smaller[chosen - 1];
    out.pixels = image.data();
    out.width = image.width();
    out.height = image.height();
    return out;
}

// Fetches texels through `decode` and blends the four around uv, or takes the nearest.
template <typename Decode>
auto lookup(const TextureView& texture, const Level& level, const Vec2& uv, Decode decode) {
    const float x = texel_coordinate(uv.x, level.width, texture.wrap_u);
    const float y = texel_coordinate(uv.y, level.height, texture.wrap_v);
    const auto fetch = [&](int column, int row) {
        return decode(
            level.pixels[static_cast<size_t>(row) * static_cast<size_t>(level.width) + static_cast<size_t>(column)]);
    };
    if (level.filter == TextureFilter::nearest) {
        return fetch(wrap(static_cast<int>(std::floor(x)), level.width, texture.wrap_u),
                     wrap(static_cast<int>(std::floor(y)), level.height, texture.wrap_v));
    }
    // Texel centres lie at half-integers.
    const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
    const float s = x - 0.5f - left, t = y - 0.5f - top;
    const int x0 = wrap(static_cast<int>(left), level.width, texture.wrap_u);
    const int x1 = wrap(static_cast<int>(left) + 1, level.width, texture.wrap_u);
    const int y0 = wrap(static_cast<int>(top), level.height, texture.wrap_v);
    const int y1 = wrap(static_cast<int>(top) + 1, level.height, texture.wrap_v);
    return (1 - t) * ((1 - s) * fetch(x0, y0) + s * fetch(x1, y0)) + t * ((1 - s) * fetch(x0, y1) + s * fetch(x1, y1));
}

}  // namespace

std::vector<TextureView> make_texture_views(const Scene& scene) {
    std::vector<TextureView> views;
    views.reserve(scene.textures.size());
    for (const Texture& texture : scene.textures) {
        TextureView view;
        view.wrap_u = texture.wrap_u;
        view.wrap_v = texture.wrap_v;
        view.mag_filter = texture.mag_filter;
        view.min_filter = texture.min_filter;
        view.mip_filter = texture.mip_filter;
        const ImageRgba8* pixels = texture.image.valid() ? scene.images[texture.image.value].pixels.get() : nullptr;
        if (pixels != nullptr && !pixels->empty()) {
            const ImageRgba8& image = *pixels;
            view.pixels = image.data();
            view.width = image.width();
            view.height = image.height();
            const auto& smaller = scene.images[texture.image.value].smaller;
            if (smaller && texture.mip_filter != MipFilter::none) view.smaller = *smaller;
        }
        views.push_back(view);
    }
    return views;
}

Vec4 lookup_linear(const TextureView& texture, const Vec2& uv) noexcept {
    if (texture.pixels == nullptr) return Vec4(1);
    return lookup(texture, whole(texture), uv, [](const Rgba8& p) { return Vec4(p) * (1.0f / 255.0f); });
}

Vec4 lookup_srgb(const TextureView& texture, const Vec2& uv, const TextureFootprint& footprint) noexcept {
    if (texture.pixels == nullptr) return Vec4(1);
    return lookup(texture, choose_level(texture, footprint), uv, [](const Rgba8& p) {
        return Vec4(linear_from_srgb_byte[p.r], linear_from_srgb_byte[p.g], linear_from_srgb_byte[p.b],
                    static_cast<float>(p.a) * (1.0f / 255.0f));
    });
}

float lookup_alpha(const TextureView& texture, const Vec2& uv) noexcept {
    if (texture.pixels == nullptr) return 1.0f;
    return lookup(texture, whole(texture), uv,
                  [](const Rgba8& p) { return static_cast<float>(p.a) * (1.0f / 255.0f); });
}

}  // namespace candela
