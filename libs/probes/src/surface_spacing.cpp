#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <ssphh/core/parallel.h>
#include <ssphh/geometry/nearest.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/surface_spacing.h>

namespace ssphh::probes {
namespace {

constexpr std::size_t asked = 48, any = 12, along = 4;
constexpr float share_of_any = 0.6f;
/// On a narrow strip most of what is near is none of its own: there a spacing is this share of the way to the
/// second neighbour along it, at most so many times what any allow.
constexpr float share_of_second = 0.8f, most_of_any = 4;
/// No spacing is less than a quarter of that which one point of fifty does not reach: two at almost one place
/// are no measure.
constexpr std::size_t few = 50;
constexpr float least_share = 0.25f;

/// Metres; 0 for a point that is alone.
float spacing_at(const rays::SurfacePoint& point, std::span<const rays::SurfacePoint> points,
                 const geometry::NearestPoints& nearest) {
  std::array<geometry::Near, asked> near;
  const int count = nearest.find(point.position, near);
  float sum = 0, most = 0, second = 0;
  std::size_t others = 0, found = 0;
  for (int k = 0; k < count; ++k) {
    const geometry::Near& n = near[k];
    if (!(n.distance2 > 0)) continue;
    if (others++ < any) most = share_of_any * std::sqrt(n.distance2);
    const rays::SurfacePoint& other = points[n.index];
    const float off = glm::dot(other.position - point.position, point.normal);
    if (found == along || glm::dot(other.normal, point.normal) < fitted_cosine ||
        off * off > fitted_off_plane * fitted_off_plane * n.distance2)
      continue;
    sum += std::sqrt(n.distance2);
    if (++found == 2) second = std::sqrt(n.distance2);
  }
  if (found == 0) return most;
  const float mean = sum / static_cast<float>(found);
  if (others < any || mean <= most) return mean;
  return std::max(most, std::min({share_of_second * second, most_of_any * most, mean}));
}

}  // namespace

std::vector<float> surface_spacings(std::span<const rays::SurfacePoint> points) {
  std::vector<vec3> positions;
  for (const rays::SurfacePoint& point : points) positions.push_back(point.position);
  const geometry::NearestPoints nearest(positions);
  std::vector<float> spacings(points.size());
  parallel_for(points.size(), 256,
               [&](std::size_t i) { spacings[i] = spacing_at(points[i], points, nearest); });

  std::vector<float> sorted;
  std::ranges::copy_if(spacings, std::back_inserter(sorted), [](float s) { return s > 0; });
  if (sorted.empty()) return spacings;
  const auto low = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / few);
  std::ranges::nth_element(sorted, low);
  for (float& s : spacings) s = std::max(s, least_share * *low);
  return spacings;
}

}  // namespace ssphh::probes
