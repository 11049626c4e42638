// SPDX-License-Identifier: MIT
// Draws a frame: linear radiance as a float texture, exposure and tone curve in the shader; beside it one of the
// frame's maps. The same for the window and for off-screen pictures.
#pragma once

#include <optional>

#include "app/gl/gl_context.h"
#include "app/gl/gl_program.h"
#include "renderer/film/frame.h"
#include "renderer/image/compare.h"
#include "renderer/image/heat.h"
#include "renderer/image/tone.h"

namespace candela {

// A map in heat colours, to the right of the wipe.
struct DisplayedMap {
    PixelMap map = PixelMap::error;
    HeatScale scale;
    float wipe = 0;  // 0 at the picture's left edge, 1 at its right
    // In place of the frame's map one of upload_differences.
    std::optional<ReferenceMetric> metric = std::nullopt;
};

struct DisplaySettings {
    ToneSettings tone;
    bool checkerboard = true;  // under pixels that are not opaque; else their alpha goes to the framebuffer
    std::optional<DisplayedMap> map = std::nullopt;  // drawn where the frame came with maps
    std::optional<float> other = std::nullopt;       // where the other picture begins, if there is one
};

// A picture of that extent as large as it fits in the middle of the framebuffer; pixels, from the bottom left.
struct FitRectangle {
    int x = 0, y = 0, width = 0, height = 0;
};
FitRectangle fit_rectangle(Vec2u picture, Vec2u framebuffer);

// What is shown in place of a frame's own picture.
struct StandIn {
    const ImageRgba32f* image = nullptr;  // of the frame's extent; null: nothing stands in
    uint64_t serial = 0;                  // another picture has another one
};

class Display {
  public:
    // Needs the context to be current, here and in every call. Throws GlError.
    explicit Display(const GlContext& context);
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    // Uploads the frame unless its serial is that of the one uploaded last, and so for what stands in for its picture;
    // returns whether it did. Throws GlError
    // where it exceeds the driver's texture size.
    bool upload(const Frame& frame, const StandIn& stand_in = {});
    // Another picture, drawn to the right of a line; and maps of differences from a reference.
    void upload_other(const ImageRgba32f& image) { other_extent_ = upload_image(image, other_texture_, other_extent_); }
    void upload_differences(const ImageRgba32f& maps) {
        differences_extent_ = upload_image(maps, differences_texture_, differences_extent_);
    }
    // Forgets the frame uploaded last.
    void clear() { extent_ = Vec2u(0); }
    // Clears the framebuffer and draws the frame uploaded last, if any, into its fit_rectangle.
    void draw(const DisplaySettings& settings);

  private:
    // Returns the texture's new extent.
    Vec2u upload_image(const ImageRgba32f& image, GLuint texture, Vec2u extent) const;

    const GlContext& context_;
    GlProgram program_;
    GLuint texture_ = 0, maps_texture_ = 0, other_texture_ = 0, differences_texture_ = 0, vertex_array_ = 0;
    Vec2u extent_{0}, maps_extent_{0}, other_extent_{0}, differences_extent_{0};
    uint64_t serial_ = 0, stand_in_serial_ = 0;  // of what was uploaded last; the latter 0: the frame's own picture
    bool has_maps_ = false;
};

}  // namespace candela
