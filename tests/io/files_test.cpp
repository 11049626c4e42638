// SPDX-License-Identifier: MIT
// Containers and the files beside an asset: what is read, and what never is.
#include "renderer/io/files.h"
#include "renderer/io/glb_container.h"
#include "tests/io/document.h"

namespace candela {
namespace {

using namespace test;

class Files : public GltfTest {
  protected:
    static std::span<const std::byte> bytes_of(const std::string& text) {
        return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
    }
    static std::string as_text(std::span<const std::byte> bytes) {
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    std::string failure_of_glb(const std::string& bytes) {
        return failure_of([&] { load_file(write("scene.glb", bytes)); });
    }
    // A triangle whose bytes lie elsewhere.
    Document triangle_at(const std::string& uri) {
        Document document = Document::triangle();
        document.finish(uri);
        write("data.bin", {document.bytes.begin(), document.bytes.end()});
        return document;
    }
    std::string failure_with_uri(const std::string& uri) { return failure_of_text(triangle_at(uri).json.dump()); }
};

TEST_F(Files, GlbWithItsBinaryChunk) {
    Document document = Document::triangle();
    document.finish("");
    const std::string bin(document.bytes.begin(), document.bytes.end());
    const std::string glb = glb_bytes(document.json.dump(), bin);
    EXPECT_EQ(first(load_file(write("a.glb", glb))).triangles.size(), 1u);
    // The container is told by its first bytes, not by the file's name; bytes after its end are not looked at.
    EXPECT_EQ(first(load_file(write("a.gltf", glb + "rest"))).triangles.size(), 1u);
    EXPECT_EQ(failure_of_glb(glb_bytes(document.json.dump(), "")),
              "/buffers/0: has no uri, and the file has no binary chunk for it");
    // Up to three bytes of padding may follow; one byte too few is a fault.
    document.json["buffers"][0]["byteLength"] = bin.size() + 4;
    EXPECT_EQ(failure_of_glb(glb_bytes(document.json.dump(), bin)),
              "/buffers/0/byteLength: " + std::to_string(bin.size() + 4) + " bytes are declared, but only " +
                  std::to_string((bin.size() + 3) / 4 * 4) + " are there");
}

TEST_F(Files, DamagedGlbContainersAreRefused) {
    Document document = Document::triangle();
    document.finish("");
    const std::string glb = glb_bytes(document.json.dump(), {document.bytes.begin(), document.bytes.end()});
    // Cut anywhere, none is accepted.
    for (size_t length = 4; length < glb.size(); length += 7)
        EXPECT_NE(failure_of_glb(glb.substr(0, length)), "loaded") << length;
    std::string other = glb;
    other[4] = 1;
    EXPECT_EQ(failure_of_glb(other), ": GLB version 1 is not supported, only 2");
    other = glb;
    other[16] = 'X';
    EXPECT_EQ(failure_of_glb(other), ": the first GLB chunk is not JSON");
    // A chunk that overstates its length by one, within the header's length or not.
    const size_t json_size =
        static_cast<unsigned char>(glb[12]) | static_cast<size_t>(static_cast<unsigned char>(glb[13])) << 8;
    other = glb;
    ++other[20 + json_size];
    EXPECT_NE(failure_of_glb(other).find("reaches past the end"), std::string::npos);
}

TEST_F(Files, ParseGlbSkipsUnknownChunks) {
    std::string glb = glb_bytes("{}", "abcd");
    glb += u32_text(4) + "NEW!" + "1234" + u32_text(4) + std::string("BIN\0", 4) + "late";
    glb.replace(8, 4, u32_text(glb.size()));
    const GlbChunks chunks = parse_glb(bytes_of(glb));
    EXPECT_EQ(chunks.json, "{}  ");
    ASSERT_TRUE(chunks.bin.has_value());
    EXPECT_EQ(chunks.bin->size(), 4u);
    EXPECT_EQ(chunks.bin->front(), std::byte{'a'});
}

TEST_F(Files, LongerBuffersAreLegalAndShorterAreNot) {
    Document document = triangle_at("data.bin");
    write("data.bin", {document.bytes.begin(), document.bytes.end()});
    std::ofstream(folder_ / "data.bin", std::ios::app) << "more";
    EXPECT_EQ(failure_of_text(document.json.dump()), "loaded");
    write("data.bin", "short");
    EXPECT_EQ(failure_of_text(document.json.dump()),
              "/buffers/0/byteLength: 42 bytes are declared, but only 5 are there");
}

TEST_F(Files, NamesArePercentDecoded) {
    std::filesystem::create_directories(folder_ / "sub dir");
    write("sub dir/a b.bin", std::string(64, '\0'));
    write("50%25.bin", std::string(64, '\0'));
    EXPECT_EQ(failure_with_uri("sub%20dir/a%20b.bin"), "loaded");
    EXPECT_EQ(failure_with_uri("sub dir/a b.bin"), "loaded");
    EXPECT_EQ(failure_with_uri("./sub%20dir/../data.bin"), "loaded");
    EXPECT_EQ(failure_with_uri("50%25.bin"), "loaded") << "the name as it stands is the second guess";
}

TEST_F(Files, NothingOutsideTheDirectoryIsRead) {
    const auto outside = folder_.parent_path() / (folder_.filename().string() + "_outside.bin");
    std::ofstream(outside) << std::string(64, '\0');
    const std::string name = outside.filename().string();
    for (const std::string& uri : {"../" + name, "%2e%2e/" + name, "..%2F" + name, "sub/../../" + name}) {
        EXPECT_NE(failure_with_uri(uri).find("/buffers/0/uri: \"" + uri + "\" leads outside"), std::string::npos)
            << failure_with_uri(uri);
    }
    EXPECT_NE(failure_with_uri(outside.string()).find("is an absolute path"), std::string::npos);
    for (const std::string& uri :
         {std::string("http://example.org/a.bin"), "file:" + outside.string(), std::string("C:/a.bin")})
        EXPECT_NE(failure_with_uri(uri).find("is remote"), std::string::npos) << failure_with_uri(uri);
    std::filesystem::create_symlink(outside, folder_ / "link.bin");
    EXPECT_NE(failure_with_uri("link.bin").find("leads outside"), std::string::npos);
    // A sibling whose name begins with the directory's is outside as well.
    const auto sibling = folder_.string() + "_sibling";
    std::filesystem::create_directories(sibling);
    std::ofstream(sibling + "/a.bin") << std::string(64, '\0');
    const std::string into_sibling = "../" + std::filesystem::path(sibling).filename().string() + "/a.bin";
    EXPECT_NE(failure_with_uri(into_sibling).find("leads outside"), std::string::npos);
    std::filesystem::remove_all(sibling);
    std::filesystem::remove(outside);
}

TEST_F(Files, OnlyRegularFilesAreOpened) {
    std::filesystem::create_directories(folder_ / "folder");
    EXPECT_NE(failure_with_uri("folder").find("does not exist"), std::string::npos);
    EXPECT_NE(failure_with_uri("data.bin/").find("does not exist"), std::string::npos);
    EXPECT_NE(failure_with_uri("a%00b").find("is not a file name"), std::string::npos);
    EXPECT_EQ(failure_of([&] { load_file(folder_ / "absent.glb"); }), ": does not exist or cannot be opened");
    EXPECT_EQ(failure_of([&] { load_file(folder_ / "folder"); }), ": is a directory");
    Diagnostics diagnostics;
    EXPECT_THROW(load_gltf("/dev/zero", diagnostics), LoadError);
}

TEST_F(Files, PiecesReadAtOnceAreTheFile) {
    std::string text;
    for (uint32_t i = 0; text.size() < (size_t{3} << 20) + 7; ++i)
        text += std::to_string(i) + ' ';
    const std::filesystem::path file = write("large", text);
    constexpr uint64_t all = std::numeric_limits<uint64_t>::max();
    EXPECT_TRUE(as_text(read_file(file, all, true)) == text);
    EXPECT_TRUE(as_text(read_file(file)) == text);
    for (const uint64_t most : {uint64_t{0}, uint64_t{5}, uint64_t{1} << 19, (uint64_t{1} << 20) + 1})
        EXPECT_TRUE(as_text(read_file(file, most, true)) == text.substr(0, most)) << most;
}

TEST_F(Files, DataUris) {
    EXPECT_EQ(as_text(decode_data_uri("data:text/plain;base64,aGVsbG8=")), "hello");
    EXPECT_EQ(as_text(decode_data_uri("data:application/octet-stream;base64,aGVsbG8")), "hello");
    EXPECT_EQ(as_text(decode_data_uri("data:image/webp;charset=x;base64,aGVsbG8h")), "hello!");
    EXPECT_EQ(as_text(decode_data_uri("data:,a%20b")), "a b");
    EXPECT_EQ(as_text(decode_data_uri("data:;base64,")), "");
    EXPECT_THROW(decode_data_uri("data:;base64,a"), FileError);
    EXPECT_THROW(decode_data_uri("data:;base64,a*bc"), FileError);
    EXPECT_THROW(decode_data_uri("data:nothing"), FileError);
    EXPECT_TRUE(is_data_uri("DATA:,x"));
    EXPECT_FALSE(is_data_uri("data"));
    EXPECT_EQ(percent_decode("%41%4a%"), "AJ%");
    EXPECT_EQ(percent_decode("%4"), "%4");
}

}  // namespace
}  // namespace candela
