// SPDX-License-Identifier: MIT
#include "tests/benchmarks/opening_memory.h"

#include <malloc.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "app/render_job.h"
#include "renderer/io/repair.h"
#include "tests/benchmarks/process_memory.h"

namespace candela::bench {

namespace {

constexpr Vec2u film_extent(1280, 720);

// The texels of what is drawn, the vertices and triangles, the tree over them.
uint64_t needed_bytes(const World& world) {
    uint64_t bytes = world.accel->memory_bytes();
    for (const SceneImage& image : world.scene->images) {
        if (image.pixels) bytes += image.pixels->size() * sizeof(Rgba8);
    }
    for (const std::shared_ptr<const Mesh>& mesh : world.scene->meshes) {
        for (const Primitive& primitive : mesh->primitives)
            bytes += vertex_bytes(primitive) + primitive.triangles.size() * sizeof(Vec3u);
    }
    return bytes;
}

RenderJob open(const RenderOptions& options) {
    return prepare_render(
        options, [](const char*, double) {}, nullptr);
}

// Waits for the first picture of a job.
void show(RenderSession& session, const RenderJob& job) {
    const uint64_t epoch = session.submit(job.request);
    for (const Frame* frame = nullptr; frame == nullptr || frame->epoch < epoch; frame = session.latest())
        std::this_thread::sleep_for(std::chrono::microseconds(100));
}

}  // namespace

int print_opening_memory(const std::filesystem::path& scene) {
    // Code and threads that every scene takes are there before.
    {
        RenderSession session;
        RenderOptions small;
        small.resolution = Vec2u(16, 16);
        show(session, open(small));
    }
    malloc_trim(0);
    const double before = resident_bytes();
    forget_peak();

    RenderOptions options;
    options.scene = scene.string();
    options.resolution = film_extent;
    const RenderJob job = open(options);
    RenderSession session;
    const double opened = peak_bytes() - before;
    show(session, job);
    std::printf("%.0f %.0f %.0f\n", opened, peak_bytes() - before, static_cast<double>(needed_bytes(*job.world)));
    session.stop();
    return 0;
}

OpeningMemory opening_memory(const std::filesystem::path& scene, bool film) {
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
    const std::string command = "'" + program.string() + "' --opening '" + scene.string() + "'";
    OpeningMemory out;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return out;
    double opened = 0, shown = 0, needed = 0;
    const int read = std::fscanf(pipe, "%lf %lf %lf", &opened, &shown, &needed);
    if (pclose(pipe) != 0 || read != 3) return out;
    out.peak_bytes = film ? shown : opened;
    out.needed_bytes = needed + (film ? static_cast<double>(film_extent.x) * film_extent.y * sizeof(FilmPixel) : 0);
    return out;
}

}  // namespace candela::bench
