// SPDX-License-Identifier: MIT
#include "renderer/io/images.h"

#include <numeric>

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "renderer/image/picture_size.h"
#include "renderer/io/files.h"

namespace candela {

namespace {

// What costs nothing to know: of a file that is not there, nothing.
uint64_t encoded_bytes(const EncodedImage& image) {
    if (const auto* bytes = std::get_if<std::span<const std::byte>>(&image.source)) return bytes->size();
    if (const auto* uri = std::get_if<DataUri>(&image.source)) return uri->text.size();
    std::error_code error;
    const uintmax_t size = std::filesystem::file_size(std::get<std::filesystem::path>(image.source), error);
    return error ? 0 : size;
}

ImageAlpha alpha_of(const ImageRgba8& image) {
    // A row at a time, without a branch for each texel.
    for (int y = 0; y < image.height(); ++y) {
        const Rgba8* row = &image(0, y);
        uint8_t all = 255;
        for (int x = 0; x < image.width(); ++x)
            all &= row[x].a;
        if (all != 255) return ImageAlpha::transparent;
    }
    return ImageAlpha::opaque;
}

}  // namespace

struct ImageDecoding::Impl {
    std::vector<EncodedImage> images;
    ImageDecodeOptions options;
    std::vector<DecodedImage> out;
    std::vector<size_t> order;
    std::atomic<size_t> next{0}, finished{0};
    std::atomic<uint64_t> used_bytes{0};
    std::atomic<bool> left{false};
    // Of low priority: where an urgent task waits, a thread comes to it from here after the image at hand.
    tbb::task_arena arena;
    tbb::task_group group;

    Impl(std::vector<EncodedImage> encoded, const ImageDecodeOptions& decode_options)
        : images(std::move(encoded)),
          options(decode_options),
          out(images.size()),
          order(images.size()),
          arena(options.threads == 0 ? tbb::task_arena::automatic : static_cast<int>(options.threads), 1,
                tbb::task_arena::priority::low) {
        std::iota(order.begin(), order.end(), size_t{0});
        if (options.threads == 1) return;
        // The large ones first, so that none of them keeps all waiting in the end.
        std::vector<uint64_t> size_bytes(images.size());
        std::transform(images.begin(), images.end(), size_bytes.begin(), encoded_bytes);
        std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return size_bytes[a] > size_bytes[b]; });
    }

    bool cancelled() const {
        return left.load(std::memory_order_relaxed) ||
               (options.cancel != nullptr && options.cancel->load(std::memory_order_relaxed));
    }
    // Takes what the image's head says that it decodes to; false: there is not as much left.
    bool book(const std::optional<PictureSize>& size, DecodedImage& image);
    void decode(size_t i);
    bool take_next();
};

bool ImageDecoding::Impl::book(const std::optional<PictureSize>& size, DecodedImage& image) {
    if (!size) return true;
    const uint64_t wanted = uint64_t{size->width} * size->height * sizeof(Rgba8);
    uint64_t used = used_bytes.load();
    do {
        if (wanted > options.max_total_bytes - used) return false;
    } while (!used_bytes.compare_exchange_weak(used, used + wanted));
    if (options.book && !options.book(wanted)) {
        used_bytes -= wanted;
        return false;
    }
    image.booked_bytes = wanted;
    return true;
}

void ImageDecoding::Impl::decode(size_t i) {
    DecodedImage& image = out[i];
    const EncodedImage& encoded = images[i];
    if (cancelled()) {
        image.error = "cancelled";
        return;
    }
    RawBytes owned;
    std::span<const std::byte> bytes;
    try {
        if (const auto* file = std::get_if<std::filesystem::path>(&encoded.source)) {
            bytes = owned = read_file(*file);
        } else if (const auto* uri = std::get_if<DataUri>(&encoded.source)) {
            bytes = owned = decode_data_uri(uri->text);
        } else {
            bytes = std::get<std::span<const std::byte>>(encoded.source);
        }
    } catch (const std::exception& error) {
        image.error = error.what();
        image.unread = true;
        return;
    }
    if (bytes.empty()) {
        image.error = "no data";
        return;
    }
    try {
        DecodeLimits limits = options.limits;
        const std::optional<PictureSize> size = picture_size(bytes);
        if (!book(size, image)) {
            // The message says what is left of the memory for all.
            image.too_much = true;
            const uint64_t left_bytes = options.book ? 0 : options.max_total_bytes - used_bytes.load();
            limits.max_memory_bytes = std::min(limits.max_memory_bytes, left_bytes);
        }
        image.pixels = decode_ldr(bytes, limits);
        image.alpha = size && size->opaque ? ImageAlpha::opaque : alpha_of(image.pixels);
        image.oddities = basisu_oddities(bytes, encoded.as_color, encoded.as_data);
        if (encoded.mips) image.smaller = make_mip_chain(image.pixels, *encoded.mips);
    } catch (const std::exception& error) {
        image.error = error.what();
        image.pixels = {};
    }
}

bool ImageDecoding::Impl::take_next() {
    const size_t i = next++;
    if (i >= images.size()) return false;
    decode(order[i]);
    ++finished;
    return true;
}

ImageDecoding::ImageDecoding(std::vector<EncodedImage> images, const ImageDecodeOptions& options)
    : impl_(std::make_unique<Impl>(std::move(images), options)) {
    // All threads draw from one counter.
    if (options.threads == 1) return;
    impl_->next.store(0, std::memory_order_release);
    for (size_t i = 0; i < impl_->images.size(); ++i)
        impl_->arena.enqueue(impl_->group.defer([impl = impl_.get()] { impl->take_next(); }));
}

ImageDecoding::~ImageDecoding() {
    impl_->left = true;
    impl_->arena.execute([&] { impl_->group.wait(); });
}

std::vector<DecodedImage> ImageDecoding::finish() {
    const auto report = [&] {
        if (!impl_->options.progress || impl_->images.empty()) return;
        impl_->options.progress(static_cast<float>(impl_->finished.load()) / static_cast<float>(impl_->images.size()));
    };
    impl_->arena.execute([&] {
        report();
        while (impl_->take_next())
            report();
        impl_->group.wait();
    });
    // What the threads have written is seen from here on.
    if (impl_->finished.load(std::memory_order_acquire) != impl_->images.size()) std::terminate();
    if (impl_->options.progress) impl_->options.progress(1.0f);
    return std::move(impl_->out);
}

std::vector<DecodedImage> decode_images(std::span<const std::span<const std::byte>> encoded,
                                        const ImageDecodeOptions& options) {
    std::vector<EncodedImage> images;
    images.reserve(encoded.size());
    for (const std::span<const std::byte>& each : encoded)
        images.push_back({each, std::nullopt, false, false});
    return ImageDecoding(std::move(images), options).finish();
}

}  // namespace candela
