// Projects a sky to spherical harmonics and prints the irradiance that surfaces facing each axis receive from
// it.

#include <cstdio>

#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>

using namespace ssphh;

int main() {
  // A sky of radiance 1 + y: twice as bright at the zenith as at the horizon, black at the nadir.
  const auto sky = [](const vec3& direction) { return vec3(1 + direction.y); };
  const sh::RadianceSh radiance = sh::project(2, sh::sphere_quadrature(3), sky);
  const sh::IrradianceSh irradiance = sh::irradiance_from_radiance(radiance);

  // E(n) = π + 2π/3 n·y
  const struct {
    const char* name;
    vec3 normal;
  } surfaces[] = {{"floor", {0, 1, 0}}, {"wall", {1, 0, 0}}, {"ceiling", {0, -1, 0}}};
  for (const auto& [name, normal] : surfaces) {
    std::printf("%-8s E = %.4f W/m2\n", name, static_cast<double>(sh::eval(irradiance, normal).x));
  }
}
