// SPDX-License-Identifier: MIT
// candela render: a scene to a file, without a display.
#include <fmt/format.h>

#include <filesystem>

#include "app/clock_text.h"
#include "app/commands.h"
#include "app/frame_sequence.h"
#include "app/interrupt.h"
#include "app/picture_file.h"
#include "app/pose_choice.h"
#include "app/progress_bar.h"
#include "app/render_job.h"
#include "app/statistics_file.h"
#include "app/stopwatch.h"
#include "app/viewer/view_control.h"
#include "renderer/integrator/aov.h"

namespace candela {

namespace {

void check_options(const RenderOptions& options) {
    const std::string extension = extension_of(options.output);
    if (extension != ".png" && extension != ".exr" && extension != ".hdr") {
        throw CommandError(ExitStatus::wrong_usage, options.output + ": the output must end in .png, .exr or .hdr");
    }
    if (!options.aovs.empty() && extension != ".exr") {
        throw CommandError(ExitStatus::wrong_usage, options.output + ": --aov needs an .exr output");
    }
    constexpr std::string_view known[] = {"albedo",   "normal",  "depth",    "position", "uv",   "material",
                                          "instance", "samples", "variance", "error",    "rays", "bounces"};
    for (const std::string& name : options.aovs) {
        if (std::find(std::begin(known), std::end(known), name) == std::end(known)) {
            throw CommandError(
                ExitStatus::wrong_usage,
                "--aov " + name +
                    ": is none of "
                    "albedo,normal,depth,position,uv,material,instance,samples,variance,error,rays,bounces");
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
std::vector<ExrLayer> make_layers(const RenderOptions& options, const RenderRequest& request, const Film& film,
                                  double mean_luminance) {
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
    Frame maps;
    maps.maps = ImageRgba32f(static_cast<int>(extent.x), static_cast<int>(extent.y));
    map_rows(film, mean_luminance, 0, extent.y, maps);
    for (uint32_t y = 0; y < extent.y; ++y) {
        for (uint32_t x = 0; x < extent.x; ++x) {
            const FirstHit hit = trace_first_hit(*request.world, request.view, (Vec2(x, y) + 0.5f) / Vec2(extent));
            const float standard_error = error[size_t{y} * extent.x + x];
            const Vec4& map = maps.maps(static_cast<int>(x), static_cast<int>(y));
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
                if (n == "error") value.x = map[static_cast<int>(PixelMap::error)];
                if (n == "rays") value.x = map[static_cast<int>(PixelMap::rays)];
                if (n == "bounces") value.x = map[static_cast<int>(PixelMap::bounces)];
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
    if (!options.aovs.empty()) {
        layers = make_layers(options, job.request, session.snapshot_film(), frame.statistics.mean_luminance);
    }
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

// Renders pictures one after the other and keeps what the record of the run needs.
class Pictures {
  public:
    Pictures(const RenderOptions& options, Clock::time_point start)
        : options_(options), start_(start), session_(session_options(options)), bar_(options.quiet, options.verbose) {}

    ProgressBar& bar() { return bar_; }
    // step: what the progress bar says. complete: a picture that was interrupted is not written.
    void render(const RenderJob& job, const std::string& path, const std::string& step, bool complete);
    void write_record(const RenderJob& job, std::optional<uint32_t> pictures) const;

  private:
    static SessionOptions session_options(const RenderOptions& options) {
        SessionOptions out;
        out.threads = options.threads;
        out.publish_frames = false;
        return out;
    }

    const RenderOptions& options_;
    Clock::time_point start_;
    RenderSession session_;
    ProgressBar bar_;
    SessionStatus total_;           // seconds and rays of all pictures
    const Frame* frame_ = nullptr;  // the session's, of the last picture
    double write_seconds_ = 0, first_frame_seconds_ = 0;
    uint64_t earlier_samples_ = 0;
};

void Pictures::render(const RenderJob& job, const std::string& path, const std::string& step, bool complete) {
    const double before_render = seconds_since(start_);
    session_.submit(job.request);
    while (!session_.wait_until_done(0.05)) {
        if (InterruptGuard::interrupted()) session_.stop();
        const SessionStatus status = session_.status();
        const double fraction = fraction_done(job.request, status);
        const double left = fraction > 0.01 ? status.render_seconds * (1 - fraction) / fraction : 0;
        bar_.show(step, fraction,
                  fmt::format("{} spp  {}{}  {:.1f} Mrays/s", status.spp, clock_text(status.render_seconds),
                              left > 0 ? ", " + clock_text(left) + " left" : "", status.rays_per_second * 1e-6));
    }
    bar_.clear();
    const SessionStatus status = session_.status();
    if (!status.error.empty())
        throw CommandError(ExitStatus::internal_error, status.error + "; ask for a smaller --resolution");
    if (complete && InterruptGuard::interrupted()) return;
    if (frame_ != nullptr) earlier_samples_ += frame_->statistics.total_samples;
    if (frame_ == nullptr) first_frame_seconds_ = before_render + status.render_seconds;
    frame_ = session_.latest();
    const SessionStatus before = total_;
    total_ = status;
    total_.render_seconds += before.render_seconds;
    total_.rays += before.rays;

    const Clock::time_point write_start = Clock::now();
    RenderOptions to = options_;
    to.output = path;
    write_picture(to, job, *frame_, session_);
    write_seconds_ += seconds_since(write_start);
    const FilmStatistics& film = frame_->statistics;
    if (film.non_finite > 0) {
        fmt::print(stderr, "candela: warning: {} samples were not finite and do not count\n", film.non_finite);
    }
    if (!options_.quiet && options_.stats_file != "-") {
        fmt::print("{}: {}x{}, {:.4g} spp in {:.2f} s, estimated error {}{}\n", path, frame_->image.width(),
                   frame_->image.height(), film.mean_samples, status.render_seconds,
                   std::isfinite(film.relative_error)
                       ? fmt::format("{:.2f} % (95 % of pixels within {:.2f} %)", 100 * film.relative_error,
                                     100 * film.relative_error_95)
                       : "unknown",
                   job.request.settings.biased() ? ", biased" : "");
        std::fflush(stdout);
    }
}

void Pictures::write_record(const RenderJob& job, std::optional<uint32_t> pictures) const {
    if (frame_ == nullptr) return;
    write_statistics(
        {&options_, &job, total_, frame_, write_seconds_, first_frame_seconds_, pictures, earlier_samples_});
}

}  // namespace

ExitStatus run_render(const RenderOptions& options) {
    const Clock::time_point start = Clock::now();
    check_options(options);
    const InterruptGuard guard;
    Pictures pictures(options, start);
    RenderJob job = prepare_render(
        options, [&](const char* step, double fraction) { pictures.bar().show(step, fraction); },
        InterruptGuard::flag());
    pictures.bar().clear();
    if (!options.quiet) {
        for (const std::string& warning : job.warnings)
            fmt::print(stderr, "candela: warning: {}\n", warning);
    }
    if (!options.frames && !options.turntable) {
        pictures.render(job, options.output, "render", false);
        pictures.write_record(job, std::nullopt);
        return InterruptGuard::interrupted() ? ExitStatus::interrupted : ExitStatus::done;
    }

    // One picture after the other; the first is the job's already.
    const Camera camera = job.request.view.camera;
    const Vec3 pivot = options.target.value_or(view_of(camera, job.world->bounds).pivot);
    const uint32_t animation = options.frames ? choose_animation(options, *job.rest).value_or(0) : 0;
    const auto [first, last] = options.frames.value_or(FrameRange{0, options.turntable.value_or(1) - 1});
    uint32_t written = 0;
    for (uint32_t k = first; k <= last && !InterruptGuard::interrupted(); ++k) {
        const double build_seconds = job.build_seconds;
        if (options.turntable) {
            job.request.view.camera = turned_camera(camera, pivot, k, *options.turntable);
        } else if (k != first) {
            show_pose(job, options, animation, k / options.fps, InterruptGuard::flag());
            job.build_seconds += build_seconds;
        }
        pictures.render(job, numbered(options.output, k),
                        fmt::format("picture {} of {}", k - first + 1, last - first + 1), true);
        if (!InterruptGuard::interrupted()) ++written;
    }
    pictures.write_record(job, written);
    if (InterruptGuard::interrupted()) {
        // A turn has no range of its own to go on with.
        const std::string rest = options.frames ? fmt::format("; --frames {}:{} goes on", first + written, last) : "";
        fmt::print(stderr, "candela: interrupted after {} of {} pictures{}\n", written, last - first + 1, rest);
    }
    return InterruptGuard::interrupted() ? ExitStatus::interrupted : ExitStatus::done;
}

}  // namespace candela
