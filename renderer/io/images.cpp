// SPDX-License-Identifier: MIT
#include "renderer/io/images.h"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace candela {

std::vector<DecodedImage> decode_images(std::span<const std::span<const std::byte>> encoded,
                                        const ImageDecodeOptions& options) {
    std::vector<DecodedImage> out(encoded.size());
    std::atomic<size_t> next{0};
    std::atomic<size_t> finished{0};
    std::atomic<uint64_t> used_bytes{0};
    const auto cancelled = [&] { return options.cancel != nullptr && options.cancel->load(std::memory_order_relaxed); };
    const auto decode_one = [&](size_t i) {
        if (cancelled()) {
            out[i].error = "cancelled";
            return;
        }
        if (encoded[i].empty()) {
            out[i].error = "no data";
            return;
        }
        try {
            // No picture may be larger than what is left of the memory for all.
            DecodeLimits limits = options.limits;
            const uint64_t used = used_bytes.load();
            const uint64_t left = used < options.max_total_bytes ? options.max_total_bytes - used : 0;
            limits.max_memory_bytes = std::min(limits.max_memory_bytes, left);
            out[i].pixels = decode_ldr(encoded[i], limits);
            used_bytes += out[i].pixels.size() * sizeof(Rgba8);
        } catch (const std::exception& error) {
            out[i].error = error.what();
        }
    };

    // All workers draw from one counter, in file order; the calling thread works too and alone reports progress.
    const auto work = [&](bool reports) {
        for (size_t i = next++; i < encoded.size(); i = next++) {
            decode_one(i);
            const size_t done = ++finished;
            if (reports && options.progress)
                options.progress(static_cast<float>(done) / static_cast<float>(encoded.size()));
        }
    };
    const int threads = options.threads == 0 ? tbb::task_arena::automatic : static_cast<int>(options.threads);
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::task_group group;
        const int helpers = std::max(arena.max_concurrency() - 1, 0);
        for (int k = 0; k < helpers; ++k)
            group.run([&] { work(false); });
        work(true);
        group.wait();
    });
    if (options.progress) options.progress(1.0f);
    return out;
}

}  // namespace candela
