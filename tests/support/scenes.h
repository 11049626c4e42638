// SPDX-License-Identifier: MIT
// Small scenes made in code, for tests that want a closed form.
#pragma once

#include <memory>

#include "renderer/scene/scene.h"
#include "renderer/world/world.h"

namespace candela::test {

// Appends a material that scatters exactly as Lambert has it and returns its id.
MaterialId add_lambert(Scene& scene, const Vec3& albedo);
// Lambertian and emitting radiance from its front.
MaterialId add_emitter(Scene& scene, const Vec3& radiance, const Vec3& albedo = Vec3(0), bool double_sided = false);

// The parallelogram origin, origin + a, origin + a + b, origin + b; its front is where a × b points. uv runs along a
// and b.
Primitive make_quad(const Vec3& origin, const Vec3& a, const Vec3& b);
// A sphere of longitude × latitude quads with smooth normals pointing out, or in.
Primitive make_sphere(const Vec3& center, float radius, int longitudes, int latitudes, bool inside_out = false);

// Adds the primitive as a mesh of its own and places it.
void add_object(Scene& scene, Primitive primitive, MaterialId material, const Mat4& world_from_object = Mat4(1.0f));

Environment constant_environment(const Vec3& radiance);

std::shared_ptr<const World> build(Scene scene);

}  // namespace candela::test
