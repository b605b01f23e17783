#include <cmath>

#include <ssphh/core/require.h>
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

SurfaceInterpolation::SurfaceInterpolation(std::span<const rays::SurfacePoint> points, SeesProbe sees)
    : position_(positions_of(points)),
      near_(position_),
      spacing_(median_spacing(position_)),
      sees_(std::move(sees)) {
  require(sees_ != nullptr, "surface points", "nothing tells what sees them");
  for (const rays::SurfacePoint& point : points) normal_.emplace_back(glm::round(32767.0f * point.normal));
}

std::span<const SurfaceShare> SurfaceInterpolation::at(const rays::SurfacePoint& at,
                                                       SurfaceShares& shares) const {
  if (at.moves) return {};
  const vec3 &x = at.position, &n = at.normal;
  const float radius = 4 * spacing_;
  std::array<geometry::Near, most_surface_points> near;
  const int count = near_.find(x, near, radius);
  const Frame frame = Frame::around(n);
  const float lift = 0.02f * spacing_;
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
    if (found.distance2 > 1e-6f * spacing_ * spacing_ && !sees_(x + lift * n, other + lift * other_normal))
      continue;
    const float t = 1 - found.distance2 / (reach * reach);
    shares[used] = {static_cast<std::uint32_t>(p), t * t * cosine};
    places[used++] = vec3(1, local.x / spacing_, local.y / spacing_);
    total += t * t * cosine;
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
  return count() * (sizeof(position_[0]) + sizeof(normal_[0])) + near_.bytes();
}

}  // namespace ssphh::probes
