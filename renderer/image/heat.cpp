// SPDX-License-Identifier: MIT
#include "renderer/image/heat.h"

namespace candela {

Vec3 heat_color(float t) {
    constexpr float c[7][3] = {{0.0002189403691192265f, 0.001651004631001012f, -0.01948089843709184f},
                               {0.1065134194856116f, 0.5639564367884091f, 3.932712388889277f},
                               {11.60249308247187f, -3.972853965665698f, -15.9423941062914f},
                               {-41.70399613139459f, 17.43639888205313f, 44.35414519872813f},
                               {77.162935699427f, -33.40235894210092f, -81.80730925738993f},
                               {-71.31942824499214f, 32.62606426397723f, 73.20951985803202f},
                               {25.13112622477341f, -12.24266895238567f, -23.07032500287172f}};
    t = std::clamp(t, 0.0f, 1.0f);
    Vec3 out(0);
    for (int i = 6; i >= 0; --i)
        out = out * t + Vec3(c[i][0], c[i][1], c[i][2]);
    return glm::clamp(out, 0.0f, 1.0f);
}

Vec3 difference_color(float t) {
    const Vec3 middle(0.12f, 0.12f, 0.13f), below(0.25f, 0.60f, 1.0f), above(1.0f, 0.62f, 0.20f);
    t = std::clamp(t, -1.0f, 1.0f);
    return middle + std::sqrt(std::abs(t)) * ((t < 0 ? below : above) - middle);
}

float HeatScale::position(float value) const {
    if (logarithmic) return std::log(std::max(value, low) / low) / std::log(high / low);
    return (value - low) / (high - low);
}

}  // namespace candela
