#include <algorithm>
#include <array>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>
#include <ssphh/place/site.h>

namespace ssphh::place {
namespace {

constexpr float usual_back_limit = 0.25f;

}  // namespace

Site look_around(const rays::TransportSource& source, const vec3& position, int rays) {
  std::array<rays::RayQuery, fan_size> queries;
  std::array<rays::RayHit, fan_size> hits;
  require(rays > 0 && rays <= fan_size, "look around", "rays must be 1 to 128");
  const auto count = static_cast<std::size_t>(rays);
  for (int i = 0; i < rays; ++i) {
    queries[i] = {position, spherical_fibonacci(i, rays)};
  }
  source.intersect(0, std::span(queries).first(count), std::span(hits).first(count));

  Site site;
  int seen = 0, backs = 0;
  double inverse = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const rays::RayHit& hit = hits[i];
    if (hit.escaped()) continue;
    ++seen;
    inverse += 1.0 / std::max(hit.distance, 1e-9f);
    if (hit.distance < site.nearest) {
      site.nearest = hit.distance;
      site.nearest_hit = hit.distance * queries[i].direction;
      site.nearest_normal = hit.normal;
    }
    if (hit.back) {
      ++backs;
      if (hit.distance < site.nearest_back) {
        site.nearest_back = hit.distance;
        site.nearest_back_hit = hit.distance * queries[i].direction;
      }
    }
    if (max_component(hit.emission) > 0) site.emitter = true;
  }
  if (seen > 0) site.back = static_cast<float>(backs) / static_cast<float>(seen);
  if (inverse > 0) site.harmonic = static_cast<float>(rays / inverse);
  site.escaped = 1 - static_cast<float>(seen) / static_cast<float>(rays);
  return site;
}

std::vector<Site> look_around(const rays::TransportSource& source, std::span<const vec3> positions, int rays,
                              const Control& control) {
  std::vector<Site> sites(positions.size());
  parallel_for(
      positions.size(), 16, [&](std::size_t i) { sites[i] = look_around(source, positions[i], rays); },
      control);
  return sites;
}

float calibrated_back_limit(const rays::TransportSource& source, std::span<const vec3> interest) {
  std::vector<float> backs;
  for (const vec3& position : interest) {
    const Site site = look_around(source, position);
    if (site.escaped < 1) backs.push_back(site.back);
  }
  if (backs.empty()) return usual_back_limit;
  // The median: one lamp buried in a wall must not open all walls.
  const auto middle = backs.begin() + static_cast<std::ptrdiff_t>(backs.size() / 2);
  std::nth_element(backs.begin(), middle, backs.end());
  const float limit = std::max(usual_back_limit, *middle + usual_back_limit);
  return limit < 0.9f ? limit : 1.0f;
}

bool sees(const rays::TransportSource& source, const vec3& a, const vec3& b) {
  const rays::RayQuery way{a, b - a, 1};
  std::uint8_t blocked = 0;
  source.occluded(0, {&way, 1}, {&blocked, 1});
  return blocked == 0;
}

}  // namespace ssphh::place
