// SPDX-License-Identifier: MIT
#include <fstream>

#include "renderer/image/atomic_file.h"
#include "renderer/image/codec.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

class Codec : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() /
                  ("candela_codec_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path folder_;
};

ImageRgba32f gradient(int width, int height) {
    ImageRgba32f image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            image(x, y) = Vec4(static_cast<float>(x) * 0.25f, static_cast<float>(y) * 3.0f, 1e-3f, 0.5f);
    }
    return image;
}

TEST_F(Codec, ExrRoundTripIsExact) {
    const ImageRgba32f image = gradient(13, 7);
    write_exr(folder_ / "a.exr", image, true, {{"command", "test"}});
    const ImageRgba32f back = read_linear(folder_ / "a.exr");
    ASSERT_EQ(back.width(), 13);
    EXPECT_EQ(back.pixels(), image.pixels());
}

TEST_F(Codec, HdrRoundTripKeepsEightBits) {
    for (const int width : {5, 200}) {
        const ImageRgba32f image = gradient(width, 6);
        write_hdr(folder_ / "a.hdr", image);
        const ImageRgba32f back = read_linear(folder_ / "a.hdr");
        for (size_t i = 0; i < image.size(); ++i) {
            const Vec3 a(image.pixels()[i]), b(back.pixels()[i]);
            ASSERT_LE(max_component(glm::abs(a - b)), max_component(a) / 128.0f);
        }
    }
}

TEST_F(Codec, PngRoundTripIsExact) {
    ImageRgba8 image(9, 4);
    for (size_t i = 0; i < image.size(); ++i)
        image.pixels()[i] = Rgba8(i * 7, 255 - i, i * i, 255 - 3 * i);
    write_png(folder_ / "a.png", image, true, {{"command", "test"}});
    EXPECT_EQ(decode_ldr(read_file(folder_ / "a.png")).pixels(), image.pixels());
}

TEST_F(Codec, TruncatedFilesEndInAnErrorAtEveryLength) {
    write_exr(folder_ / "a.exr", gradient(16, 16), false, {});
    write_hdr(folder_ / "a.hdr", gradient(16, 16));
    write_png(folder_ / "a.png", ImageRgba8(16, 16, Rgba8(9)), true);
    for (const char* name : {"a.exr", "a.hdr", "a.png"}) {
        const std::vector<std::byte> whole = read_file(folder_ / name);
        for (size_t length = 0; length + 16 < whole.size(); length += 1 + whole.size() / 200) {
            write_file_atomically(folder_ / "cut", std::span(whole).first(length));
            EXPECT_THROW(read_any_as_linear(folder_ / "cut"), ImageError) << name << " cut to " << length;
        }
    }
}

TEST_F(Codec, LimitsAreKept) {
    write_png(folder_ / "a.png", ImageRgba8(64, 64), true);
    EXPECT_THROW(decode_ldr(read_file(folder_ / "a.png"), {32, 1u << 20}), ImageError);
    EXPECT_THROW(decode_ldr(read_file(folder_ / "a.png"), {4096, 100}), ImageError);
}

TEST_F(Codec, FailedWritesLeaveTheOldFile) {
    std::ofstream(folder_ / "a.png") << "old";
    EXPECT_THROW(write_png(folder_ / "missing" / "a.png", ImageRgba8(2, 2), true), ImageError);
    EXPECT_THROW(write_file_atomically("/dev/full/x", "text"), ImageError);
    EXPECT_EQ(read_file(folder_ / "a.png").size(), 3u);
    size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_))
        ++files;
    EXPECT_EQ(files, 1u);
}

TEST_F(Codec, JpegAndWebpOfTheSharedDataDecode) {
    const auto folder = test::shared_data();
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: no shared data";
    EXPECT_GT(decode_ldr(read_file(folder / "reference/FlightHelmet/blender-cycles.webp")).width(), 100);
    EXPECT_GT(decode_ldr(read_file(folder / "models/AlphaBlendModeTest/glTF/MatBed_baseColor.jpg")).width(), 100);
    EXPECT_THROW(decode_ldr(read_file(folder / "invalid/validator/base/image/invalid_image_data.jpg")), ImageError);
}

}  // namespace
}  // namespace candela
