// SPDX-License-Identifier: MIT
// A viewer off-screen, for tests that play events to it and look at its pictures.
#pragma once

#include <chrono>
#include <thread>

#include "app/gl/osmesa_context.h"
#include "app/viewer/viewer.h"

namespace candela::test {

inline constexpr Vec2u extent(200, 150);

inline RenderOptions options_for(const std::string& scene, uint32_t spp = 4) {
    RenderOptions options;
    options.scene = scene;
    options.spp = spp;
    options.threads = 2;
    return options;
}

// Off-screen, on a clock that the test moves.
class ViewerTest : public testing::Test {
  protected:
    void start(const RenderOptions& options) {
        context_ = std::make_unique<OsmesaContext>(extent);
        ViewerOptions viewer_options;
        viewer_options.now_s = [this] { return now_s_; };
        if (prepare_) viewer_options.prepare = prepare_;
        viewer_ = std::make_unique<Viewer>(options, *context_, viewer_options);
        if (waits_) finish();
    }
    void TearDown() override { viewer_.reset(); }

    // Until nothing is left to load or to render.
    void finish() {
        const auto begin = std::chrono::steady_clock::now();
        do {
            viewer_->update();
            viewer_->draw();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            ASSERT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60))
                << "the viewer does not settle";
        } while (!viewer_->finished());
        for (int i = 0; i < 3; ++i) {
            now_s_ += 0.1;
            viewer_->update();
            viewer_->draw();
        }
    }
    ImageRgba8 picture() {
        viewer_->update();
        viewer_->draw();
        return read_back(*context_);
    }
    void press(Key key, Modifiers modifiers = {}) {
        viewer_->handle(KeyPressed{key, true, modifiers});
        viewer_->handle(KeyPressed{key, false, modifiers});
    }
    void drag(MouseButton button, Vec2 from, Vec2 to, Modifiers modifiers = {}) {
        viewer_->handle(MouseMoved{from});
        viewer_->update();
        viewer_->draw();
        viewer_->handle(MousePressed{button, true, modifiers});
        viewer_->handle(MouseMoved{(from + to) / 2.0f});
        viewer_->handle(MouseMoved{to});
        viewer_->handle(MousePressed{button, false, modifiers});
    }
    void click(Vec2 at) { drag(MouseButton::left, at, at); }
    const ViewerModel& model() const { return viewer_->model(); }

    double now_s_ = 100;
    std::function<decltype(prepare_render)> prepare_;  // in place of the viewer's own
    bool waits_ = true;                                // start lets everything settle
    std::unique_ptr<OsmesaContext> context_;
    std::unique_ptr<Viewer> viewer_;
};

// Mean absolute difference of 8-bit values above the status line.
inline double difference(const ImageRgba8& a, const ImageRgba8& b) {
    double sum = 0;
    const int rows = a.height() - 30;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < a.width(); ++x) {
            for (int c = 0; c < 3; ++c)
                sum += std::abs(a(x, y)[c] - b(x, y)[c]);
        }
    }
    return sum / (3.0 * rows * a.width());
}

}  // namespace candela::test
