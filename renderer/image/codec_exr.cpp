// SPDX-License-Identifier: MIT
// OpenEXR: 32-bit float scanlines, ZIP compressed, written to and read from memory so that files appear whole.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <cstring>

#include "renderer/image/atomic_file.h"
#include "renderer/image/codecs.h"
#include "renderer/image/exr_header.h"

namespace candela {

namespace {

class MemoryInput : public Imf::IStream {
  public:
    explicit MemoryInput(std::span<const std::byte> bytes) : Imf::IStream("picture"), bytes_(bytes) {}
    bool read(char out[], int count) override {
        if (count < 0 || bytes_.size() - at_ < static_cast<size_t>(count)) throw ImageError("it ends too early");
        std::memcpy(out, bytes_.data() + at_, static_cast<size_t>(count));
        at_ += static_cast<size_t>(count);
        return at_ < bytes_.size();
    }
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t position) override {
        if (position > bytes_.size()) throw ImageError("it ends too early");
        at_ = position;
    }

  private:
    std::span<const std::byte> bytes_;
    size_t at_ = 0;
};

class MemoryOutput : public Imf::OStream {
  public:
    MemoryOutput() : Imf::OStream("picture") {}
    void write(const char data[], int count) override {
        const auto size = static_cast<size_t>(count);
        if (bytes_.size() < at_ + size) bytes_.resize(at_ + size);
        std::memcpy(bytes_.data() + at_, data, size);
        at_ += size;
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t position) override { at_ = position; }
    std::span<const std::byte> bytes() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
    size_t at_ = 0;
};

// A slice of float values, `stride` floats apart, whose first pixel is that of the data window.
Imf::Slice float_slice(float* first, const Imath::Box2i& window, int width, size_t stride, double fill) {
    const auto x_bytes = static_cast<std::ptrdiff_t>(sizeof(float) * stride);
    const auto y_bytes = x_bytes * width;
    char* base = reinterpret_cast<char*>(first) - window.min.x * x_bytes - window.min.y * y_bytes;
    return Imf::Slice(Imf::FLOAT, base, static_cast<size_t>(x_bytes), static_cast<size_t>(y_bytes), 1, 1, fill);
}

// What the library quotes from the file may be anything; a message is one line of text.
std::string one_line(std::string message) {
    for (char& c : message) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return message;
}

}  // namespace

ImageRgba32f decode_exr(std::span<const std::byte> bytes, const DecodeLimits& limits) try {
    check_exr_header(bytes, limits);
    MemoryInput stream(bytes);
    Imf::InputFile file(stream);
    const Imath::Box2i window = file.header().dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    check_size(static_cast<uint64_t>(std::max<int64_t>(width, 0)), static_cast<uint64_t>(std::max<int64_t>(height, 0)),
               limits, sizeof(Vec4));

    const Imf::ChannelList& channels = file.header().channels();
    const bool grey = channels.findChannel("Y") != nullptr && channels.findChannel("R") == nullptr;
    if (!grey && channels.findChannel("R") == nullptr) throw ImageError("it has neither R, G, B nor Y channels");
    ImageRgba32f out(static_cast<int>(width), static_cast<int>(height), Vec4(0, 0, 0, 1));
    Imf::FrameBuffer buffer;
    float* first = &out(0, 0).x;
    const char* names[4] = {grey ? "Y" : "R", "G", "B", "A"};
    for (int c = 0; c < 4; ++c) {
        if (grey && (c == 1 || c == 2)) continue;
        buffer.insert(names[c], float_slice(first + c, window, out.width(), 4, c == 3 ? 1.0 : 0.0));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    if (grey) {
        for (Vec4& p : out.pixels())
            p.y = p.z = p.x;
    }
    return out;
} catch (const ImageError&) {
    throw;
} catch (const std::exception& error) {
    throw ImageError("broken EXR: " + one_line(error.what()));
}

void write_exr(const std::filesystem::path& path, const ImageRgba32f& image, bool with_alpha,
               const std::map<std::string, std::string>& header_text, std::span<const ExrLayer> layers) {
    MemoryOutput stream;
    try {
        Imf::Header header(image.width(), image.height());
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const auto& [key, value] : header_text)
            header.insert(key, Imf::StringAttribute(value));

        // The writer reads through non-const pointers; it does not write.
        auto& pixels = const_cast<ImageRgba32f&>(image);
        Imf::FrameBuffer buffer;
        const Imath::Box2i window = header.dataWindow();
        const char* names[4] = {"R", "G", "B", "A"};
        for (int c = 0; c < (with_alpha ? 4 : 3); ++c) {
            header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
            buffer.insert(names[c], float_slice(&pixels(0, 0).x + c, window, image.width(), 4, 0.0));
        }
        for (const ExrLayer& layer : layers) {
            for (size_t c = 0; c < layer.channels.size(); ++c) {
                const std::string name = layer.name + "." + layer.channel_names[c];
                auto& plane = const_cast<Image<float>&>(layer.channels[c]);
                header.channels().insert(name, Imf::Channel(Imf::FLOAT));
                buffer.insert(name, float_slice(plane.data(), window, image.width(), 1, 0.0));
            }
        }
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(image.height());
    } catch (const std::exception& error) {
        throw ImageError(std::string("cannot encode EXR: ") + error.what());
    }
    write_file_atomically(path, stream.bytes());
}

}  // namespace candela
