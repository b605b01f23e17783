#include <algorithm>
#include <cmath>
#include <limits>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/surface_interpolation.h>

#include "surface_shares.h"

namespace ssphh::probes {
namespace {

/// What a lookup leaves out, of its whole weight.
constexpr float left_out = 0.001f;
/// Spacings between which sight of the one's height tells nothing of the other's.
constexpr float much_coarser = 64;

/// 1 and the tangential offset, of each share.
using Places = std::array<vec3, most_surface_points>;

/// Turns the weights, of sum `total`, into those of a linear fit's value at x. Only their ratios count: a
/// lone point at the border of its reach has next to no weight. `ridge` in the places' unit, squared.
void fit_linearly(std::span<SurfaceShare> shares, const Places& places, float total, float ridge) {
  mat3 gram(0);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i].weight /= total;
    for (int c = 0; c < 3; ++c) gram[c] += shares[i].weight * places[i][c] * places[i];
  }
  gram[1][1] += ridge;
  gram[2][2] += ridge;
  const vec3 row = glm::inverse(gram)[0];
  float negative = 0;
  for (std::size_t i = 0; i < shares.size(); ++i)
    negative += shares[i].weight * std::max(-glm::dot(row, places[i]), 0.0f);
  const float most = std::min(1.0f, fitted_negative / negative);  // of the way from the mean to the fit
  float sum = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i].weight *= 1 - most + most * glm::dot(row, places[i]);
    sum += shares[i].weight;
  }
  for (SurfaceShare& s : shares) s.weight /= sum;  // the ridge leaves it at 1 but for rounding
}

}  // namespace

geometry::Balls surface_reach(std::span<const rays::SurfacePoint> points, std::span<const float> spacings) {
  require(points.size() == spacings.size(), "surface points", "there is not one spacing for each");
  std::vector<vec3> centres;
  std::vector<float> radii;
  for (std::size_t i = 0; i < points.size(); ++i) {
    centres.push_back(points[i].position);
    radii.push_back(fitted_reach * spacings[i]);
  }
  return {centres, radii};
}

float headroom(const rays::SurfacePoint& point, float most, float least, const SeesProbe& sees) {
  require(sees != nullptr, "surface points", "nothing tells what sees them");
  constexpr float lower = 0.7f;
  const vec3 low = point.position + least * point.normal;
  for (float lift = most; lift > least; lift *= lower)
    if (sees(low, point.position + lift * point.normal)) return lift;
  return 0;
}

bool see_along_surface(const rays::SurfacePoint& a, const rays::SurfacePoint& b, float spacing, float room,
                       const SeesProbe& sees) {
  require(sees != nullptr, "surface points", "nothing tells what sees them");
  const auto see_each_other = [&](float lift) {
    return sees(a.position + lift * a.normal, b.position + lift * b.normal);
  };
  const float least = fitted_lift * spacing;
  // Between points of a sphere the surface rises to an eighth of what their normals part.
  const float bulge = glm::dot(b.normal - a.normal, b.position - a.position);
  const float over_bulge = fitted_lift_over_bulges * bulge;
  if (!(over_bulge > 0.1f * least) && see_each_other(least)) {
    const float high = std::min(fitted_roof * spacing, room);
    return !(high > least) || see_each_other(high);
  }
  const float high = least + std::max(over_bulge, fitted_hop * spacing);
  const auto rises = [&](const rays::SurfacePoint& point) {
    return sees(point.position + least * point.normal, point.position + high * point.normal);
  };
  return see_each_other(high) && rises(a) && rises(b);
}

int surface_cover(const rays::SurfacePoint& point, float spacing, const SeesProbe& sees) {
  require(sees != nullptr, "surface points", "nothing tells what sees them");
  constexpr int rays = 16;
  const Frame frame = Frame::around(point.normal);
  const auto blocked = [&](float lift, float length) {
    const vec3 origin = point.position + lift * point.normal;
    int count = 0;
    for (int i = 0; i < rays; ++i) {
      const vec2 u((static_cast<float>(i) + 0.5f) / rays, glm::fract(0.618034f * static_cast<float>(i)));
      count += !sees(origin, origin + length * frame.to_world(sample_cosine_hemisphere(u)));
    }
    return count;
  };
  // A kerb beside the point, unlike a wall, is no more in the way a little higher
  const auto by_a_kerb = [&](float length) {
    const float near = length / 8;
    const int low = blocked(2 * fitted_lift * near, near);
    return 8 * low >= 3 * rays && 2 * blocked(length / 4, length) <= low;
  };
  int cover = 0;
  for (float length = spacing / 2; cover < most_cover; length /= 2, ++cover) {
    if (4 * blocked(fitted_lift * spacing, length) <= 3 * rays && !by_a_kerb(length)) break;
  }
  return cover;
}

SurfaceInterpolation::SurfaceInterpolation(std::span<const rays::SurfacePoint> points, SeesProbe sees)
    : SurfaceInterpolation(points, surface_spacings(points), std::move(sees)) {}

SurfaceInterpolation::SurfaceInterpolation(std::span<const rays::SurfacePoint> points,
                                           std::span<const float> spacings, SeesProbe sees)
    : points_(points.size()), reach_(surface_reach(points, spacings)), sees_(std::move(sees)) {
  require(sees_ != nullptr, "surface points", "nothing tells what sees them");
  parallel_for(points.size(), 64, [&](std::size_t i) {
    const int cover = spacings[i] > 0 ? surface_cover(points[i], spacings[i], sees_) : 0;
    const float most = fitted_roof * spacings[i];
    const float room = most > 0 ? headroom(points[i], most, fitted_lift * spacings[i], sees_) / most : 0;
    points_[i] = {points[i].position, spacings[i], glm::round(32767.0f * points[i].normal),
                  static_cast<std::uint8_t>(cover), static_cast<std::uint8_t>(255 * room)};
  });
}

SurfaceInterpolation::Candidates SurfaceInterpolation::candidates(const rays::SurfacePoint& at,
                                                                  SurfaceShares& shares,
                                                                  std::uint32_t without) const {
  Candidates found;
  if (at.moves) return found;
  const vec3 &x = at.position, &n = at.normal;
  // Those that count most, sorted
  std::size_t& count = found.count;
  const auto before = [](const SurfaceShare& a, const SurfaceShare& b) {
    return a.weight > b.weight || (a.weight == b.weight && a.point < b.point);
  };
  reach_.visit(x, [&](std::uint32_t p, float distance2) {
    if (p == without) return;
    const Point& point = points_[p];
    const float spacing = point.spacing, cosine = glm::dot(vec3(point.normal), n) / 32767.0f;
    if (!(cosine > fitted_cosine)) return;  // most of a room's, before what a share costs
    const float by_surface =
        share_by_surface(std::sqrt(distance2), glm::dot(point.position - x, n), cosine, spacing);
    if (by_surface == 0) return;
    const SurfaceShare share{p, by_surface * share_by_distance(distance2, spacing) *
                                    cover_factor(point.cover, distance2, spacing)};
    if (count == shares.size() && !before(share, shares.back())) return;
    std::size_t i = count < shares.size() ? count++ : count - 1;
    for (; i > 0 && before(share, shares[i - 1]); --i) shares[i] = shares[i - 1];
    shares[i] = share;
  });
  for (std::size_t i = 0; i < count; ++i) {
    const float spacing = points_[shares[i].point].spacing;
    found.finest = std::min(found.finest, spacing), found.coarsest = std::max(found.coarsest, spacing);
  }
  return found;
}

template <class Counts>
std::span<const SurfaceShare> SurfaceInterpolation::fitted(const rays::SurfacePoint& at, std::size_t count,
                                                           SurfaceShares& shares,
                                                           const Counts& counts) const {
  float left = 0;
  for (std::size_t i = 0; i < count; ++i) left += shares[i].weight;
  const Frame frame = Frame::around(at.normal);
  Places places;
  std::size_t used = 0;
  float total = 0, per_spacing = 0, unit = 0;
  for (std::size_t i = 0; i < count && left > left_out * total; ++i) {
    const SurfaceShare share = shares[i];
    const Point& point = points_[share.point];
    left -= share.weight;
    if (!counts(point)) continue;
    if (used == 0) unit = point.spacing;
    const vec3 local = frame.to_local(point.position - at.position) / unit;
    shares[used] = share;
    places[used++] = vec3(1, local.x, local.y);
    total += share.weight;
    per_spacing += share.weight / point.spacing;
  }
  if (!(total > 0)) return {};
  const std::span<SurfaceShare> found(shares.data(), used);
  const float mean = total / per_spacing;
  float square = 0;
  total = 0;
  for (SurfaceShare& share : found) {
    const Point& point = points_[share.point];
    const vec3 offset = point.position - at.position;
    share.weight *= share_beside_finer(glm::dot(offset, offset), mean);
    total += share.weight;
    square += share.weight * point.spacing * point.spacing;
  }
  fit_linearly(found, places, total, fitted_ridge * square / (total * unit * unit));
  return found;
}

std::span<const SurfaceShare> SurfaceInterpolation::at(const rays::SurfacePoint& at, SurfaceShares& shares,
                                                       std::uint32_t without) const {
  const Candidates found = candidates(at, shares, without);
  // How high the place can rise, for the coarsest of them and the finest
  const float low = fitted_lift * found.finest;
  const float room = found.count > 0 ? headroom(at, fitted_roof * found.coarsest, low, sees_) : 0;
  return fitted(at, found.count, shares, [&](const Point& point) {
    const float spacing = point.spacing;
    // One of a wide plain would look over the place's head: into a pot that stands on a table
    if (spacing > much_coarser * found.finest && fitted_lift * spacing > std::max(low, room)) return false;
    const vec3 offset = point.position - at.position;
    if (!(glm::dot(offset, offset) > 1e-6f * spacing * spacing)) return true;
    const float above_point = static_cast<float>(point.room) / 255 * fitted_roof * spacing;
    return see_along_surface(at, {point.position, vec3(point.normal) / 32767.0f}, spacing,
                             std::min(room, above_point), sees_);
  });
}

std::span<const SurfaceShare> SurfaceInterpolation::beside(const rays::SurfacePoint& at,
                                                           SurfaceShares& shares) const {
  const Candidates found = candidates(at, shares, no_surface_point);
  if (found.count == 0 || surface_cover(at, found.finest, sees_) == 0) return {};
  return fitted(at, found.count, shares,
                [&](const Point& point) { return point.spacing <= 2 * found.finest; });
}

namespace {

bool sum_of(std::span<const SurfaceShare> shares, std::span<const RecordLight> light, const vec3& normal,
            vec3& out) {
  if (shares.empty()) return false;
  RecordLight sum(0);
  for (const SurfaceShare& share : shares) sum += share.weight * light[share.point];
  out = glm::max(sum * vec4(normal, 1), vec3(0));
  return true;
}

}  // namespace

bool SurfaceInterpolation::irradiance(const rays::SurfacePoint& at, std::span<const RecordLight> light,
                                      vec3& out) const {
  require(light.size() == count(), "surface records", "not every point has its light");
  SurfaceShares storage;
  return sum_of(this->at(at, storage), light, at.normal, out);
}

bool SurfaceInterpolation::irradiance_beside(const rays::SurfacePoint& at, std::span<const RecordLight> light,
                                             vec3& out) const {
  require(light.size() == count(), "surface records", "not every point has its light");
  SurfaceShares storage;
  return sum_of(beside(at, storage), light, at.normal, out);
}

std::size_t SurfaceInterpolation::bytes() const {
  return count() * sizeof(Point) + reach_.bytes();
}

}  // namespace ssphh::probes
