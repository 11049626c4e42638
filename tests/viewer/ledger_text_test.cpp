// SPDX-License-Identifier: MIT
// The firefly's ledger in words: which rows there are, and that its figures are readable.
#include "app/viewer/ledger_text.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace candela {
namespace {

TEST(LedgerText, FiguresStandUnderEachOther) {
    EXPECT_EQ(figure_text(0), "0");
    EXPECT_EQ(figure_text(0.3184f), "0.318");
    EXPECT_EQ(figure_text(9.9999f), "10.00");
    EXPECT_EQ(figure_text(99.999f), "100.0");
    EXPECT_EQ(figure_text(123.44f), "123.4");
    EXPECT_EQ(figure_text(999.99f), "1.0e+03");
    EXPECT_EQ(figure_text(0.00012f), "1.2e-04");
    EXPECT_EQ(figure_text(-2.5f), "-2.500");
    EXPECT_EQ(figure_text(infinity), "inf");
}

TEST(LedgerText, ARowForEachSurfaceAndEachLightThere) {
    // A floor under a lamp and a sky; each brings its light to the sample in a row of its own.
    Scene scene;
    test::add_object(scene, test::make_quad(Vec3(-9, 0, 9), Vec3(18, 0, 0), Vec3(0, 0, -18)),
                     test::add_lambert(scene, Vec3(0.5f)));
    test::add_object(scene, test::make_quad(Vec3(-1, 3, -1), Vec3(2, 0, 0), Vec3(0, 0, 2)),
                     test::add_emitter(scene, Vec3(4), Vec3(0)));
    scene.materials[0].name = "marble";
    scene.nodes[0].name = "ein sehr, sehr langer Fußboden";
    scene.nodes[1].name = "lamp";
    scene.environment = test::constant_environment(Vec3(0.5f));
    const std::shared_ptr<const World> world = test::build(std::move(scene));
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 2, 3), Vec3(0, 0, 0), Vec3(0, 1, 0));
    view.extent = Vec2u(16, 16);
    int lamps = 0, skies = 0;
    for (uint32_t i = 0; i < 64; ++i) {
        const Ledger ledger = trace_ledger(*world, view, {}, {8, 8, i}, 10);
        const std::vector<LedgerRow> rows = rows_of(*world, ledger);
        ASSERT_GE(rows.size(), 2u);
        EXPECT_EQ(rows[0].number, "1");
        EXPECT_EQ(rows[0].what, "ein sehr, sehr lang…, marble");
        EXPECT_EQ(rows[0].how, "diffuse");
        EXPECT_EQ(rows[0].pdf, figure_text(ledger.vertices[0].shading.pdf));
        EXPECT_EQ(rows[0].color[0], "0.500");
        size_t surfaces = 0;
        for (const LedgerRow& row : rows) {
            surfaces += row.is_light ? 0 : 1;
            if (!row.is_light) continue;
            if (row.what == "lamp, material 1") ++lamps;
            if (row.what == "environment") ++skies;
            EXPECT_TRUE(row.how == "light sample" || row.how == "BSDF sample");
            EXPECT_FALSE(row.pdf.empty());
            EXPECT_EQ(row.share.back(), '%');
        }
        EXPECT_EQ(surfaces, ledger.vertices.size());
        // The direction's share is that of what it found.
        if (ledger.vertices.size() > 1 && ledger.vertices[1].shading.found) {
            EXPECT_FALSE(rows[0].share.empty());
            EXPECT_EQ(rows[0].share, rows.back().share);
        }
        if (ledger.vertices.back().shading.end == PathEnd::missed) {
            EXPECT_EQ(rows[rows.size() - 2].how, "left the scene");
        }
    }
    EXPECT_GT(lamps, 20);
    EXPECT_GT(skies, 20);
}

}  // namespace
}  // namespace candela
