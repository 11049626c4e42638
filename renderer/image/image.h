// SPDX-License-Identifier: MIT
// A two-dimensional array of pixels, rows from the top, tightly packed.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/math/math.h"

namespace candela {

template <typename T>
class Image {
  public:
    Image() = default;
    Image(int width, int height, T fill = T{})
        : width_(width), height_(height), pixels_(static_cast<size_t>(width) * static_cast<size_t>(height), fill) {}

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
    std::vector<T>& pixels() { return pixels_; }
    const std::vector<T>& pixels() const { return pixels_; }

  private:
    int width_ = 0;
    int height_ = 0;
    std::vector<T> pixels_;
};

using Rgba8 = glm::u8vec4;
using Rgba16 = glm::u16vec4;

using ImageRgba8 = Image<Rgba8>;
using ImageRgb32f = Image<Vec3>;
using ImageRgba32f = Image<Vec4>;

}  // namespace candela
