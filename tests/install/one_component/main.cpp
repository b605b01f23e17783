// Irradiance under a sky of radiance 1 is π, in every direction.

#include <cstdio>

#include <ssphh/core/version.h>
#include <ssphh/sh/irradiance.h>

static_assert(SSPHH_VERSION_AT_LEAST(0, 1, 0) && !SSPHH_VERSION_AT_LEAST(999, 0, 0));

int main() {
  ssphh::sh::RadianceSh sky(2);
  sky[0] = ssphh::vec3(3.5449077f);  // √(4π) times the constant
  std::printf("%.3f\n", static_cast<double>(ssphh::sh::irradiance(sky, {0, 1, 0}).x));
  return 0;
}
