#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/study/inside.h>

namespace ssphh::study {
namespace {

constexpr std::size_t rays_per_point = 16, rays_per_place = 16;

/// The same directions around every normal, spread evenly.
vec3 spread(std::size_t ray, std::size_t of, const vec3& normal) {
  const vec2 u((static_cast<float>(ray) + 0.5f) / static_cast<float>(of),
               (static_cast<float>(reverse_bits(static_cast<std::uint32_t>(ray))) + 0.5f) * 0x1p-32f);
  return Frame::around(normal).to_world(sample_cosine_hemisphere(u));
}

}  // namespace

std::vector<std::uint8_t> inside(const rays::TransportSource& source,
                                 std::span<const rays::SurfacePoint> points, float time) {
  const rays::PosedWorld surfaces(source, time);
  const float lift = 1e-4f * surfaces.bounds().radius();
  std::vector<rays::RayQuery> rays;
  for (const rays::SurfacePoint& point : points)
    for (std::size_t r = 0; r < rays_per_point; ++r)
      rays.push_back({point.position + lift * point.normal, spread(r, rays_per_point, point.normal)});
  std::vector<rays::RayHit> hits(rays.size());
  surfaces.intersect(rays, hits);

  std::vector<rays::RayQuery> up;
  std::vector<std::size_t> met(points.size(), 0), of;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].escaped()) continue;
    const std::size_t point = i / rays_per_point;
    ++met[point];
    const vec3 place = rays[i].origin + 0.5f * hits[i].distance * rays[i].direction;
    for (std::size_t r = 0; r < rays_per_place; ++r) {
      up.push_back({place, spread(r, rays_per_place, {0, 1, 0})});
      of.push_back(point);
    }
  }
  std::vector<std::uint8_t> blocked(up.size());
  surfaces.occluded(up, blocked);
  std::vector<std::size_t> free(points.size(), 0);
  for (std::size_t i = 0; i < up.size(); ++i) free[of[i]] += blocked[i] ? 0 : 1;

  std::vector<std::uint8_t> result(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto sky = static_cast<float>(free[p]), asked = static_cast<float>(met[p] * rays_per_place);
    result[p] = 8 * met[p] > rays_per_point && sky <= inside_sky * asked;
  }
  return result;
}

}  // namespace ssphh::study
