#include <ssphh/core/sphere.h>

#include "relight_data.h"

namespace ssphh::transport {

sh::RadianceSh RelightSession::emission_profile(const vec3& center, float radius, int degree,
                                                int rays) const {
  const Data& d = data_->settled();
  if (d.bounce) throw Error("emission profile", "operator bounce does not light surfels", "use surfel");
  if (!is_finite(center) || !(radius > 0) || !std::isfinite(radius))
    throw Error("emission profile", "its sphere must have a finite centre and a positive radius");
  if (degree < 0 || degree > sh::max_degree || rays < 1)
    throw Error("emission profile",
                fmt::format("degree {} and {} rays per direction make no sense", degree, rays));
  const int count = 16 * sh::coefficient_count(degree);
  std::vector<vec3> directions;
  std::vector<rays::RayQuery> beams;
  for (int q = 0; q < count; ++q) {
    directions.push_back(spherical_fibonacci(q, count));
    const Frame frame = Frame::around(directions.back());
    for (int r = 0; r < rays; ++r) {
      // Points of a Fibonacci spiral, uniform on the disc.
      const float distance = radius * std::sqrt((static_cast<float>(r) + 0.5f) / static_cast<float>(rays));
      const float angle = 2.3999632f * static_cast<float>(r);
      const vec3 offset = distance * (std::cos(angle) * frame.x + std::sin(angle) * frame.y);
      const float half_way = std::sqrt(std::max(radius * radius - distance * distance, 0.0f));
      beams.push_back({center + offset + half_way * frame.z, -frame.z, 2 * half_way});
    }
  }
  const std::vector<Sight> sights = d.network.look(beams);
  const DirectionProjector basis(degree, directions);
  std::vector<float> radiance(3 * basis.stride(), 0.0f);
  for (std::size_t q = 0; q < directions.size(); ++q) {
    vec3 mean(0);
    for (std::size_t r = q * static_cast<std::size_t>(rays); r < (q + 1) * static_cast<std::size_t>(rays);
         ++r) {
      const Sight& sight = sights[r];
      require(sight.group < static_cast<int>(d.state.group_scales.size()), "transport source",
              "a surface glows in a group that there is not");
      if (sight.group >= 0) mean += d.state.group_scales[sight.group] * sight.emission;
      if (sight.patch == no_patch || d.light.direct.empty()) continue;
      const auto p = static_cast<std::size_t>(sight.patch);
      mean += sight.albedo * (1 / pi) * vec3(d.light.direct[p] + d.light.indirect[d.network.surfel_of(p)]);
    }
    mean /= static_cast<float>(rays);
    for (std::size_t c = 0; c < 3; ++c)
      radiance[c * basis.stride() + q] = mean[static_cast<glm::length_t>(c)];
  }
  sh::RadianceSh profile(degree);
  basis.project(radiance, profile);
  return profile;
}

}  // namespace ssphh::transport
