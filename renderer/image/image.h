// SPDX-License-Identifier: MIT
// A two-dimensional array of pixels, rows from the top, tightly packed.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "renderer/math/math.h"

namespace candela {

// Leaves new elements as they are, where no value is given for them.
template <typename T>
struct UnfilledAllocator : std::allocator<T> {
    template <typename U>
    void construct(U* at) noexcept {
        ::new (static_cast<void*>(at)) U;
    }
};

template <typename T>
class Image {
  public:
    using Pixels = std::vector<T, UnfilledAllocator<T>>;

    Image() = default;
    // For those who write every pixel.
    static Image unfilled(int width, int height) {
        Image out;
        out.width_ = width;
        out.height_ = height;
        out.pixels_ = Pixels(static_cast<size_t>(width) * static_cast<size_t>(height));
        return out;
    }
    Image(int width, int height, T fill = T{})
        : width_(width), height_(height), pixels_(static_cast<size_t>(width) * static_cast<size_t>(height), fill) {}

    // Leaves out those below; their memory is kept.
    void keep_rows(int height) {
        height_ = height;
        pixels_.resize(static_cast<size_t>(width_) * static_cast<size_t>(height));
    }

    int width() const { return width_; }
    int height() const { return height_; }
    bool empty() const { return pixels_.empty(); }
    size_t size() const { return pixels_.size(); }

    T& operator()(int x, int y) {
        return pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
    }
    const T& operator()(int x, int y) const {
        return pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
    }
    T* data() { return pixels_.data(); }
    const T* data() const { return pixels_.data(); }
    Pixels& pixels() { return pixels_; }
    const Pixels& pixels() const { return pixels_; }

  private:
    int width_ = 0;
    int height_ = 0;
    Pixels pixels_;
};

using Rgba8 = glm::u8vec4;
using Rgba16 = glm::u16vec4;

using ImageRgba8 = Image<Rgba8>;
using ImageRgb32f = Image<Vec3>;
using ImageRgba32f = Image<Vec4>;

}  // namespace candela
