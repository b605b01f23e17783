#pragma once
/// Light of degree 1 that differs by channel and direction.

#include <ssphh/sh/coefficients.h>

namespace ssphh::test {

inline sh::RadianceSh sloped_light(float mean, float slope) {
  sh::RadianceSh light(1);
  light[0] = mean * vec3(1, 2, 3), light[1] = slope * vec3(1, 0.5f, 0.25f), light[3] = vec3(-slope);
  return light;
}

}  // namespace ssphh::test
