#pragma once
/// Where nothing hides anything.

#include <ssphh/probes/lookup_weights.h>

namespace ssphh::probes {

inline const SeesProbe everything = [](const vec3&, const vec3&) { return true; };
inline const vec3 up(0, 1, 0);

}  // namespace ssphh::probes
