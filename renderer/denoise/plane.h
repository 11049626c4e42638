// SPDX-License-Identifier: MIT
// A picture of single numbers with a margin all around, so that loops over neighbours need no edges.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace candela {

class Plane {
  public:
    Plane(int width, int height, int margin)
        : width_(width),
          height_(height),
          margin_(margin),
          stride_(width + 2 * margin),
          values_(static_cast<size_t>(stride_) * static_cast<size_t>(height + 2 * margin)) {}

    // Rows and columns from -margin to below height + margin.
    float* row(int y) { return values_.data() + static_cast<ptrdiff_t>(y + margin_) * stride_ + margin_; }
    const float* row(int y) const { return values_.data() + static_cast<ptrdiff_t>(y + margin_) * stride_ + margin_; }
    float& operator()(int x, int y) { return row(y)[x]; }
    float operator()(int x, int y) const { return row(y)[x]; }

    // Repeats the edges outwards.
    void extend() {
        for (int y = 0; y < height_; ++y) {
            float* r = row(y);
            std::fill(r - margin_, r, r[0]);
            std::fill(r + width_, r + width_ + margin_, r[width_ - 1]);
        }
        for (int i = 1; i <= margin_; ++i) {
            std::copy_n(row(0) - margin_, stride_, row(-i) - margin_);
            std::copy_n(row(height_ - 1) - margin_, stride_, row(height_ - 1 + i) - margin_);
        }
    }

  private:
    int width_, height_, margin_, stride_;
    std::vector<float> values_;
};

}  // namespace candela
