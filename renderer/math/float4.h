// SPDX-License-Identifier: MIT
// Four floats that vector units work on at once. Arithmetic and comparisons are the compiler's own, lane by lane; a
// comparison gives a mask for select(). Every operation rounds as it does for one float.
#pragma once

#include <cmath>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace candela {

using Float4 [[gnu::vector_size(16)]] = float;
using Mask4 [[gnu::vector_size(16)]] = int;

inline Float4 splat4(float x) {
    return Float4{x, x, x, x};
}

inline Float4 select4(Mask4 mask, Float4 yes, Float4 no) {
    return mask ? yes : no;
}

inline Float4 sqrt4(Float4 x) {
#ifdef __SSE2__
    return _mm_sqrt_ps(x);
#else
    return Float4{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}

// The second where one of them is not a number.
inline Float4 min4(Float4 a, Float4 b) {
    return select4(a < b, a, b);
}

inline Float4 max4(Float4 a, Float4 b) {
    return select4(a > b, a, b);
}

inline Float4 abs4(Float4 x) {
    return select4(x < 0.0f, -x, x);
}

}  // namespace candela
