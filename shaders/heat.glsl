// SPDX-License-Identifier: MIT
// Colours for numbers, line for line those of renderer/image/heat.cpp; a test keeps the two equal.

vec3 heat_color(float t) {
    const vec3 c[7] = vec3[7](vec3(0.0002189403691192265, 0.001651004631001012, -0.01948089843709184),
                              vec3(0.1065134194856116, 0.5639564367884091, 3.932712388889277),
                              vec3(11.60249308247187, -3.972853965665698, -15.9423941062914),
                              vec3(-41.70399613139459, 17.43639888205313, 44.35414519872813),
                              vec3(77.162935699427, -33.40235894210092, -81.80730925738993),
                              vec3(-71.31942824499214, 32.62606426397723, 73.20951985803202),
                              vec3(25.13112622477341, -12.24266895238567, -23.07032500287172));
    t = clamp(t, 0.0, 1.0);
    vec3 color = vec3(0.0);
    for (int i = 6; i >= 0; --i)
        color = color * t + c[i];
    return clamp(color, 0.0, 1.0);
}

vec3 difference_color(float t) {
    const vec3 middle = vec3(0.12, 0.12, 0.13), below = vec3(0.25, 0.60, 1.0), above = vec3(1.0, 0.62, 0.20);
    t = clamp(t, -1.0, 1.0);
    return middle + sqrt(abs(t)) * ((t < 0.0 ? below : above) - middle);
}

float heat_position(float value, float low, float high, bool logarithmic) {
    if (logarithmic) return log(max(value, low) / low) / log(high / low);
    return (value - low) / (high - low);
}
