// SPDX-License-Identifier: MIT
// Opening a scene as the program does it, from the name of the file to the first picture at 1280×720: how long each
// step holds it up, and how far time and memory are from what the file cannot do without. Yardsticks are measured
// between the openings, so that both see the same machine, and without giving back what they took; all figures are
// medians. Pictures are decoded by the packaged libraries for the yardstick; own_images is what candela's readers take.
#include <benchmark/benchmark.h>

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <map>
#include <thread>

#include <tbb/parallel_invoke.h>
#include <nlohmann/json.hpp>

#include "app/render_job.h"
#include "renderer/image/codecs.h"
#include "renderer/io/asset_images.h"
#include "renderer/io/glb_container.h"
#include "renderer/io/json_document.h"
#include "tests/benchmarks/made_scenes.h"
#include "tests/benchmarks/opening_memory.h"
#include "tests/benchmarks/percentile.h"
#include "tests/benchmarks/shared_scenes.h"

namespace candela::bench {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
}

// All pictures of a file as they are stored, also those that no material reads.
class StoredPictures {
  public:
    explicit StoredPictures(const std::filesystem::path& path)
        : context_(path.string(), diagnostics_, options_), bytes_(read_file(path)) {
        GlbChunks chunks{{reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}, std::nullopt};
        if (looks_like_glb(bytes_)) chunks = parse_glb(bytes_);
        const Json document = parse_json(context_, chunks.json);
        layout_ = read_layout(context_, document);
        const AssetFiles files(path);
        buffers_.emplace(context_, layout_, files, chunks.bin);
        for (const ImageLayout& image : layout_.images) {
            if (image.view) {
                encoded_.push_back(buffers_->view(*image.view));
            } else {
                owned_.push_back(is_data_uri(*image.uri) ? decode_data_uri(*image.uri)
                                                         : read_file(files.resolve(*image.uri)));
                encoded_.emplace_back(owned_.back());
            }
        }
    }

    // On two threads, the largest first.
    double packaged_decoding_ms() const {
        std::vector<std::span<const std::byte>> queue = encoded_;
        std::ranges::stable_sort(queue, std::ranges::greater(), &std::span<const std::byte>::size);
        std::vector<ImageRgba8> decoded(queue.size());
        std::atomic<size_t> next{0};
        const auto work = [&] {
            for (size_t i = next++; i < queue.size(); i = next++) {
                const bool is_png = sniff_format(queue[i]) == ImageFormat::png;
                decoded[i] = is_png ? decode_png_with_libpng(queue[i], {}) : decode_ldr(queue[i]);
            }
        };
        const Clock::time_point start = Clock::now();
        tbb::parallel_invoke(work, work);
        return ms_since(start);
    }

    double decoding_ms() const {
        ImageDecodeOptions options;
        options.threads = 2;
        const Clock::time_point start = Clock::now();
        const std::vector<DecodedImage> decoded = decode_images(encoded_, options);
        return ms_since(start);
    }

  private:
    Diagnostics diagnostics_;
    LoadOptions options_;
    LoadContext context_;
    RawBytes bytes_;
    Layout layout_;
    std::optional<BufferStore> buffers_;
    std::vector<RawBytes> owned_;
    std::vector<std::span<const std::byte>> encoded_;
};

// Embree alone over the triangles of a world, as it has them.
double embree_ms(const World& world) {
    AccelInput input;
    const auto describe = [](const WorldShape& shape) {
        AccelShape out;
        for (const std::shared_ptr<const MeshVertices>& part : shape.parts) {
            for (size_t i = 0; i < part->positions.size(); ++i) {
                const Primitive& primitive = part->mesh->primitives[i];
                AccelGeometry geometry;
                geometry.positions = part->positions[i];
                geometry.triangles = primitive.triangles;
                out.geometries.push_back(geometry);
            }
        }
        return out;
    };
    input.fixed = describe(world.fixed);
    input.fixed_surfaces.resize(input.fixed.geometries.size());
    for (const WorldShape& shape : world.shapes)
        input.shapes.push_back(describe(shape));
    const Clock::time_point start = Clock::now();
    const auto accel = Accel::build(input);
    return ms_since(start);
}

struct Times {
    std::map<std::string, std::vector<double>> steps_ms;
    std::vector<double> open_ms, first_picture_ms, images_ms, own_images_ms, build_ms, parse_ms;
};

// Returns the world that it has shown.
std::shared_ptr<const World> open_once(const RenderOptions& options, Times& times) {
    malloc_trim(0);
    RenderSession session;
    const Clock::time_point start = Clock::now();
    std::string step = "reading";
    Clock::time_point begin = start;
    std::map<std::string, double> steps;
    const auto enter = [&](const std::string& next) {
        steps[step] += ms_since(begin);
        step = next;
        begin = Clock::now();
    };
    RenderJob job = prepare_render(
        options,
        [&](const char* word, double) {
            if (step != word) enter(word);
        },
        nullptr);
    enter("first_picture");
    times.open_ms.push_back(ms_since(start));
    const uint64_t epoch = session.submit(job.request);
    for (const Frame* frame = nullptr; frame == nullptr || frame->epoch < epoch; frame = session.latest())
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    enter("");
    times.first_picture_ms.push_back(ms_since(start));
    session.stop();
    times.parse_ms.push_back(steps["reading"]);
    for (const auto& [name, ms] : steps)
        times.steps_ms[name].push_back(ms);
    return job.world;
}

void loading(benchmark::State& state, const std::string& name) {
    const std::filesystem::path path = name == "terrain" ? terrain_file() : scene_path(name);
    if (!std::filesystem::exists(path)) {
        state.SkipWithError("scene absent");
        return;
    }
    RenderOptions options;
    options.scene = path.string();
    options.resolution = Vec2u(1280, 720);
    const bool is_terrain = name == "terrain";
    const StoredPictures pictures(path);
    Times times;
    for (auto _ : state) {
        times.images_ms.push_back(pictures.packaged_decoding_ms());
        times.own_images_ms.push_back(pictures.decoding_ms());
        const std::shared_ptr<const World> world = open_once(options, times);
        times.build_ms.push_back(embree_ms(*world));
    }
    // The film counts only where the first picture does.
    std::vector<double> memory_ratio, peak_mb;
    for (int i = 0; i < 3; ++i) {
        const OpeningMemory memory = opening_memory(path, is_terrain);
        peak_mb.push_back(1e-6 * memory.peak_bytes);
        memory_ratio.push_back(memory.peak_bytes / memory.needed_bytes);
    }

    const auto median = [](const std::vector<double>& values) { return percentile(values, 0.5); };
    for (const auto& [step, ms] : times.steps_ms) {
        if (!step.empty()) state.counters[step + "_ms"] = median(ms);
    }
    std::vector<double> ratio;
    for (size_t i = 0; i < times.open_ms.size(); ++i) {
        ratio.push_back(is_terrain ? times.first_picture_ms[i] / (times.parse_ms[i] + times.build_ms[i])
                                   : times.open_ms[i] / std::max(times.images_ms[i], times.build_ms[i]));
    }
    state.counters["open_ms"] = median(times.open_ms);
    state.counters["to_first_picture_ms"] = median(times.first_picture_ms);
    state.counters["all_images_ms"] = median(times.images_ms);
    state.counters["own_images_ms"] = median(times.own_images_ms);
    state.counters["embree_ms"] = median(times.build_ms);
    state.counters["peak_MB"] = median(peak_mb);
    state.counters["time_ratio"] = median(ratio);
    state.counters["memory_ratio"] = median(memory_ratio);
}

#define CANDELA_LOADING(label, file) \
    BENCHMARK_CAPTURE(loading, label, file)->Unit(benchmark::kMillisecond)->Iterations(11)->UseRealTime()

CANDELA_LOADING(flight_helmet, "models/FlightHelmet/FlightHelmet.gltf");
CANDELA_LOADING(hotel_room, "models/HotelRoom/scene.glb");
CANDELA_LOADING(dream_apartment, "models/DreamApartment/dream-apartment.glb");
CANDELA_LOADING(chess_board, "models/ChessBoard/chess-board.glb");
CANDELA_LOADING(toy_car, "models/ToyCar/glTF/ToyCar.gltf");
CANDELA_LOADING(terrain, "terrain");

}  // namespace
}  // namespace candela::bench
