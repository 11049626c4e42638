// SPDX-License-Identifier: MIT
// How fast pictures of each format decode on one thread: megapixels a second as MPixel/s.
#include <benchmark/benchmark.h>

#include "renderer/image/atomic_file.h"
#include "renderer/image/codec.h"
#include "tests/benchmarks/shared_scenes.h"

namespace candela::bench {
namespace {

void decoding(benchmark::State& state, const std::string& name) {
    const std::filesystem::path path = scene_path(name);
    if (!std::filesystem::exists(path)) {
        state.SkipWithError("picture absent");
        return;
    }
    const std::vector<std::byte> bytes = read_file(path);
    double pixels = 0;
    for (auto _ : state) {
        const ImageRgba8 image = decode_ldr(bytes);
        pixels += static_cast<double>(image.size());
        benchmark::DoNotOptimize(image.data());
    }
    state.counters["MPixel/s"] = benchmark::Counter(1e-6 * pixels, benchmark::Counter::kIsRate);
}

#define CANDELA_DECODING(label, file) BENCHMARK_CAPTURE(decoding, label, file)->Unit(benchmark::kMillisecond)

CANDELA_DECODING(uastc_colour, "models/AnisotropyBarnLamp/glTF-KTX2-Basisu/AnisotropyBarnLamp_basecolor.ktx2");
CANDELA_DECODING(uastc_normal, "models/AnisotropyBarnLamp/glTF-KTX2-Basisu/AnisotropyBarnLamp_normalbump.ktx2");
CANDELA_DECODING(uastc_orm,
                 "models/AnisotropyBarnLamp/glTF-KTX2-Basisu/AnisotropyBarnLamp_occlusionroughnessmetal.ktx2");
CANDELA_DECODING(uastc_anisotropy, "models/AnisotropyBarnLamp/glTF-KTX2-Basisu/AnisotropyBarnLamp_anisotropy.ktx2");
CANDELA_DECODING(png, "models/GlassVaseFlowers/glTF/shrub_sorrel_01_color_1k.png");
CANDELA_DECODING(jpeg, "models/AlphaBlendModeTest/glTF/MatBed_baseColor.jpg");
CANDELA_DECODING(webp, "models/WebpCurvedSurface/webp_DefaultMaterial_BaseColor.webp");

}  // namespace
}  // namespace candela::bench
