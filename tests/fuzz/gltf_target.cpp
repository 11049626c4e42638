// SPDX-License-Identifier: MIT
// A whole file, .gltf or .glb, from its bytes to a scene that the renderer can rely on.
#include <filesystem>

#include "renderer/io/load_gltf.h"
#include "renderer/scene/pose.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/soundness.h"

namespace {

void require_soundness(const candela::Scene& scene) {
    const std::string broken = candela::test::unsoundness_of(scene);
    candela::fuzz::require(broken.empty(), broken.c_str());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace candela;
    // A folder without any file to read: what is to be found must be in the bytes.
    static const std::filesystem::path name = "/proc/self/fdinfo/scene.gltf";
    LoadOptions options;
    options.max_memory_bytes = uint64_t{64} << 20;
    Diagnostics diagnostics;
    try {
        const auto rest =
            std::make_shared<const Scene>(load_gltf(fuzz::bytes_of(data, size), name, diagnostics, options));
        require_soundness(*rest);
        for (uint32_t a = 0; a < std::min<size_t>(rest->animations.size(), 4); ++a)
            require_soundness(*posed_scene(rest, a, 0.4f));
    } catch (const LoadError& error) {
        fuzz::require(!error.reason().empty(), "an error has a reason");
        fuzz::require(std::string_view(error.what()).find('\n') == std::string_view::npos, "a message is one line");
    }
    for (const Diagnostic& warning : diagnostics.warnings())
        fuzz::require(warning.message.find('\n') == std::string::npos, "a message is one line");
    return 0;
}
