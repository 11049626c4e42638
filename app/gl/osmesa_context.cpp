// SPDX-License-Identifier: MIT
#include "app/gl/osmesa_context.h"

#include <GL/osmesa.h>
#include <fmt/format.h>

namespace candela {

struct OsmesaContext::Handle {
    OSMesaContext context = nullptr;
    ~Handle() {
        if (context != nullptr) OSMesaDestroyContext(context);
    }
};

OsmesaContext::OsmesaContext(Vec2u extent) : handle_(std::make_unique<Handle>()) {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              0,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    handle_->context = OSMesaCreateContextAttribs(attributes, nullptr);
    if (handle_->context == nullptr) {
        throw GlError("OSMesa offers no OpenGL 3.3 core context; candela render needs none");
    }
    resize({1, 1});
    gl_ = load_gl_functions([](const char* name) { return reinterpret_cast<void*>(OSMesaGetProcAddress(name)); });
    resize(extent);
}

OsmesaContext::~OsmesaContext() {
    OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
}

void OsmesaContext::resize(Vec2u extent) {
    GLint largest[2] = {1, 1};
    if (gl_.GetIntegerv != nullptr) gl_.GetIntegerv(GL_MAX_VIEWPORT_DIMS, largest);
    const Vec2u limit(largest[0], largest[1]);
    if (extent.x > limit.x || extent.y > limit.y) {
        throw GlError(fmt::format("OSMesa draws at most {}x{} pixels, not {}x{}; ask for a smaller --resolution",
                                  limit.x, limit.y, extent.x, extent.y));
    }
    ImageRgba8 buffer(static_cast<int>(extent.x), static_cast<int>(extent.y));
    if (OSMesaMakeCurrent(handle_->context, buffer.data(), GL_UNSIGNED_BYTE, buffer.width(), buffer.height()) == 0) {
        throw GlError(fmt::format("OSMesa cannot draw a picture of {}x{} pixels", extent.x, extent.y));
    }
    // The old buffer must outlive its binding.
    buffer_ = std::move(buffer);
    extent_ = extent;
}

}  // namespace candela
