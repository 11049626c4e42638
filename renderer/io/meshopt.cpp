// SPDX-License-Identifier: MIT
#include "renderer/io/meshopt.h"

#include <meshoptimizer.h>

#include <stdexcept>

#include "renderer/io/meshopt_attributes.h"

namespace candela {
namespace {

void require(bool holds, const char* reason) {
    if (!holds) throw std::runtime_error(reason);
}

// KHR_meshopt_compression, "Specifying compressed views" and "Compression modes and filters".
void check_parameters(const MeshoptView& view) {
    if (view.mode == MeshoptMode::attributes) {
        require(view.stride > 0 && view.stride % 4 == 0 && view.stride <= 256,
                "byteStride of ATTRIBUTES must be a multiple of 4 up to 256");
    } else {
        require(view.stride == 2 || view.stride == 4, "byteStride of TRIANGLES and INDICES must be 2 or 4");
        require(view.filter == MeshoptFilter::none, "TRIANGLES and INDICES take no filter");
        require(view.mode != MeshoptMode::triangles || view.count % 3 == 0,
                "the count of TRIANGLES must be a multiple of 3");
    }
    if (view.filter == MeshoptFilter::octahedral || view.filter == MeshoptFilter::color) {
        require(view.stride == 4 || view.stride == 8, "byteStride of the OCTAHEDRAL and COLOR filters must be 4 or 8");
    } else if (view.filter == MeshoptFilter::quaternion) {
        require(view.stride == 8, "byteStride of the QUATERNION filter must be 8");
    }
}

int decode(const MeshoptView& view, std::span<std::byte> into) {
    std::byte* out = into.data();
    const auto* encoded = reinterpret_cast<const unsigned char*>(view.encoded.data());
    switch (view.mode) {
        case MeshoptMode::attributes:
            if (is_attributes_v1(view.encoded)) {
                return decode_attributes_v1(view.encoded, view.count, view.stride, into) ? 0 : -1;
            }
            return meshopt_decodeVertexBuffer(out, view.count, view.stride, encoded, view.encoded.size());
        case MeshoptMode::triangles:
            return meshopt_decodeIndexBuffer(out, view.count, view.stride, encoded, view.encoded.size());
        case MeshoptMode::indices:
            return meshopt_decodeIndexSequence(out, view.count, view.stride, encoded, view.encoded.size());
    }
    return -1;
}

}  // namespace

RawBytes decode_meshopt(const MeshoptView& view) {
    check_parameters(view);
    RawBytes out(view.count * view.stride);
    if (view.count == 0) return out;
    require(decode(view, out) == 0, "the compressed data is damaged");
    switch (view.filter) {
        case MeshoptFilter::none:
            break;
        case MeshoptFilter::octahedral:
            meshopt_decodeFilterOct(out.data(), view.count, view.stride);
            break;
        case MeshoptFilter::quaternion:
            meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
            break;
        case MeshoptFilter::exponential:
            meshopt_decodeFilterExp(out.data(), view.count, view.stride);
            break;
        case MeshoptFilter::color:
            decode_color_filter(out, view.stride);
            break;
    }
    return out;
}

}  // namespace candela
