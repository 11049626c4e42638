// SPDX-License-Identifier: MIT
// candela render: a scene to a file, without a display.
#include <fmt/format.h>

#include <chrono>

#include "app/clock_text.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/picture_file.h"
#include "app/progress_bar.h"
#include "app/render_job.h"
#include "app/statistics_file.h"
#include "renderer/integrator/aov.h"

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

void check_options(const RenderOptions& options) {
    const std::string extension = extension_of(options.output);
    if (extension != ".png" && extension != ".exr" && extension != ".hdr") {
        throw CommandError(ExitStatus::wrong_usage, options.output + ": the output must end in .png, .exr or .hdr");
    }
    if (!options.aovs.empty() && extension != ".exr") {
        throw CommandError(ExitStatus::wrong_usage, options.output + ": --aov needs an .exr output");
    }
    constexpr std::string_view known[] = {"albedo",   "normal",   "depth",   "position", "uv",
                                          "material", "instance", "samples", "variance"};
    for (const std::string& name : options.aovs) {
        if (std::find(std::begin(known), std::end(known), name) == std::end(known)) {
            throw CommandError(
                ExitStatus::wrong_usage,
                "--aov " + name + ": is none of albedo,normal,depth,position,uv,material,instance,samples,variance");
        }
    }
    check_output(options.output);
    if (!options.stats_file.empty() && options.stats_file != "-") check_output(options.stats_file);
}

ExrLayer make_layer(const std::string& name, const std::vector<std::string>& channels, Vec2u extent) {
    ExrLayer layer{name, channels, {}};
    layer.channels.assign(channels.size(), Image<float>(static_cast<int>(extent.x), static_cast<int>(extent.y)));
    return layer;
}

// Layers of the first surface through each pixel's centre, and of the film.
std::vector<ExrLayer> make_layers(const RenderOptions& options, const RenderRequest& request, const Film& film) {
    const std::map<std::string, std::vector<std::string>> channels{
        {"albedo", {"R", "G", "B"}}, {"normal", {"X", "Y", "Z"}}, {"position", {"X", "Y", "Z"}}, {"uv", {"U", "V"}}};
    const Vec2u extent = request.view.extent;
    std::vector<ExrLayer> layers;
    for (const std::string& name : options.aovs) {
        const auto found = channels.find(name);
        layers.push_back(
            make_layer(name, found != channels.end() ? found->second : std::vector<std::string>{"V"}, extent));
    }
    const std::vector<float> error = standard_error_map(film);
    for (uint32_t y = 0; y < extent.y; ++y) {
        for (uint32_t x = 0; x < extent.x; ++x) {
            const FirstHit hit = trace_first_hit(*request.world, request.view, (Vec2(x, y) + 0.5f) / Vec2(extent));
            const float standard_error = error[size_t{y} * extent.x + x];
            const auto index = [](uint32_t i) { return i == invalid_index ? -1.0f : static_cast<float>(i); };
            for (ExrLayer& layer : layers) {
                const std::string& n = layer.name;
                Vec3 value(0);
                if (n == "albedo") value = hit.albedo;
                if (n == "normal") value = hit.normal;
                if (n == "position") value = hit.position;
                if (n == "uv") value = Vec3(hit.uv, 0);
                if (n == "depth") value.x = hit.depth;
                if (n == "material") value.x = index(hit.material);
                if (n == "instance") value.x = index(hit.instance);
                if (n == "samples") value.x = static_cast<float>(film.at({x, y}).count);
                if (n == "variance") value.x = standard_error * standard_error;
                for (size_t c = 0; c < layer.channels.size(); ++c) {
                    layer.channels[c](static_cast<int>(x), static_cast<int>(y)) = value[static_cast<int>(c)];
                }
            }
        }
    }
    return layers;
}

void write_picture(const RenderOptions& options, const RenderJob& job, const Frame& frame, RenderSession& session) {
    std::vector<ExrLayer> layers;
    if (!options.aovs.empty()) layers = make_layers(options, job.request, session.snapshot_film());
    save_picture(options.output, frame, options.tone, job.request.settings,
                 picture_header(options.command, job.request), layers);
}

// The nearest of the limits, as a fraction of the way there.
double fraction_done(const RenderRequest& request, const SessionStatus& status) {
    double fraction = 0;
    if (request.max_spp < std::numeric_limits<uint32_t>::max())
        fraction = static_cast<double>(status.spp) / request.max_spp;
    if (std::isfinite(request.max_seconds)) fraction = std::max(fraction, status.render_seconds / request.max_seconds);
    return fraction;
}

}  // namespace

ExitStatus run_render(const RenderOptions& options) {
    const Clock::time_point start = Clock::now();
    check_options(options);
    const InterruptGuard guard;
    ProgressBar bar(options.quiet, options.verbose);
    const RenderJob job = prepare_render(
        options, [&](const char* step, double fraction) { bar.show(step, fraction); }, InterruptGuard::flag());
    bar.clear();
    if (!options.quiet) {
        for (const std::string& warning : job.warnings)
            fmt::print(stderr, "candela: warning: {}\n", warning);
    }

    SessionOptions session_options;
    session_options.threads = options.threads;
    session_options.publish_frames = false;
    RenderSession session(session_options);
    const double before_render = std::chrono::duration<double>(Clock::now() - start).count();
    session.submit(job.request);
    while (!session.wait_until_done(0.05)) {
        if (InterruptGuard::interrupted()) session.stop();
        const SessionStatus status = session.status();
        const double fraction = fraction_done(job.request, status);
        const double left = fraction > 0.01 ? status.render_seconds * (1 - fraction) / fraction : 0;
        bar.show("render", fraction,
                 fmt::format("{} spp  {}{}  {:.1f} Mrays/s", status.spp, clock_text(status.render_seconds),
                             left > 0 ? ", " + clock_text(left) + " left" : "", status.rays_per_second * 1e-6));
    }
    bar.clear();
    const SessionStatus status = session.status();
    if (!status.error.empty())
        throw CommandError(ExitStatus::internal_error, status.error + "; ask for a smaller --resolution");
    const Frame& frame = *session.latest();

    const Clock::time_point write_start = Clock::now();
    write_picture(options, job, frame, session);
    const double write_seconds = std::chrono::duration<double>(Clock::now() - write_start).count();
    write_statistics({&options, &job, status, &frame, write_seconds, before_render + status.render_seconds});
    if (frame.statistics.non_finite > 0) {
        fmt::print(stderr, "candela: warning: {} samples were not finite and do not count\n",
                   frame.statistics.non_finite);
    }
    if (!options.quiet && options.stats_file != "-") {
        fmt::print("{}: {}x{}, {:.4g} spp in {:.2f} s, estimated error {}{}\n", options.output, frame.image.width(),
                   frame.image.height(), frame.statistics.mean_samples, status.render_seconds,
                   std::isfinite(frame.statistics.relative_error)
                       ? fmt::format("{:.2f} %", 100 * frame.statistics.relative_error)
                       : "unknown",
                   job.request.settings.biased() ? ", biased" : "");
    }
    return InterruptGuard::interrupted() ? ExitStatus::interrupted : ExitStatus::done;
}

}  // namespace candela
