// SPDX-License-Identifier: MIT
#include <sys/stat.h>

#include <fstream>

#include "renderer/image/atomic_file.h"
#include "renderer/image/codec.h"
#include "renderer/image/exr_header.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

namespace candela {
namespace {

class Codec : public ::testing::Test {
  protected:
    const test::TemporaryFolder own_folder_{"candela_codec"};
    const std::filesystem::path folder_ = own_folder_.path();
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

template <typename Action>
std::string error_of(const Action& action) {
    try {
        action();
    } catch (const ImageError& error) {
        return error.what();
    }
    return "no error";
}

std::string bytes_of_u32(size_t value) {
    std::string out(4, '\0');
    for (int i = 0; i < 4; ++i)
        out[static_cast<size_t>(i)] = static_cast<char>(value >> (8 * i));
    return out;
}

TEST_F(Codec, LimitsSayWhatTheyAreAndWhatRaisesThem) {
    write_png(folder_ / "a.png", ImageRgba8(64, 32), true);
    write_exr(folder_ / "a.exr", gradient(64, 32), false, {});
    write_hdr(folder_ / "a.hdr", gradient(64, 32));
    const auto error_with = [&](const char* name, const DecodeLimits& limits) {
        return error_of([&] { read_any_as_linear(folder_ / name, limits); });
    };
    for (const char* name : {"a.png", "a.exr", "a.hdr"}) {
        EXPECT_EQ(error_with(name, {64, 2048}), "no error");
        EXPECT_EQ(error_with(name, {63, 2048}),
                  "the picture has 64x32 pixels; the limit is 63 a side and 2048 in all; --limit-image raises it");
        EXPECT_EQ(error_with(name, {64, 2047}),
                  "the picture has 64x32 pixels; the limit is 64 a side and 2047 in all; --limit-image raises it");
        const uint64_t needed = std::string(name) == "a.png" ? 64 * 32 * 4 : 64 * 32 * 16;
        EXPECT_EQ(error_with(name, {64, 2048, needed}), "no error");
        EXPECT_EQ(error_with(name, {64, 2048, needed - 1}),
                  "the picture has 64x32 pixels and so needs " + std::to_string(needed) +
                      " bytes, more than the memory limit leaves for it (" + std::to_string(needed - 1) +
                      " bytes); --limit-memory raises it");
    }
    EXPECT_EQ(error_with("a.png", {64, 2048, 10}),
              "has " + std::to_string(std::filesystem::file_size(folder_ / "a.png")) +
                  " bytes, more than the memory limit of 10 bytes allows; --limit-memory raises it");
}

// OpenEXR allocates what an attribute's size says; the fuzzer asked it for 1.8 GB.
TEST_F(Codec, ExrHeadersKeepToTheirFile) {
    write_exr(folder_ / "a.exr", gradient(16, 16), false, {{"command", "some text"}});
    const std::vector<std::byte> bytes = read_file(folder_ / "a.exr");
    const std::string whole(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto error_with = [&](const std::string& attribute, const std::string& replacement) {
        std::string text = whole;
        const size_t at = text.find(attribute);
        EXPECT_NE(at, std::string::npos);
        text.replace(at, attribute.size(), replacement);
        return error_of([&] { check_exr_header(std::as_bytes(std::span(text.data(), text.size())), {}); });
    };
    const std::string zero(1, '\0');
    const std::string command = "command" + zero + "string" + zero, text = bytes_of_u32(9) + "some text";
    EXPECT_EQ(error_with(command + text, command + text), "no error");
    EXPECT_EQ(error_with(command + text, command + bytes_of_u32(0x70000000) + "some text"),
              "broken EXR: its header declares more bytes than there are");
    const std::string unknown = "command" + zero + "thing" + zero;
    EXPECT_EQ(error_with(command + text, unknown + bytes_of_u32(0x70000000) + "some text"),
              "broken EXR: its header declares more bytes than there are");
    // Texts of a list have sizes of their own.
    const std::string list = "command" + zero + "stringvector" + zero + bytes_of_u32(9);
    EXPECT_EQ(error_with(command + text, list + bytes_of_u32(5) + "texts"), "no error");
    EXPECT_EQ(error_with(command + text, list + bytes_of_u32(0x70000000) + "texts"),
              "broken EXR: its header declares more bytes than there are");
    // The library would go on reading in the midst of the next attribute.
    const std::string number = "command" + zero + "int" + zero;
    EXPECT_EQ(error_with(command + text, number + bytes_of_u32(4) + "four"), "no error");
    EXPECT_EQ(error_with(command + text, number + text), "broken EXR: an attribute has another size than its type");
    const std::string preview = "command" + zero + "preview" + zero + bytes_of_u32(12) + bytes_of_u32(1);
    EXPECT_EQ(error_with(command + text, preview + bytes_of_u32(1) + "rgba"), "no error");
    EXPECT_EQ(error_with(command + text, preview + bytes_of_u32(2) + "rgba"),
              "broken EXR: its preview has another size");
}

TEST_F(Codec, OnlyRegularFilesAreRead) {
    ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(error_of([&] { read_linear(folder_ / "pipe"); }), "is not a regular file");
    EXPECT_EQ(error_of([&] { read_linear("/dev/zero"); }), "is not a regular file");
    EXPECT_EQ(error_of([&] { read_linear(folder_); }), "is a folder, not a file");
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
