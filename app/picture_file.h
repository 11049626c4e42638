// SPDX-License-Identifier: MIT
// A rendered frame to a .png, .exr or .hdr file.
#pragma once

#include <map>
#include <span>
#include <string>

#include "app/exit_status.h"
#include "renderer/image/codec.h"
#include "renderer/image/tone.h"
#include "renderer/session/render_session.h"

namespace candela {

// ".png" of "Picture.PNG"
std::string extension_of(const std::string& path);

// Says before the work what would fail after it: throws CommandError where no file can be made at path.
void check_output(const std::string& path);

// What the file tells of its making: command, version, camera, and whether the picture is biased.
std::map<std::string, std::string> picture_header(const std::string& command, const RenderRequest& request);

// Tone only matters to .png. Throws CommandError; nothing is written then.
void save_picture(const std::string& path, const Frame& frame, const ToneSettings& tone,
                  const IntegratorSettings& settings, const std::map<std::string, std::string>& header,
                  std::span<const ExrLayer> layers = {});

}  // namespace candela
