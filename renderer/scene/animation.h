// SPDX-License-Identifier: MIT
// Animations as the file has them: keys in time, and what they drive. Times are in seconds.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/animated_property.h"

namespace candela {

enum class Interpolation : uint8_t { step, linear, cubic_spline };

// Keys of one value of `width` numbers. values holds width numbers for each key; for cubic splines three times as many:
// the tangent towards the key, the value, the tangent away from it.
struct AnimationSampler {
    std::shared_ptr<const std::vector<float>> times_s;  // strictly increasing, never empty
    std::vector<float> values;
    uint32_t width = 1;
    Interpolation interpolation = Interpolation::linear;
    bool is_rotation = false;  // a unit quaternion (x y z w)
};

struct AnimationChannel {
    AnimationSampler sampler;
    const AnimatedProperty* property = nullptr;
    uint32_t object = 0;  // index of what owns the property: a node, a material, …
};

struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;
    float duration_s = 0.0f;  // of the longest channel
};

// The value at a time, in out[0, width); before the first key that of the first, after the last that of the last.
// Rotations come out as unit quaternions. glTF 2.0, appendix C.
void evaluate(const AnimationSampler& sampler, float time_s, std::span<float> out);

}  // namespace candela
