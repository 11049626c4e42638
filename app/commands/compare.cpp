// SPDX-License-Identifier: MIT
// candela compare: how far two pictures differ.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "renderer/image/codec.h"
#include "renderer/image/compare.h"

namespace candela {

namespace {

ImageRgba32f read_picture(const std::string& path) {
    try {
        return read_any_as_linear(path);
    } catch (const ImageError& error) {
        throw CommandError(ExitStatus::unreadable_scene, path + ": " + error.what());
    }
}

// The absolute difference, as linear values.
void write_difference(const std::string& path, const ImageRgba32f& a, const ImageRgba32f& b) {
    ImageRgba32f difference(a.width(), a.height());
    for (size_t i = 0; i < a.size(); ++i) {
        difference.pixels()[i] = Vec4(glm::abs(Vec3(a.pixels()[i]) - Vec3(b.pixels()[i])), 1.0f);
    }
    const std::string extension = std::filesystem::path(path).extension().string();
    try {
        if (extension == ".exr") {
            write_exr(path, difference, false, {});
        } else if (extension == ".hdr") {
            write_hdr(path, difference);
        } else if (extension == ".png") {
            write_png(path, tone_map(difference, {0.0f, ToneCurve::linear}), false);
        } else {
            throw CommandError(ExitStatus::wrong_usage, path + ": the output must end in .png, .exr or .hdr");
        }
    } catch (const ImageError& error) {
        throw CommandError(ExitStatus::unwritable_output, path + ": " + error.what());
    }
}

}  // namespace

ExitStatus run_compare(const CompareOptions& options) {
    const ImageRgba32f a = read_picture(options.a), b = read_picture(options.b);
    if (a.width() != b.width() || a.height() != b.height()) {
        throw CommandError(ExitStatus::wrong_usage,
                           fmt::format("{} has {}x{} pixels and {} has {}x{}; render them in one size", options.a,
                                       a.width(), a.height(), options.b, b.width(), b.height()));
    }
    const ImageDifference d = compare_images(a, b);
    if (!options.output.empty()) write_difference(options.output, a, b);
    if (options.json) {
        const nlohmann::ordered_json out{{"rmse", d.rmse}, {"relmse", d.rel_mse},          {"mae", d.mae},
                                         {"flip", d.flip}, {"signed_mean", d.signed_mean}, {"max", d.max_abs}};
        fmt::print("{}\n", out.dump(2));
    } else {
        fmt::print(
            "RMSE         {:.6g}\nrelMSE       {:.6g}\nMAE          {:.6g}\nFLIP         {:.6g}\nsigned mean  "
            "{:.6g}\nmax          {:.6g}\n",
            d.rmse, d.rel_mse, d.mae, d.flip, d.signed_mean, d.max_abs);
    }
    bool passed = true;
    const auto check = [&](const char* name, double value, const std::optional<double>& limit) {
        if (!limit || value <= *limit) return;
        fmt::print(stderr, "candela: {} is {:.6g}, above the limit of {:.6g}\n", name, value, *limit);
        passed = false;
    };
    check("RMSE", d.rmse, options.max_rmse);
    check("relMSE", d.rel_mse, options.max_rel_mse);
    check("MAE", d.mae, options.max_mae);
    check("FLIP", d.flip, options.max_flip);
    return passed ? ExitStatus::done : ExitStatus::check_failed;
}

}  // namespace candela
