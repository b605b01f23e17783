#include <cmath>
#include <limits>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/surface_interpolation.h>

namespace ssphh::probes {
namespace {

/// 1 and the tangential offset in spacings, of each share.
using Places = std::array<vec3, most_surface_points>;

std::vector<vec3> positions_of(std::span<const rays::SurfacePoint> points) {
  std::vector<vec3> positions;
  for (const rays::SurfacePoint& point : points) positions.push_back(point.position);
  return positions;
}

/// Turns the weights, of sum `total`, into those of a linear fit's value at x. Only their ratios count: a
/// lone point at the border of those that are looked at has next to no weight.
void fit_linearly(std::span<SurfaceShare> shares, const Places& places, float total) {
  mat3 gram(0);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i].weight /= total;
    for (int c = 0; c < 3; ++c) gram[c] += shares[i].weight * places[i][c] * places[i];
  }
  gram[1][1] += fitted_ridge;
  gram[2][2] += fitted_ridge;
  const vec3 row = glm::inverse(gram)[0];
  float most = 1;  // of the way from the mean to the fit
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const float relative = glm::dot(row, places[i]);  // 1: as in the mean
    if (relative < fitted_lowest) most = std::min(most, (1 - fitted_lowest) / (1 - relative));
  }
  float sum = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i].weight *= 1 - most + most * glm::dot(row, places[i]);
    sum += shares[i].weight;
  }
  for (SurfaceShare& s : shares) s.weight /= sum;  // the ridge leaves it at 1 but for rounding
}

}  // namespace

float surface_spacing(std::span<const rays::SurfacePoint> points) {
  const geometry::NearestPoints nearest(positions_of(points));
  std::vector<float> distance(points.size(), std::numeric_limits<float>::infinity());
  parallel_for(points.size(), 256, [&](std::size_t i) {
    std::array<geometry::Near, 2 * most_surface_points> near;
    const int count = nearest.find(points[i].position, near);
    for (int k = 0; k < count; ++k) {
      const geometry::Near& found = near[static_cast<std::size_t>(k)];
      const rays::SurfacePoint& other = points[static_cast<std::size_t>(found.index)];
      const float off = std::abs(glm::dot(other.position - points[i].position, points[i].normal));
      if (found.distance2 > 0 && glm::dot(other.normal, points[i].normal) >= fitted_cosine &&
          off * off <= fitted_off_plane * fitted_off_plane * found.distance2) {
        distance[i] = std::sqrt(found.distance2);
        break;
      }
    }
  });
  if (distance.empty()) return std::numeric_limits<float>::infinity();
  const auto middle = distance.begin() + static_cast<std::ptrdiff_t>(distance.size() / 2);
  std::ranges::nth_element(distance, middle);
  return *middle;
}

bool see_along_surface(const rays::SurfacePoint& a, const rays::SurfacePoint& b, float spacing,
                       const SeesProbe& sees) {
  const float least = fitted_lift * spacing;
  const vec3 low_a = a.position + least * a.normal, low_b = b.position + least * b.normal;
  // Between points of a sphere the surface rises to an eighth of what their normals part.
  const float bulge = glm::dot(b.normal - a.normal, b.position - a.position);
  const float lift = fitted_lift_over_bulges * bulge;
  if (!(lift > 0.1f * least)) return sees(low_a, low_b);
  const vec3 high_a = low_a + lift * a.normal, high_b = low_b + lift * b.normal;
  return sees(high_a, high_b) && sees(low_a, high_a) && sees(low_b, high_b);
}

int surface_cover(const rays::SurfacePoint& point, float spacing, const SeesProbe& sees) {
  constexpr int rays = 16;
  const Frame frame = Frame::around(point.normal);
  const vec3 origin = point.position + fitted_lift * spacing * point.normal;
  int cover = 0;
  for (float length = spacing / 2; cover < most_cover; length /= 2, ++cover) {
    int blocked = 0;
    for (int i = 0; i < rays; ++i) {
      const vec2 u((static_cast<float>(i) + 0.5f) / rays, glm::fract(0.618034f * static_cast<float>(i)));
      const vec3 direction = frame.to_world(sample_cosine_hemisphere(u));
      blocked += !sees(origin, origin + length * direction);
    }
    if (4 * blocked <= 3 * rays) break;
  }
  return cover;
}

float cover_factor(int cover, float distance2, float spacing) {
  if (cover == 0) return 1;
  const float open = spacing / static_cast<float>(1 << cover), q = distance2 / (open * open);
  return 1 / (1 + q * q);
}

SurfaceInterpolation::SurfaceInterpolation(std::span<const rays::SurfacePoint> points, SeesProbe sees)
    : position_(positions_of(points)),
      near_(position_),
      spacing_(surface_spacing(points)),
      sees_(std::move(sees)) {
  require(sees_ != nullptr, "surface points", "nothing tells what sees them");
  for (const rays::SurfacePoint& point : points) normal_.emplace_back(glm::round(32767.0f * point.normal));
  cover_.resize(points.size());
  if (!std::isfinite(spacing_)) return;
  parallel_for(points.size(), 64, [&](std::size_t i) {
    cover_[i] = static_cast<std::uint8_t>(surface_cover(points[i], spacing_, sees_));
  });
}

std::span<const SurfaceShare> SurfaceInterpolation::at(const rays::SurfacePoint& at,
                                                       SurfaceShares& shares) const {
  if (at.moves) return {};
  const vec3 &x = at.position, &n = at.normal;
  const float radius = 4 * spacing_;
  std::array<geometry::Near, most_surface_points> near;
  const int count = near_.find(x, near, radius);
  const Frame frame = Frame::around(n);
  // Points fade out toward the farthest that is looked at.
  const float reach = count == static_cast<int>(most_surface_points)
                          ? std::sqrt(near[most_surface_points - 1].distance2) * 1.0001f
                          : radius;
  Places places;
  std::size_t used = 0;
  float total = 0;
  for (int i = 0; i < count; ++i) {
    const geometry::Near& found = near[static_cast<std::size_t>(i)];
    const auto p = static_cast<std::size_t>(found.index);
    const vec3 other = position_[p], other_normal = vec3(normal_[p]) / 32767.0f;
    const float cosine = glm::dot(other_normal, n);
    const vec3 local = frame.to_local(other - x);
    const float off_plane = fitted_off_plane * spacing_ + fitted_off_plane_slope * std::sqrt(found.distance2);
    if (cosine < fitted_cosine || std::abs(local.z) > off_plane) continue;
    if (found.distance2 > 1e-6f * spacing_ * spacing_ &&
        !see_along_surface({x, n}, {other, other_normal}, spacing_, sees_))
      continue;
    const float t = 1 - found.distance2 / (reach * reach);
    const float weight = t * t * cosine * cover_factor(cover_[p], found.distance2, spacing_);
    shares[used] = {static_cast<std::uint32_t>(p), weight};
    places[used++] = vec3(1, local.x / spacing_, local.y / spacing_);
    total += weight;
  }
  if (!(total > 0)) return {};
  const std::span<SurfaceShare> found(shares.data(), used);
  fit_linearly(found, places, total);
  return found;
}

bool SurfaceInterpolation::irradiance(const rays::SurfacePoint& at, std::span<const RecordLight> light,
                                      vec3& out) const {
  require(light.size() == count(), "surface records", "not every point has its light");
  SurfaceShares storage;
  const std::span<const SurfaceShare> shares = this->at(at, storage);
  if (shares.empty()) return false;
  RecordLight sum(0);
  for (const SurfaceShare& share : shares) sum += share.weight * light[share.point];
  out = glm::max(sum * vec4(at.normal, 1), vec3(0));
  return true;
}

std::size_t SurfaceInterpolation::bytes() const {
  return count() * (sizeof(position_[0]) + sizeof(normal_[0]) + sizeof(cover_[0])) + near_.bytes();
}

}  // namespace ssphh::probes
