// SPDX-License-Identifier: MIT
#include "app/picture_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "app/command_line.h"

namespace candela {

namespace {

std::string describe_camera(const Camera& camera) {
    const Mat4& m = camera.world_from_camera;
    return fmt::format("eye {},{},{} forward {},{},{} up {},{},{} {}", m[3].x, m[3].y, m[3].z, -m[2].x, -m[2].y,
                       -m[2].z, m[1].x, m[1].y, m[1].z,
                       camera.projection == Projection::panorama ? "panorama"
                       : camera.projection == Projection::perspective
                           ? fmt::format("yfov {} degrees", glm::degrees(camera.yfov_radians))
                           : fmt::format("height {} m", 2 * camera.ortho_half_height_m));
}

}  // namespace

std::string extension_of(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return extension;
}

void check_output(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        throw CommandError(ExitStatus::unwritable_output, path + ": is a folder; name a file in it");
    }
    const std::string where = folder.empty() ? "." : folder.string();
    if (!std::filesystem::is_directory(where, error)) {
        throw CommandError(ExitStatus::unwritable_output,
                           path + ": the folder " + where + " does not exist; make it first");
    }
    if (access(where.c_str(), W_OK) != 0) {
        throw CommandError(ExitStatus::unwritable_output, path + ": the folder " + where + " cannot be written to");
    }
}

std::map<std::string, std::string> picture_header(const std::string& command, const RenderRequest& request) {
    std::map<std::string, std::string> header{
        {"command", command}, {"version", version_line()}, {"camera", describe_camera(request.view.camera)}};
    if (request.settings.biased()) header["biased"] = "depth limit or clamp";
    return header;
}

void save_picture(const std::string& path, const Frame& frame, const ToneSettings& tone,
                  const IntegratorSettings& settings, const std::map<std::string, std::string>& header,
                  std::span<const ExrLayer> layers) {
    const bool with_alpha = settings.background == BackgroundKind::transparent;
    const std::string extension = extension_of(path);
    try {
        if (extension == ".png") {
            write_png(path, tone_map(frame.image, tone), with_alpha, header);
        } else if (extension == ".hdr") {
            write_hdr(path, frame.image);
        } else {
            write_exr(path, frame.image, with_alpha, header, layers);
        }
    } catch (const ImageError& error) {
        throw CommandError(ExitStatus::unwritable_output, path + ": " + error.what() + "; nothing was written");
    }
}

}  // namespace candela
