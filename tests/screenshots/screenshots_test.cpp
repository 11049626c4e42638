// SPDX-License-Identifier: MIT
// What the viewer shows of each own scene, against stored pictures and their noise.
// CANDELA_UPDATE_REFERENCES=1 renders and stores them anew: look at the pictures before you commit them.
#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/gl/osmesa_context.h"
#include "app/viewer/viewer.h"
#include "tests/screenshots/reference.h"

namespace candela::test {
namespace {

constexpr Vec2u extent(96, 72);
constexpr uint32_t spp = 16;
constexpr uint32_t first_test_seed = 1000;  // none of the references'

struct Shot {
    const char* name;
    const char* scene;
    ToneCurve curve = ToneCurve::neutral;
    const char* hdri = "";
    bool orbited = false;
};

void PrintTo(const Shot& shot, std::ostream* out) {
    *out << shot.name;
}

constexpr Shot shots[] = {{"cornell_box", "assets/cornell_box.glb"},
                          {"cornell_box_orbited", "assets/cornell_box.glb", ToneCurve::agx, "", true},
                          {"veach_plates", "assets/veach_plates.glb", ToneCurve::aces},
                          {"many_lights", "assets/many_lights.glb", ToneCurve::linear},
                          {"alpha_cards", "assets/alpha_cards.glb", ToneCurve::neutral, "assets/sky.hdr"},
                          {"glass_slab", "assets/glass_slab.glb"}};

std::filesystem::path reference_path(const Shot& shot) {
    return std::filesystem::path("tests/screenshots/references") / (std::string(shot.name) + ".exr");
}

// The viewer's picture without panels, of the view that the events lead to.
ImageRgba8 photograph(const Shot& shot, uint32_t seed, float exposure_ev = 0) {
    RenderOptions options;
    options.scene = shot.scene;
    options.hdri = shot.hdri;
    options.spp = spp;
    options.integrator.seed = seed;
    options.tone = {exposure_ev, shot.curve};
    const OsmesaContext context(extent);
    Viewer viewer(options, context, {false, {}});
    const auto settle = [&] {
        do {
            viewer.update();
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        } while (!viewer.finished());
        viewer.update();
    };
    settle();
    if (shot.orbited) {
        viewer.handle(MouseMoved{{40, 40}});
        viewer.handle(MousePressed{MouseButton::left, true, {}});
        viewer.handle(MouseMoved{{46, 43}});
        viewer.handle(MousePressed{MouseButton::left, false, {}});
        viewer.handle(Scrolled{{0, 1}});
        settle();
    }
    viewer.draw();
    return read_back(context);
}

class Screenshots : public testing::TestWithParam<Shot> {};

TEST_P(Screenshots, LooksAsStored) {
    const Shot& shot = GetParam();
    if (std::getenv("CANDELA_UPDATE_REFERENCES") != nullptr) {
        std::vector<ImageRgba8> renders;
        for (uint32_t seed = 0; seed < reference_renders; ++seed)
            renders.push_back(photograph(shot, seed));
        write_reference(reference_path(shot), make_reference(renders));
    }
    const Reference reference = read_reference(reference_path(shot));
    ASSERT_EQ(reference.mean.width(), static_cast<int>(extent.x));
    const Deviation deviation = compare(photograph(shot, first_test_seed), reference);
    EXPECT_TRUE(deviation.acceptable()) << "mean z² " << deviation.mean_square_z << " ± "
                                        << deviation.mean_square_z_error << ", of noise alone "
                                        << deviation.expected_mean_square_z << "; worst block z "
                                        << deviation.worst_block_z << " at " << deviation.worst_x << ", "
                                        << deviation.worst_y;
}

// The comparison sees what an eye would hardly see.
TEST_P(Screenshots, ATenthOfAStopIsNoticed) {
    const Shot& shot = GetParam();
    const Deviation deviation =
        compare(photograph(shot, first_test_seed + 1, 0.1f), read_reference(reference_path(shot)));
    EXPECT_FALSE(deviation.acceptable()) << "mean z² " << deviation.mean_square_z << ", worst block z "
                                         << deviation.worst_block_z;
}

INSTANTIATE_TEST_SUITE_P(Viewer, Screenshots, testing::ValuesIn(shots),
                         [](const auto& shot) { return std::string(shot.param.name); });

}  // namespace
}  // namespace candela::test
