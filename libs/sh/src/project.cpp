#include <algorithm>

#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/project.h>

#include "projection_sum.h"

namespace ssphh::sh {
namespace {

template <class Weight>
RadianceSh project_samples(int degree, std::span<const vec3> directions, std::span<const Weight> weights,
                           std::span<const vec3> radiance) {
  require(weights.size() == directions.size() && radiance.size() == directions.size(), "projection",
          "directions, weights and radiance differ in number");
  ProjectionSum sum(degree, 1, {});
  for_this_cpu([&]() SSPHH_IN_LOOP {
    for (std::size_t first = 0; first < directions.size(); first += lane_count) {
      const auto lanes = static_cast<int>(std::min<std::size_t>(lane_count, directions.size() - first));
      float8 x{}, y{}, z{}, r{}, g{}, b{};
      for (int i = 0; i < lanes; ++i) {
        const std::size_t sample = first + static_cast<std::size_t>(i);
        const vec3 light = static_cast<float>(weights[sample]) * radiance[sample];
        x[i] = directions[sample].x, y[i] = directions[sample].y, z[i] = directions[sample].z;
        r[i] = light.x, g[i] = light.y, b[i] = light.z;
      }
      sum.add_direction_block(x, y, z);
      float8* light = sum.light();
      light[0] = r, light[1] = g, light[2] = b;
      sum.finish_block();
    }
  });
  return sum.result();
}

}  // namespace

RadianceSh project(int degree, std::span<const vec3> directions, std::span<const float> weights,
                   std::span<const vec3> radiance) {
  return project_samples(degree, directions, weights, radiance);
}

RadianceSh project(int degree, std::span<const vec3> directions, std::span<const double> weights,
                   std::span<const vec3> radiance) {
  return project_samples(degree, directions, weights, radiance);
}

RadianceSh project(int degree, const SphereQuadrature& rule,
                   const std::function<vec3(const vec3&)>& radiance) {
  require_degree(degree, "projection");
  require(rule.weights.size() == rule.directions.size(), "projection",
          "directions and weights differ in number");
  require(radiance != nullptr, "projection", "there is no function to project");
  const auto count = static_cast<std::size_t>(coefficient_count(degree));
  std::array<double, max_coefficient_count> basis{};
  std::array<glm::dvec3, max_coefficient_count> totals{};
  for (std::size_t i = 0; i < rule.directions.size(); ++i) {
    eval_basis(degree, rule.directions[i], basis);
    const glm::dvec3 light = rule.weights[i] * glm::dvec3(radiance(vec3(rule.directions[i])));
    for (std::size_t k = 0; k < count; ++k) totals[k] += basis[k] * light;
  }
  RadianceSh sh(degree);
  for (std::size_t k = 0; k < count; ++k) sh.values[k] = vec3(totals[k]);
  return sh;
}

}  // namespace ssphh::sh
