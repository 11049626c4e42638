// SPDX-License-Identifier: MIT
#include "app/statistics_file.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "app/exit_status.h"
#include "app/sha256.h"
#include "renderer/image/atomic_file.h"
#include "renderer/image/codec.h"

namespace candela {

namespace {

uint64_t peak_rss_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024u;
}

}  // namespace

std::string statistics_json(const RunRecord& record) {
    const RenderRequest& request = record.job->request;
    const Lights& lights = request.world->lights;
    const FilmStatistics& film = record.frame->statistics;
    nlohmann::ordered_json out;
    out["candela"] = CANDELA_VERSION;
    out["scene"] = record.job->scene_path;
    out["resolution"] = {request.view.extent.x, request.view.extent.y};
    out["spp"] = record.status.spp;
    out["seed"] = request.settings.seed;
    out["threads"] =
        record.options->threads != 0 ? record.options->threads : std::max(1u, std::thread::hardware_concurrency());
    out["triangles"] = request.world->triangle_count;
    out["instances"] = request.world->scene->instances.size();
    out["lights"] = lights.punctual.size() + lights.cells.size() + (lights.environment ? 1 : 0);
    out["seconds"] = {{"load", record.job->load_seconds},
                      {"build", record.job->build_seconds},
                      {"render", record.status.render_seconds},
                      {"write", record.write_seconds},
                      {"first_frame", record.first_frame_seconds}};
    if (record.pictures) out["pictures"] = *record.pictures;
    out["samples"] = film.total_samples + record.earlier_samples;
    out["rays"] = {{"camera", record.status.rays.camera},
                   {"bounce", record.status.rays.bounce},
                   {"shadow", record.status.rays.shadow}};
    // JSON has no NaN: an unknown error is null.
    if (std::isfinite(film.relative_error)) {
        out["relative_error"] = film.relative_error;
        out["relative_error_95"] = film.relative_error_95;
    } else {
        out["relative_error"] = out["relative_error_95"] = nullptr;
    }
    out["non_finite"] = film.non_finite;
    out["biased"] = request.settings.biased();
    out["peak_rss_bytes"] = peak_rss_bytes();
    out["image_sha256"] = sha256_hex(std::as_bytes(std::span(record.frame->image.pixels())));
    out["warnings"] = record.job->warnings;
    out["command"] = record.options->command;
    return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void write_statistics(const RunRecord& record) {
    const std::string& path = record.options->stats_file;
    if (path.empty()) return;
    const std::string json = statistics_json(record);
    if (path == "-") {
        fmt::print("{}", json);
        return;
    }
    try {
        write_file_atomically(path, json);
    } catch (const ImageError& error) {
        throw CommandError(ExitStatus::unwritable_output, path + ": " + error.what());
    }
}

}  // namespace candela
