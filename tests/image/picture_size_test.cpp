// SPDX-License-Identifier: MIT
#include "renderer/image/picture_size.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "renderer/image/codec.h"
#include "tests/support/temporary_folder.h"

namespace candela {
namespace {

std::optional<PictureSize> size_of(const std::vector<unsigned char>& bytes) {
    return picture_size({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()});
}

TEST(PictureSize, OfAPngAsItIsWritten) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "picture.png";
    write_png(file, ImageRgba8(37, 21, Rgba8{1, 2, 3, 255}), false);
    std::ifstream stream(file, std::ios::binary);
    const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(stream), {}};
    const auto size = size_of(bytes);
    ASSERT_TRUE(size);
    EXPECT_EQ(size->width, 37u);
    EXPECT_EQ(size->height, 21u);
    EXPECT_FALSE(size_of({bytes.begin(), bytes.begin() + 20}));
}

TEST(PictureSize, OfJpegAndKtx2ByTheirHeads) {
    // A comment segment, then a progressive frame of 300 × 200.
    const std::vector<unsigned char> jpeg = {0xff, 0xd8, 0xff, 0xfe, 0, 4,    1,    2, 0xff, 0xc2, 0,
                                             17,   8,    0,    200,  1, 0x2c, 0x03, 0, 0,    0};
    const auto frame = size_of(jpeg);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->width, 300u);
    EXPECT_EQ(frame->height, 200u);
    EXPECT_FALSE(size_of({0xff, 0xd8, 0xff, 0xfe, 0xff, 0xff, 0, 0, 0, 0, 0, 0})) << "the segment ends past the file";

    std::vector<unsigned char> ktx2 = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
    ktx2.resize(28, 0);
    ktx2[20] = 64;
    ktx2[25] = 1;
    const auto texture = size_of(ktx2);
    ASSERT_TRUE(texture);
    EXPECT_EQ(texture->width, 64u);
    EXPECT_EQ(texture->height, 256u);
    EXPECT_FALSE(size_of({}));
    EXPECT_FALSE(size_of({'R', 'I', 'F', 'F'}));
}

}  // namespace
}  // namespace candela
