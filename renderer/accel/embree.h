// SPDX-License-Identifier: MIT
// Embree under one spelling: 3.13 and 4 differ in the header's name, in the context of a query and in how it is passed.
// Private to this room.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace candela::embree {

#if RTC_VERSION_MAJOR >= 4

using QueryContext = RTCRayQueryContext;

inline void init_context(QueryContext& context) {
    rtcInitRayQueryContext(&context);
}

inline void intersect(RTCScene scene, QueryContext& context, RTCRayHit& ray_hit) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &ray_hit, &arguments);
}

inline void occluded(RTCScene scene, QueryContext& context, RTCRay& ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &ray, &arguments);
}

#else

using QueryContext = RTCIntersectContext;

inline void init_context(QueryContext& context) {
    rtcInitIntersectContext(&context);
}

inline void intersect(RTCScene scene, QueryContext& context, RTCRayHit& ray_hit) {
    rtcIntersect1(scene, &context, &ray_hit);
}

inline void occluded(RTCScene scene, QueryContext& context, RTCRay& ray) {
    rtcOccluded1(scene, &context, &ray);
}

#endif

}  // namespace candela::embree
