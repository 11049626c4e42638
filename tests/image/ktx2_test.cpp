// SPDX-License-Identifier: MIT
// KTX2 files: the rules of KHR_texture_basisu, damage of every kind, and the texels of a reference decoder.
#include <zstd.h>

#include <random>

#include "renderer/image/atomic_file.h"
#include "renderer/image/codec.h"
#include "tests/support/ktx2_writer.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using test::Bytes;
using test::Ktx2Parts;

Ktx2Parts solid_parts() {
    Ktx2Parts parts;
    parts.levels = {test::solid_uastc_block(10, 200, 30, 128)};
    return parts;
}

// "decoded", or why not; one clear line.
std::string outcome(std::span<const std::byte> bytes, const DecodeLimits& limits = {4096, 1u << 20}) {
    try {
        decode_ldr(bytes, limits);
    } catch (const ImageError& error) {
        const std::string line = error.what();
        EXPECT_FALSE(line.empty());
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        return line;
    }
    return "decoded";
}

void expect_refused(const Ktx2Parts& parts, const std::string& reason) {
    EXPECT_NE(outcome(write_ktx2(parts)).find(reason), std::string::npos)
        << "wanted: " << reason << "\ngot: " << outcome(write_ktx2(parts));
}

uint64_t fnv1a(const ImageRgba8& image) {
    uint64_t hash = 0xcbf29ce484222325;
    for (const Rgba8& texel : image.pixels()) {
        for (int c = 0; c < 4; ++c)
            hash = (hash ^ texel[c]) * 0x100000001b3;
    }
    return hash;
}

const std::filesystem::path own_files = "tests/image/data";

TEST(Ktx2, UastcUncompressed) {
    const ImageRgba8 image = decode_ldr(write_ktx2(solid_parts()));
    ASSERT_EQ(image.size(), 16u);
    for (const Rgba8& texel : image.pixels())
        EXPECT_EQ(texel, Rgba8(10, 200, 30, 128));
}

TEST(Ktx2, BlocksLieInRasterOrderAndEndWithThePicture) {
    Ktx2Parts parts;
    parts.width = 6;
    parts.height = 7;
    parts.levels = {{}};
    for (uint32_t block = 0; block < 4; ++block) {
        const Bytes solid = test::solid_uastc_block(block, 0, 0, 255);
        parts.levels[0].insert(parts.levels[0].end(), solid.begin(), solid.end());
    }
    const ImageRgba8 image = decode_ldr(write_ktx2(parts));
    ASSERT_EQ(image.width(), 6);
    ASSERT_EQ(image.height(), 7);
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 6; ++x)
            EXPECT_EQ(image(x, y).r, x / 4 + 2 * (y / 4));
    }
}

// Without an alpha channel in the descriptor there is none, whatever the blocks hold.
TEST(Ktx2, ChannelsAreTheDescriptors) {
    Ktx2Parts parts = solid_parts();
    for (const int rgb_red_or_red_green : {0, 4, 6}) {
        parts.channels = {rgb_red_or_red_green};
        EXPECT_EQ(decode_ldr(write_ktx2(parts))(0, 0), Rgba8(10, 200, 30, 255));
    }
    parts.channels = {5};
    expect_refused(parts, "channels of another kind");
    parts.channels = {0, 15};
    expect_refused(parts, "channels of another kind");
}

TEST(Ktx2, RulesOfTheExtension) {
    using Change = void (*)(Ktx2Parts&);
    const std::pair<Change, const char*> cases[] = {
        {[](Ktx2Parts& p) { p.vk_format = 37; }, "Vulkan format 37"},
        {[](Ktx2Parts& p) { p.height = 0; }, "one-dimensional"},
        {[](Ktx2Parts& p) { p.depth = 4; }, "three-dimensional"},
        {[](Ktx2Parts& p) { p.faces = 6; }, "cube map"},
        {[](Ktx2Parts& p) { p.faces = 2; }, "2 faces"},
        {[](Ktx2Parts& p) { p.layers = 3; }, "array of 3"},
        {[](Ktx2Parts& p) { p.supercompression = 3; }, "supercompression scheme 3"},
        {[](Ktx2Parts& p) { p.supercompression = 1; }, "UASTC under BasisLZ"},
        {[](Ktx2Parts& p) { p.model = test::model_etc1s; }, "ETC1S without BasisLZ"},
        {[](Ktx2Parts& p) { p.model = 162; }, "colour model 162"},
        {[](Ktx2Parts& p) { p.transfer = 5; }, "transfer function 5"},
        {[](Ktx2Parts& p) { p.flags = 1; }, "premultiplied"},
        {[](Ktx2Parts& p) {
             p.texts = {{"KTXorientation", "ru"}};
         },
         "not oriented right and down"},
        {[](Ktx2Parts& p) {
             p.texts = {{"KTXwriter", "x"}, {"KTXswizzle", "bgra"}};
         },
         "swizzled"},
        {[](Ktx2Parts& p) { p.width = 5000; }, "5000x4 pixels; the limit is 4096"},
        {[](Ktx2Parts& p) { p.width = p.height = 2048; }, "1048576 in all"},
        {[](Ktx2Parts& p) { p.width = 0; }, "no pixels"},
        {[](Ktx2Parts& p) { p.width = 8; }, "another size than its picture"},
        {[](Ktx2Parts& p) { p.width = 8, p.uncompressed = {32}; }, "fewer than its size needs"},
        {[](Ktx2Parts& p) { p.levels.resize(4); }, "4 mip levels, more than its size allows"},
        {[](Ktx2Parts& p) { p.supercompression = 2; }, "Zstandard"},
    };
    for (const auto& [change, reason] : cases) {
        Ktx2Parts parts = solid_parts();
        change(parts);
        expect_refused(parts, reason);
    }
    Ktx2Parts lawful = solid_parts();
    lawful.layers = 1;
    lawful.texts = {{"KTXswizzle", "rgba"}, {"KTXorientation", "rd"}, {"KTXwriter", "anyone"}};
    EXPECT_EQ(outcome(write_ktx2(lawful)), "decoded");
    lawful.texts.clear();
    EXPECT_EQ(outcome(write_ktx2(lawful)), "decoded");
}

TEST(Ktx2, ZstandardMustFillThePicture) {
    Ktx2Parts parts = solid_parts();
    parts.supercompression = 2;
    parts.width = 8;
    parts.uncompressed = {32};
    const Bytes block = parts.levels[0];
    const auto compress = [&](size_t blocks) {
        Bytes plain;
        for (size_t i = 0; i < blocks; ++i)
            plain.insert(plain.end(), block.begin(), block.end());
        Bytes out(ZSTD_compressBound(plain.size()));
        out.resize(ZSTD_compress(out.data(), out.size(), plain.data(), plain.size(), 1));
        return out;
    };
    parts.levels[0] = compress(2);
    EXPECT_EQ(outcome(write_ktx2(parts)), "decoded");
    parts.levels[0] = compress(1);
    expect_refused(parts, "fewer than its size needs");
    parts.levels[0] = compress(3);
    expect_refused(parts, "Zstandard");
}

// Harmless, and said.
TEST(Ktx2, Oddities) {
    Ktx2Parts parts = solid_parts();
    EXPECT_TRUE(basisu_oddities(write_ktx2(parts), true, false).empty());
    ASSERT_EQ(basisu_oddities(write_ktx2(parts), false, true).size(), 1u);
    EXPECT_NE(basisu_oddities(write_ktx2(parts), false, true)[0].find("sRGB but is used as data"), std::string::npos);
    parts.transfer = 1;
    EXPECT_TRUE(basisu_oddities(write_ktx2(parts), false, true).empty());
    ASSERT_EQ(basisu_oddities(write_ktx2(parts), true, false).size(), 1u);
    EXPECT_NE(basisu_oddities(write_ktx2(parts), true, false)[0].find("linear but is used as sRGB"), std::string::npos);
    EXPECT_TRUE(basisu_oddities(write_ktx2(parts), true, true).empty());
    parts.transfer = 0;
    EXPECT_TRUE(basisu_oddities(write_ktx2(parts), true, false).empty());
    parts.width = 3;
    ASSERT_EQ(basisu_oddities(write_ktx2(parts), true, false).size(), 1u);
    EXPECT_NE(basisu_oddities(write_ktx2(parts), true, false)[0].find("3x4"), std::string::npos);
    EXPECT_TRUE(basisu_oddities({}, true, false).empty());
}

// Hashes of what the transcoder of three.js 0.187 (Basis Universal, to RGBA32) makes of the same files. The own files:
// uastc_all_modes, 76 blocks of random bits, four of each mode, under a hand-made header; the others, a picture of
// sines and checks of 32 × 24 pixels with alpha by basisu 1.16.4 with -ktx2 -uastc -uastc_level 3, and -ktx2 -mipmap
// -q 200.
TEST(Ktx2, TexelsAreTheReferenceDecoders) {
    const std::pair<const char*, uint64_t> own[] = {
        {"uastc_all_modes.ktx2", 0x5357cb6e4464ec78},
        {"uastc_zstd.ktx2", 0x9f028e2c62ec707f},
        {"etc1s_alpha_mips.ktx2", 0x1ef7e7f23edfef5e},
    };
    for (const auto& [name, hash] : own)
        EXPECT_EQ(fnv1a(decode_ldr(read_file(own_files / name))), hash) << name;
}

TEST(Ktx2, TexelsOfTheSharedLampAreTheReferenceDecoders) {
    const auto folder = test::shared_data() / "models/AnisotropyBarnLamp/glTF-KTX2-Basisu";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: no shared data";
    const std::pair<const char*, uint64_t> textures[] = {
        {"anisotropy", 0x128ada035ce7ff59},
        {"basecolor", 0x8b89d18f3d26a53e},
        {"normalbump", 0x1d4a3ab5bf093e8b},
        {"occlusionroughnessmetal", 0xb2e5effb5b726bb1},
    };
    for (const auto& [name, hash] : textures) {
        const Bytes bytes = read_file(folder / ("AnisotropyBarnLamp_" + std::string(name) + ".ktx2"));
        EXPECT_EQ(fnv1a(decode_ldr(bytes)), hash) << name;
    }
}

class DamagedKtx2 : public ::testing::TestWithParam<const char*> {
  protected:
    Bytes bytes_ = read_file(own_files / GetParam());
};

TEST_P(DamagedKtx2, CutAnywhere) {
    for (size_t length = 0; length < bytes_.size(); length += 16) {
        const Bytes cut(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_NE(outcome(cut), "decoded") << length << " bytes";
    }
}

TEST_P(DamagedKtx2, AnyBitFlipped) {
    size_t refused = 0;
    for (size_t at = 0; at < bytes_.size(); ++at) {
        for (int bit = 0; bit < 8; ++bit) {
            Bytes flipped = bytes_;
            flipped[at] ^= static_cast<std::byte>(1 << bit);
            refused += outcome(flipped) == "decoded" ? 0 : 1;
        }
    }
    EXPECT_GT(refused, 100u);
}

TEST_P(DamagedKtx2, ManyBytesReplaced) {
    std::mt19937 random(17);
    for (int trial = 0; trial < 2000; ++trial) {
        Bytes damaged = bytes_;
        for (int k = 0; k < 12; ++k)
            damaged[12 + random() % (damaged.size() - 12)] = static_cast<std::byte>(random() % 4 == 0 ? 255 : random());
        outcome(damaged);
    }
}

INSTANTIATE_TEST_SUITE_P(Files, DamagedKtx2,
                         ::testing::Values("uastc_all_modes.ktx2", "uastc_zstd.ktx2", "etc1s_alpha_mips.ktx2"),
                         [](const auto& file) {
                             const std::string name = file.param;
                             return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace candela
