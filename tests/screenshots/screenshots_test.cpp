// SPDX-License-Identifier: MIT
// What the viewer shows of each own scene, and after recorded sessions, against stored pictures and their noise.
// CANDELA_UPDATE_REFERENCES=1 renders and stores them anew: look at the pictures before you commit them.
#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/command_line.h"
#include "app/viewer/replay.h"
#include "tests/screenshots/reference.h"

namespace candela::test {
namespace {

constexpr Vec2u extent(96, 72);
constexpr uint32_t spp = 16;
constexpr uint32_t first_test_seed = 1000;  // none of the references'

struct Shot {
    const char* name;
    const char* scene = "";  // empty: what the recording of that name leads to
    ToneCurve curve = ToneCurve::neutral;
    const char* hdri = "";
    // Over 1: shrunk so many times, with the panels. What these say hangs on single samples, which no variance
    // describes, so that the seed is always the same.
    int shrunk = 1;
};

void PrintTo(const Shot& shot, std::ostream* out) {
    *out << shot.name;
}

constexpr Shot recorded[] = {{"cornell_box_orbited"},
                             {"cards_dropped"},
                             {"plates_from_above"},
                             {"denoised"},
                             {"compared"},
                             {"measured"},
                             {"edit_undone"},
                             {"lamps_out"},
                             {"bookmark_recalled"},
                             {"played"},
                             {"inspected", "", ToneCurve::neutral, "", 5}};
constexpr Shot scenes[] = {{"cornell_box", "assets/cornell_box.glb"},
                           {"veach_plates", "assets/veach_plates.glb", ToneCurve::aces},
                           {"many_lights", "assets/many_lights.glb", ToneCurve::linear},
                           {"alpha_cards", "assets/alpha_cards.glb", ToneCurve::neutral, "assets/sky.hdr"},
                           {"glass_slab", "assets/glass_slab.glb"}};

std::filesystem::path reference_path(const Shot& shot) {
    return std::filesystem::path("tests/screenshots/references") / (std::string(shot.name) + ".exr");
}

// Each pixel the mean of a square of them.
ImageRgba8 shrunk(const ImageRgba8& picture, int times) {
    ImageRgba8 out(picture.width() / times, picture.height() / times);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            glm::ivec4 sum(0);
            for (int i = 0; i < times * times; ++i)
                sum += glm::ivec4(picture(x * times + i % times, y * times + i / times));
            out(x, y) = Rgba8((sum + times * times / 2) / (times * times));
        }
    }
    return out;
}

// What the recorded session led to.
ImageRgba8 replay(const Shot& shot, uint32_t seed, float exposure_ev) {
    const Recording recording = read_recording("tests/screenshots/recordings/" + std::string(shot.name) + ".rec");
    RenderOptions options = parse_view_options(recording.arguments);
    options.integrator.seed = shot.shrunk > 1 ? 0 : seed;
    options.tone.exposure_ev += exposure_ev;
    Replay replay(recording, options);
    replay.play();
    return shot.shrunk > 1 ? shrunk(replay.picture(true), shot.shrunk) : replay.picture(false);
}

// The viewer's picture without panels.
ImageRgba8 photograph(const Shot& shot, uint32_t seed, float exposure_ev = 0) {
    if (shot.scene[0] == '\0') return replay(shot, seed, exposure_ev);
    RenderOptions options;
    options.scene = shot.scene;
    options.hdri = shot.hdri;
    options.spp = spp;
    options.integrator.seed = seed;
    options.tone = {exposure_ev, shot.curve};
    const OsmesaContext context(extent);
    Viewer viewer(options, context, {false, {}});
    do {
        viewer.update();
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    } while (!viewer.finished());
    viewer.update();
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
    const ImageRgba8 picture = photograph(shot, first_test_seed);
    ASSERT_EQ(reference.mean.width(), picture.width());
    ASSERT_EQ(reference.mean.height(), picture.height());
    const Deviation deviation = compare(picture, reference);
    EXPECT_TRUE(deviation.acceptable()) << "mean z² " << deviation.mean_square_z << " ± "
                                        << deviation.mean_square_z_error << ", of noise alone "
                                        << deviation.expected_mean_square_z << "; worst block z "
                                        << deviation.worst_block_z << " at " << deviation.worst_x << ", "
                                        << deviation.worst_y;
}

class Comparison : public testing::TestWithParam<Shot> {};

// It sees what an eye would hardly see.
TEST_P(Comparison, NoticesATenthOfAStop) {
    const Shot& shot = GetParam();
    const Deviation deviation =
        compare(photograph(shot, first_test_seed + 1, 0.1f), read_reference(reference_path(shot)));
    EXPECT_FALSE(deviation.acceptable()) << "mean z² " << deviation.mean_square_z << ", worst block z "
                                         << deviation.worst_block_z;
}

std::string name_of(const testing::TestParamInfo<Shot>& shot) {
    return shot.param.name;
}

INSTANTIATE_TEST_SUITE_P(Recorded, Screenshots, testing::ValuesIn(recorded), name_of);
INSTANTIATE_TEST_SUITE_P(Viewer, Screenshots, testing::ValuesIn(scenes), name_of);
INSTANTIATE_TEST_SUITE_P(Recorded, Comparison, testing::ValuesIn(recorded), name_of);
INSTANTIATE_TEST_SUITE_P(Viewer, Comparison, testing::ValuesIn(scenes), name_of);

}  // namespace
}  // namespace candela::test
