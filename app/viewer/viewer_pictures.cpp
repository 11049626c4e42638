// SPDX-License-Identifier: MIT
// The viewer's pictures: the true one, its denoised preview, and their files.
#include <fmt/format.h>

#include "app/picture_file.h"
#include "app/viewer/viewer.h"

namespace candela {

void Viewer::toggle_denoise() {
    model_.denoises = !model_.denoises;
    if (!model_.denoises) denoised_->clear();
    redraws_ = 2;
}

void Viewer::update_denoised() {
    if (!model_.denoises || before_preview_) return;
    if (denoised_->update(model_.job.request, model_.status, *frame_)) {
        ++denoised_serial_;
        redraws_ = std::max(redraws_, 1);
    }
}

const DenoisedPicture* Viewer::shown_denoised() const {
    const DenoisedPicture* out = frame_ != nullptr && model_.denoises ? denoised_->picture(frame_->epoch) : nullptr;
    const bool fits =
        out != nullptr && out->image.width() == frame_->image.width() && out->image.height() == frame_->image.height();
    return fits ? out : nullptr;
}

void Viewer::save_image(const std::string& path, const Frame& frame, bool denoised) const {
    const bool png = extension_of(path) == ".png";
    std::map<std::string, std::string> header = picture_header(model_.options.command, model_.job.request);
    const std::string lights = model_.lights.words();
    if (!lights.empty()) header["lights"] = lights;
    if (denoised) header["denoised"] = "yes: not the truth";
    save_picture(path, frame, png ? model_.display.tone : ToneSettings{}, model_.job.request.settings, header);
}

void Viewer::save(const std::string& path) const {
    if (frame_ == nullptr)
        throw CommandError(ExitStatus::unwritable_output, path + ": there is no picture to save yet");
    save_image(path, *frame_, false);
}

void Viewer::save_denoised(const std::string& path) const {
    const DenoisedPicture* denoised = shown_denoised();
    if (denoised == nullptr)
        throw CommandError(ExitStatus::unwritable_output, path + ": no denoised picture is shown; D makes one");
    Frame frame;
    frame.image = denoised->image;
    save_image(path, frame, true);
}

// candela-NAME-001.png in the current folder, and the linear radiance beside it; of the denoised picture with
// "_denoised" after the number.
void Viewer::save_next(bool denoised) {
    if (!model_.has_scene()) return;
    if (!viewer_options_.touches_files) {
        notify("the picture would be saved now");
        return;
    }
    const std::string stem = "candela-" + std::filesystem::path(model_.job.scene_path).stem().string();
    std::string name;
    for (int number = 1; name.empty(); ++number) {
        const std::string candidate = fmt::format("{}-{:03}{}", stem, number, denoised ? "_denoised" : "");
        std::error_code error;
        if (!std::filesystem::exists(candidate + ".png", error) && !std::filesystem::exists(candidate + ".exr", error))
            name = candidate;
    }
    try {
        for (const char* extension : {".png", ".exr"}) {
            if (denoised) {
                save_denoised(name + extension);
            } else {
                save(name + extension);
            }
        }
        const std::string lights = model_.lights.words();
        const bool offers = !denoised && shown_denoised() != nullptr;
        notify(fmt::format("saved {0}.png and {0}.exr{1}{2}", name, lights.empty() ? "" : " with " + lights,
                           offers ? ": the true picture; Ctrl+Shift+S saves the denoised one" : ""));
    } catch (const CommandError& error) {
        notify(error.what(), true);
    }
}

}  // namespace candela
