// SPDX-License-Identifier: MIT
// Modes and filters of EXT_ and KHR_meshopt_compression, against encoders: the library's, and one of version 1 made
// here from the extension's text.
#include "renderer/io/meshopt.h"

#include <meshoptimizer.h>

#include <bit>
#include <cstring>
#include <random>
#include <stdexcept>

#include "renderer/math/math.h"
#include "tests/io/document.h"

namespace candela {
namespace {

using Bytes = std::vector<std::byte>;

std::span<const std::byte> bytes_of(const std::vector<unsigned char>& data) {
    return {reinterpret_cast<const std::byte*>(data.data()), data.size()};
}

template <typename T>
std::vector<T> decode_as(const std::vector<unsigned char>& encoded, size_t count, size_t stride, MeshoptMode mode,
                         MeshoptFilter filter = MeshoptFilter::none) {
    const RawBytes decoded = decode_meshopt({bytes_of(encoded), count, stride, mode, filter});
    std::vector<T> out(decoded.size() / sizeof(T));
    std::memcpy(out.data(), decoded.data(), decoded.size());
    return out;
}

std::vector<unsigned char> encode_v0(const void* elements, size_t count, size_t stride) {
    std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(count, stride));
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), elements, count, stride));
    return out;
}

// Version 1 of ATTRIBUTES. control gives the mode of each byte: 0 and 1 pack each group into the fewest of their bits,
// 2 needs differences of zero, 3 is literal.
class EncoderV1 {
  public:
    EncoderV1(size_t stride, std::vector<unsigned char> channels, std::vector<int> control)
        : stride_(stride), channels_(std::move(channels)), control_(std::move(control)) {}

    std::vector<unsigned char> encode(const std::vector<unsigned char>& elements) {
        out_ = {0xa1};
        const size_t count = elements.size() / stride_;
        std::vector<unsigned char> last(elements.begin(), elements.begin() + static_cast<long>(stride_));
        const std::vector<unsigned char> baseline = last;
        const size_t block = std::min<size_t>((8192 / stride_) & ~size_t{15}, 256);
        for (size_t at = 0; at < count; at += block)
            encode_block(elements.data() + at * stride_, std::min(block, count - at), last);
        const size_t tail = stride_ + channels_.size();
        if (tail < 24) out_.insert(out_.end(), 24 - tail, 0);
        out_.insert(out_.end(), baseline.begin(), baseline.end());
        out_.insert(out_.end(), channels_.begin(), channels_.end());
        return out_;
    }

  private:
    static uint32_t zigzag(uint32_t delta, int bits) {
        const uint32_t mask = bits == 16 ? 0xffffu : 0xffu;
        delta &= mask;
        const bool negative = (delta >> (bits - 1)) != 0;
        return (negative ? ~(delta << 1) : delta << 1) & mask;
    }

    void encode_block(const unsigned char* elements, size_t count, std::vector<unsigned char>& last) {
        std::vector<std::vector<unsigned char>> deltas(stride_, std::vector<unsigned char>((count + 15) / 16 * 16, 0));
        for (size_t i = 0; i < count; ++i) {
            const unsigned char* element = elements + i * stride_;
            for (size_t k = 0; k < stride_; k += 4) {
                uint32_t now = 0, before = 0, delta = 0;
                std::memcpy(&now, element + k, 4);
                std::memcpy(&before, last.data() + k, 4);
                const int mode = channels_[k / 4] & 15;
                if (mode == 2) {
                    delta = std::rotl(now ^ before, channels_[k / 4] >> 4);
                } else {
                    const int bits = mode == 1 ? 16 : 8;
                    for (int shift = 0; shift < 32; shift += bits)
                        delta |= zigzag((now >> shift) - (before >> shift), bits) << shift;
                }
                for (size_t j = 0; j < 4; ++j)
                    deltas[k + j][i] = static_cast<unsigned char>(delta >> (8 * j));
            }
            std::memcpy(last.data(), element, stride_);
        }
        for (size_t k = 0; k < stride_; k += 4) {
            out_.push_back(static_cast<unsigned char>(control_[k] | control_[k + 1] << 2 | control_[k + 2] << 4 |
                                                      control_[k + 3] << 6));
        }
        for (size_t k = 0; k < stride_; ++k)
            encode_bytes(deltas[k], count, control_[k]);
    }

    void encode_bytes(const std::vector<unsigned char>& deltas, size_t count, int control) {
        if (control == 2) return;
        if (control == 3) {
            out_.insert(out_.end(), deltas.begin(), deltas.begin() + static_cast<long>(count));
            return;
        }
        const size_t groups = deltas.size() / 16;
        const size_t header = out_.size();
        out_.resize(header + (groups + 3) / 4, 0);
        for (size_t g = 0; g < groups; ++g) {
            const unsigned char* group = deltas.data() + 16 * g;
            const std::vector<int> widths = control == 0 ? std::vector<int>{0, 1, 2, 4} : std::vector<int>{1, 2, 4, 8};
            size_t best = 4, best_size = 1000;
            for (size_t w = 0; w < 4; ++w) {
                const size_t size = packed_size(group, widths[w]);
                if (size < best_size) std::tie(best, best_size) = std::pair(w, size);
            }
            out_[header + g / 4] = static_cast<unsigned char>(out_[header + g / 4] | best << (2 * (g % 4)));
            pack(group, widths[best]);
        }
    }

    static size_t packed_size(const unsigned char* group, int bits) {
        if (bits == 8) return 16;
        size_t size = static_cast<size_t>(2 * bits);
        for (int i = 0; i < 16; ++i) {
            if (bits == 0 && group[i] != 0) return 999;
            if (bits > 0 && group[i] >= (1 << bits) - 1) ++size;
        }
        return size;
    }

    void pack(const unsigned char* group, int bits) {
        if (bits == 0) return;
        if (bits == 8) {
            out_.insert(out_.end(), group, group + 16);
            return;
        }
        const int sentinel = (1 << bits) - 1, per_byte = 8 / bits;
        for (int i = 0; i < 16; i += per_byte) {
            int byte = 0;
            for (int j = 0; j < per_byte; ++j) {
                const int value = std::min<int>(group[i + j], sentinel);
                byte |= value << (bits == 1 ? j : 8 - bits * (j + 1));
            }
            out_.push_back(static_cast<unsigned char>(byte));
        }
        for (int i = 0; i < 16; ++i) {
            if (group[i] >= sentinel) out_.push_back(group[i]);
        }
    }

    size_t stride_;
    std::vector<unsigned char> channels_;
    std::vector<int> control_;
    std::vector<unsigned char> out_;
};

// Elements that move in steps of many sizes, so that every width of bits occurs.
std::vector<unsigned char> walk(size_t count, size_t stride) {
    std::mt19937 random(7);
    std::vector<unsigned char> out(count * stride);
    for (size_t k = 0; k < stride; ++k) {
        unsigned value = 0;
        for (size_t i = 0; i < count; ++i) {
            const auto step_bits = static_cast<unsigned>(i / 16 % 9);
            value += static_cast<unsigned>(random()) & ((1u << step_bits) - 1);
            out[i * stride + k] = static_cast<unsigned char>(value);
        }
    }
    return out;
}

TEST(Meshopt, AttributesOfVersion0) {
    const std::vector<unsigned char> elements = walk(1000, 12);
    EXPECT_EQ(decode_as<unsigned char>(encode_v0(elements.data(), 1000, 12), 1000, 12, MeshoptMode::attributes),
              elements);
}

TEST(Meshopt, AttributesOfVersion1InEveryControlAndChannelMode) {
    for (const size_t count : {1u, 15u, 16u, 256u, 700u}) {
        for (const int channel : {0, 1, 2, 2 | 5 << 4}) {
            for (const int control : {0, 1, 3}) {
                const std::vector<unsigned char> elements = walk(count, 16);
                EncoderV1 encoder(16, std::vector<unsigned char>(4, static_cast<unsigned char>(channel)),
                                  std::vector<int>(16, control));
                EXPECT_EQ(decode_as<unsigned char>(encoder.encode(elements), count, 16, MeshoptMode::attributes),
                          elements)
                    << count << " elements, channel mode " << channel << ", control mode " << control;
            }
        }
    }
    // Nothing is stored for bytes that never change. Elements of 40 bytes come in blocks of 192.
    std::vector<unsigned char> elements = walk(500, 40);
    for (size_t i = 0; i < 500; ++i)
        elements[i * 40 + 7] = 99;
    std::vector<int> control(40, 1);
    control[7] = 2;
    control[20] = 3;
    control[21] = 0;
    EncoderV1 encoder(40, {0, 0, 2, 0, 0, 2 | 8 << 4, 1, 0, 0, 0}, control);
    EXPECT_EQ(decode_as<unsigned char>(encoder.encode(elements), 500, 40, MeshoptMode::attributes), elements);
}

// The example of the extension's text: 16 differences in 4 bits.
TEST(Meshopt, TheExampleOfTheSpecification) {
    std::vector<unsigned char> stream = {0xa1, 0b10'10'10'00, 0x03};
    for (const int byte : {0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5})
        stream.push_back(static_cast<unsigned char>(byte));
    stream.insert(stream.end(), 24, 0);
    const auto decoded = decode_as<unsigned char>(stream, 16, 4, MeshoptMode::attributes);
    const int deltas[] = {-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0};
    int value = 0;
    for (size_t i = 0; i < 16; ++i) {
        value += deltas[i];
        EXPECT_EQ(decoded[4 * i], static_cast<unsigned char>(value)) << i;
        EXPECT_EQ(decoded[4 * i + 1], 0);
    }
}

TEST(Meshopt, DamagedStreamsOfVersion1AreRefused) {
    const std::vector<unsigned char> elements = walk(100, 8);
    EncoderV1 encoder(8, {0, 1}, {0, 1, 3, 0, 1, 0, 3, 1});
    const std::vector<unsigned char> good = encoder.encode(elements);
    const auto decodes = [](const std::vector<unsigned char>& stream, size_t count) {
        try {
            decode_meshopt({bytes_of(stream), count, 8, MeshoptMode::attributes, MeshoptFilter::none});
            return true;
        } catch (const std::runtime_error&) {
            return false;
        }
    };
    EXPECT_TRUE(decodes(good, 100));
    EXPECT_FALSE(decodes(good, 90)) << "bytes are left over";
    EXPECT_FALSE(decodes(good, 120));
    for (size_t length = 0; length < good.size(); ++length)
        EXPECT_FALSE(decodes({good.begin(), good.begin() + static_cast<long>(length)}, 100)) << length;
    std::vector<unsigned char> longer = good;
    longer.insert(longer.begin() + 1, 0);
    EXPECT_FALSE(decodes(longer, 100));
    for (const int mode : {3, 4, 0x10, 0x11}) {
        std::vector<unsigned char> bad = good;
        bad.back() = static_cast<unsigned char>(mode);
        EXPECT_FALSE(decodes(bad, 100)) << "channel mode " << mode;
    }
}

TEST(Meshopt, TrianglesAndIndicesOfBothWidths) {
    std::vector<unsigned int> indices;
    for (unsigned int i = 0; i < 200; ++i)
        indices.insert(indices.end(), {i, i + 1, i + 2});
    std::vector<unsigned char> triangles(meshopt_encodeIndexBufferBound(indices.size(), 202));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), indices.size()));
    const auto decoded = decode_as<unsigned int>(triangles, indices.size(), 4, MeshoptMode::triangles);
    for (size_t t = 0; t < indices.size(); t += 3) {
        // A triangle may begin at another corner.
        const auto first =
            std::find(decoded.begin() + static_cast<long>(t), decoded.begin() + static_cast<long>(t) + 3, indices[t]) -
            decoded.begin() - static_cast<long>(t);
        ASSERT_LT(first, 3);
        for (long c = 0; c < 3; ++c)
            EXPECT_EQ(decoded[t + static_cast<size_t>((first + c) % 3)], indices[t + static_cast<size_t>(c)]);
    }
    std::vector<unsigned char> sequence(meshopt_encodeIndexSequenceBound(indices.size(), 202));
    sequence.resize(meshopt_encodeIndexSequence(sequence.data(), sequence.size(), indices.data(), indices.size()));
    EXPECT_EQ(decode_as<unsigned int>(sequence, indices.size(), 4, MeshoptMode::indices), indices);
    const auto narrow = decode_as<uint16_t>(sequence, indices.size(), 2, MeshoptMode::indices);
    EXPECT_TRUE(std::equal(narrow.begin(), narrow.end(), indices.begin()));
}

TEST(Meshopt, OctahedralFilterGivesUnitVectors) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    std::vector<Vec4> directions(100);
    for (Vec4& d : directions)
        d = Vec4(glm::normalize(Vec3(normal(random), normal(random), normal(random))), 1.0f);
    for (const size_t stride : {4u, 8u}) {
        std::vector<unsigned char> filtered(100 * stride);
        meshopt_encodeFilterOct(filtered.data(), 100, stride, stride == 4 ? 8 : 12, &directions[0].x);
        const auto encoded = encode_v0(filtered.data(), 100, stride);
        const float largest = stride == 4 ? 127.0f : 32767.0f;
        const auto check = [&](const auto& decoded) {
            for (size_t i = 0; i < 100; ++i) {
                const Vec3 d = Vec3(decoded[4 * i], decoded[4 * i + 1], decoded[4 * i + 2]) / largest;
                EXPECT_NEAR(glm::length(d), 1.0f, stride == 4 ? 0.02f : 1e-3f);
                EXPECT_NEAR(glm::distance(d, Vec3(directions[i])), 0.0f, stride == 4 ? 0.03f : 2e-3f);
            }
        };
        if (stride == 4) {
            check(decode_as<int8_t>(encoded, 100, 4, MeshoptMode::attributes, MeshoptFilter::octahedral));
        } else {
            check(decode_as<int16_t>(encoded, 100, 8, MeshoptMode::attributes, MeshoptFilter::octahedral));
        }
    }
}

TEST(Meshopt, QuaternionFilterGivesRotations) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    std::vector<Vec4> rotations(100);
    for (Vec4& q : rotations)
        q = glm::normalize(Vec4(normal(random), normal(random), normal(random), normal(random)));
    std::vector<unsigned char> filtered(800);
    meshopt_encodeFilterQuat(filtered.data(), 100, 8, 12, &rotations[0].x);
    const auto decoded = decode_as<int16_t>(encode_v0(filtered.data(), 100, 8), 100, 8, MeshoptMode::attributes,
                                            MeshoptFilter::quaternion);
    for (size_t i = 0; i < 100; ++i) {
        const Vec4 q = Vec4(decoded[4 * i], decoded[4 * i + 1], decoded[4 * i + 2], decoded[4 * i + 3]) / 32767.0f;
        // The same rotation with either sign.
        EXPECT_NEAR(std::abs(glm::dot(q, rotations[i])), 1.0f, 1e-4f);
    }
}

TEST(Meshopt, ExponentialFilterGivesFloats) {
    // Mantissa and exponent by hand: 3 · 2^-1, -5 · 2^4, 0.
    const std::vector<uint32_t> elements = {0xff000003u, 0x04fffffbu, 0};
    const auto decoded =
        decode_as<float>(encode_v0(elements.data(), 3, 4), 3, 4, MeshoptMode::attributes, MeshoptFilter::exponential);
    EXPECT_EQ(decoded, (std::vector<float>{1.5f, -80.0f, 0.0f}));
}

TEST(Meshopt, ColorFilterGivesRgba) {
    // K = 8 bits: Y, Co, Cg, and seven bits of alpha below a one.
    const std::vector<unsigned char> narrow = {100, 20, 0xf6, 0x80 | 0x7f, 255, 0, 0, 0x80};
    EXPECT_EQ(
        decode_as<unsigned char>(encode_v0(narrow.data(), 2, 4), 2, 4, MeshoptMode::attributes, MeshoptFilter::color),
        (std::vector<unsigned char>{130, 90, 90, 255, 255, 255, 255, 0}));
    // K = 5 bits in 16: the largest value is 31.
    const std::vector<uint16_t> wide = {31, 0, 0, 0x10 | 0x0f, 15, 1, 0xffff, 0x10};
    const auto decoded =
        decode_as<uint16_t>(encode_v0(wide.data(), 2, 8), 2, 8, MeshoptMode::attributes, MeshoptFilter::color);
    const auto scaled = [](int value) {
        return static_cast<uint16_t>(std::lround(65535.0f / 31.0f * static_cast<float>(value)));
    };
    EXPECT_EQ(decoded, (std::vector<uint16_t>{65535, 65535, 65535, 65535, scaled(17), scaled(14), scaled(15), 0}));
    // Whatever the bytes are, what comes out is a colour.
    const std::vector<unsigned char> garbage = {255, 127, 128, 0, 0, 128, 127, 1};
    EXPECT_EQ(
        decode_as<unsigned char>(encode_v0(garbage.data(), 2, 4), 2, 4, MeshoptMode::attributes, MeshoptFilter::color)
            .size(),
        8u);
}

class MeshoptFiles : public test::GltfTest {};

TEST_F(MeshoptFiles, TheKhronosNameHasVersion1AndColours) {
    const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::vector<unsigned char> raw(sizeof(float) * positions.size());
    std::memcpy(raw.data(), positions.data(), raw.size());
    EncoderV1 encoder(12, {2, 2, 2}, std::vector<int>(12, 1));
    const std::vector<unsigned char> encoded = encoder.encode(raw);
    const std::vector<unsigned char> colors = {100, 20, 0xf6, 0xff, 255, 0, 0, 0x80, 255, 0, 0, 0x80};
    const std::vector<unsigned char> encoded_colors = encode_v0(colors.data(), 3, 4);
    for (const char* name : {"KHR_meshopt_compression", "EXT_meshopt_compression"}) {
        test::Document document;
        document.json["extensionsUsed"] = {name};
        document.json["extensionsRequired"] = {name};
        const int source = document.add_view(encoded.data(), encoded.size());
        const int color_source = document.add_view(encoded_colors.data(), encoded_colors.size());
        const auto add = [&](int from, int count, int stride, const char* filter) {
            test::Json compressed = {{"buffer", 0},
                                     {"byteOffset", document.json["bufferViews"][from]["byteOffset"]},
                                     {"byteLength", document.json["bufferViews"][from]["byteLength"]},
                                     {"byteStride", stride},
                                     {"count", count},
                                     {"mode", "ATTRIBUTES"},
                                     {"filter", filter}};
            document.json["bufferViews"].push_back(
                {{"buffer", 1}, {"byteLength", count * stride}, {"extensions", {{name, compressed}}}});
            return static_cast<int>(document.json["bufferViews"].size()) - 1;
        };
        const int position_view = add(source, 3, 12, "NONE");
        const int color_view = add(color_source, 3, 4, "COLOR");
        document.json["accessors"] = {
            {{"bufferView", position_view}, {"componentType", test::f32}, {"count", 3}, {"type", "VEC3"}},
            {{"bufferView", color_view},
             {"componentType", test::u8},
             {"normalized", true},
             {"count", 3},
             {"type", "VEC4"}}};
        document.add_primitive({{"POSITION", 0}, {"COLOR_0", 1}});
        document.finish("data.bin");
        document.json["buffers"].push_back({{"byteLength", 36}, {"extensions", {{name, {{"fallback", true}}}}}});
        write("data.bin", {document.bytes.begin(), document.bytes.end()});
        const auto file = write("scene.gltf", document.json.dump());
        if (std::string(name) == "EXT_meshopt_compression") {
            EXPECT_EQ(
                failure_of([&] { load_file(file); }),
                "/bufferViews/" + std::to_string(color_view) +
                    "/extensions/EXT_meshopt_compression/filter: \"COLOR\" is not a filter of EXT_meshopt_compression");
            continue;
        }
        const Scene scene = load_file(file);
        const Primitive& p = first(scene);
        ASSERT_EQ(p.positions.size(), 3u) << all_warnings();
        EXPECT_EQ(p.positions[1], Vec3(1, 0, 0));
        EXPECT_EQ(p.positions[2], Vec3(0, 1, 0));
        EXPECT_NEAR(p.colors.at(0).x, 130.0f / 255, 1e-6f);
        EXPECT_EQ(scene.extensions.at(0).treatment, ExtensionUse::Treatment::rendered);
    }
}

}  // namespace
}  // namespace candela
