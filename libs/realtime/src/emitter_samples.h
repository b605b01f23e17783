#pragma once
/// Points that stand for lights with an extent, and directions that stand for an environment.

#include <optional>
#include <vector>

#include <ssphh/scene/scene.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::realtime {

/// Radical inverse: the van der Corput and Halton sequences, 0..1.
double radical_inverse(unsigned i, unsigned base);

struct AreaPoint {
  vec3 position;
  vec3 normal;  ///< unit; zero: shines everywhere
  float share;  ///< of the light's area; all together 1
};

/// Points on a mesh that lie apart, each with the share of the area nearest to it: Lloyd's algorithm on
/// points uniform by area. The same for the same input.
std::vector<AreaPoint> spread_points(const scene::Mesh& mesh, const mat4& to_world, int count);

struct Ball {
  vec3 center;
  float radius;  ///< of the ball of as much surface
};

/// The ball that a closed mesh stands for, if all its corners lie within 2 % of one distance from a point.
std::optional<Ball> as_ball(const scene::Mesh& mesh);

/// Points within a ball around the origin, equal shares, that fill its disc evenly from wherever they are
/// seen.
std::vector<AreaPoint> ball_points(float radius, int count);

/// Directions toward parts of equal size that a sun's disc around +z is cut into: so many that the shadows of
/// one map will do for each, or `most` of 1, 4, 7, 12, 16. The sine of a part's radius is sin(radius) /
/// √number; together they spread as much as the disc. radius [radians] 0: one.
std::vector<vec3> disc_parts(float radius, int most);

struct EnvironmentSample {
  vec3 direction;
  vec3 weight;  ///< radiance × solid angle
};

/// Directions by importance, `count` or fewer, environment.color included.
std::vector<EnvironmentSample> environment_directions(const scene::Environment& environment, int count);

/// Irradiance of degree 4, environment.color included.
sh::IrradianceSh environment_irradiance(const scene::Environment& environment);

/// Mean of a material's emission over its texture, or the plain factor.
vec3 mean_emission(const scene::Scene& scene, const scene::Material& material);

}  // namespace ssphh::realtime
