// SPDX-License-Identifier: MIT
#include "tests/benchmarks/throughput.h"

#include <ctime>

#include "renderer/math/frame.h"
#include "renderer/math/hash.h"
#include "renderer/sampling/warp.h"
#include "tests/benchmarks/percentile.h"

namespace candela::bench {

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double limit_paths_per_s(const World& world, const View& view, uint32_t max_depth) {
    const uint32_t width = view.extent.x, height = view.extent.y, pixels = width * height;
    std::vector<double> rates;
    float sink = 0;
    for (uint32_t repeat = 0; repeat < 5; ++repeat) {
        const double start = cpu_seconds();
        for (uint32_t i = 0; i < pixels; ++i) {
            uint32_t state = hash_combine(repeat, i);
            const auto uniform = [&] { return unit_float(state = hash_u32(state + 0x9e3779b9u)); };
            const float u = uniform(), v = uniform();
            const Vec2 extent(width, height);
            const Vec2 at = (Vec2(i % width, i / width) + Vec2(u, v)) / extent;
            Ray ray = generate_ray(view.camera, extent.x / extent.y, at, Vec2(0.5f));
            for (uint32_t depth = 0; depth < max_depth; ++depth) {
                const Hit hit = world.accel->intersect(ray, 0);
                if (!hit.valid()) break;
                const Surface& surface = world.surfaces[hit.surface];
                const Vec3u index = surface.primitive->triangles[hit.triangle];
                const Vec3 p0 = surface.positions[index.x];
                const Vec3 cross = glm::cross(surface.positions[index.y] - p0, surface.positions[index.z] - p0);
                Vec3 normal = glm::normalize(Mat3(world.transforms[surface.transform].world_from_normal) * cross);
                if (glm::dot(normal, ray.direction) > 0) normal = -normal;
                const Vec3 from = ray.origin + hit.distance * ray.direction + 1e-4f * normal;
                Ray shadow;
                shadow.origin = from;
                shadow.direction = Vec3(0, 1, 0);
                if (const std::vector<EmissiveTriangle>& lamps = world.lights.triangles; !lamps.empty()) {
                    const EmissiveTriangle& lamp = lamps[std::min(
                        static_cast<size_t>(uniform() * static_cast<float>(lamps.size())), lamps.size() - 1)];
                    const float root = std::sqrt(uniform()), along = uniform();
                    const Vec3 to_lamp = lamp.p0 + root * (1 - along) * lamp.edge1 + root * along * lamp.edge2 - from;
                    shadow.t_max = 0.9999f * glm::length(to_lamp);
                    shadow.direction = glm::normalize(to_lamp);
                }
                sink += world.accel->transmittance(shadow).x;
                const float a = uniform();
                ray = {from, OrthonormalFrame::from_normal(normal).world_from_local(
                                 sample_cosine_hemisphere({a, uniform()}))};
            }
        }
        rates.push_back(pixels / (cpu_seconds() - start));
    }
    // Looked at, so that the work is not left out.
    return sink >= 0 ? percentile(rates, 0.5) : 0;
}

}  // namespace candela::bench
