#include "fitted_lookup_weights.h"

#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>

namespace ssphh::gi {
namespace {

constexpr std::size_t most_near = 24;

FittedPoints with_weights(const FittedPoints& fitted, std::size_t probe_count) {
  FittedPoints kept;
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    for (const ProbeWeight& weight : fitted.weights[i].used()) {
      if (weight.probe < 0 || static_cast<std::size_t>(weight.probe) >= probe_count)
        throw Error(fmt::format("fitted point {}", i),
                    fmt::format("it names probe {}, which there is not", weight.probe));
    }
    if (fitted.weights[i].count == 0) continue;
    kept.points.push_back(fitted.points[i]);
    kept.weights.push_back(fitted.weights[i]);
  }
  return kept;
}

std::vector<vec3> positions_of(const FittedPoints& fitted) {
  std::vector<vec3> positions;
  for (const scene::SurfacePoint& point : fitted.points) positions.push_back(point.position);
  return positions;
}

/// A fitted point that serves, and how much.
struct Share {
  std::size_t point;
  float weight;
  vec3 place;  ///< 1 and the tangential offset in spacings
};

/// Turns the weights into those of a linear fit's value at x.
void fit_linearly(std::span<Share> shares) {
  mat3 gram(0);
  float total = 0;
  for (const Share& s : shares) {
    for (int c = 0; c < 3; ++c) gram[c] += s.weight * s.place[c] * s.place;
    total += s.weight;
  }
  constexpr float ridge = 0.05f;
  gram[1][1] += ridge * total;
  gram[2][2] += ridge * total;
  const vec3 row = glm::inverse(gram)[0];
  constexpr float lowest = -0.25f;
  float most = 1;  // of the way from the mean to the fit
  for (const Share& s : shares) {
    const float relative = total * glm::dot(row, s.place);  // 1: as in the mean
    if (relative < lowest) most = std::min(most, (1 - lowest) / (1 - relative));
  }
  float sum = 0;
  for (Share& s : shares) {
    s.weight *= (1 - most) / total + most * glm::dot(row, s.place);
    sum += s.weight;
  }
  for (Share& s : shares) s.weight /= sum;  // the ridge leaves it at 1 but for rounding
}

/// Σ of the points' weights by probe; the largest where there are too many, at the same sum.
ProbeWeights join(const FittedPoints& fitted, std::span<const Share> shares) {
  std::array<ProbeWeight, most_near * max_weights> all;
  std::size_t count = 0;
  for (const Share& share : shares) {
    for (const ProbeWeight& entry : fitted.weights[share.point].used())
      all[count++] = {entry.probe, share.weight * entry.weight};
  }
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(count);
  std::stable_sort(all.begin(), end,
                   [](const ProbeWeight& a, const ProbeWeight& b) { return a.probe < b.probe; });
  std::size_t joined = 0;
  for (std::size_t i = 1; i < count; ++i) {
    if (all[i].probe == all[joined].probe) {
      all[joined].weight += all[i].weight;
    } else {
      all[++joined] = all[i];
    }
  }
  ++joined;
  ProbeWeights out;
  const auto first = all.begin(), last = first + static_cast<std::ptrdiff_t>(joined);
  const std::size_t kept = std::min(joined, out.entries.size());
  float scale = 1;
  if (kept < joined) {
    float before = 0, after = 0;
    std::for_each(first, last, [&](const ProbeWeight& w) { before += w.weight; });
    std::stable_sort(first, last, [](const ProbeWeight& a, const ProbeWeight& b) {
      return std::abs(a.weight) > std::abs(b.weight);
    });
    for (std::size_t i = 0; i < kept; ++i) after += all[i].weight;
    if (after > 0) scale = before / after;
  }
  for (std::size_t i = 0; i < kept; ++i) out.add(all[i].probe, scale * all[i].weight);
  return out;
}

}  // namespace

FittedLookupWeights::FittedLookupWeights(const FittedPoints& fitted, std::size_t probe_count, SeesProbe sees,
                                         std::unique_ptr<LookupWeights> elsewhere)
    : points_(with_weights(fitted, probe_count)),
      near_(positions_of(points_)),
      spacing_(median_spacing(positions_of(points_))),
      sees_(std::move(sees)),
      elsewhere_(std::move(elsewhere)) {}

ProbeWeights FittedLookupWeights::at(const scene::SurfacePoint& point) const {
  if (point.moves) return elsewhere_->at(point);
  const vec3 &x = point.position, &n = point.normal;
  const float radius = 4 * spacing_;
  std::array<Near, most_near> near;
  const int count = near_.find(x, near, radius);
  const Frame frame = Frame::around(n);
  const float lift = 0.02f * spacing_;
  // Points fade out toward the farthest that is looked at.
  const float reach =
      count == static_cast<int>(most_near) ? std::sqrt(near[most_near - 1].distance2) * 1.0001f : radius;
  std::array<Share, most_near> shares;
  std::size_t used = 0;
  for (int i = 0; i < count; ++i) {
    const Near& found = near[static_cast<std::size_t>(i)];
    const auto p = static_cast<std::size_t>(found.index);
    const scene::SurfacePoint& other = points_.points[p];
    const float cosine = glm::dot(other.normal, n);
    const vec3 local = frame.to_local(other.position - x);
    if (cosine < 0.7f || std::abs(local.z) > 0.5f * spacing_ + 0.1f * std::sqrt(found.distance2)) continue;
    if (found.distance2 > 1e-6f * spacing_ * spacing_ &&
        !sees_(x + lift * n, other.position + lift * other.normal))
      continue;
    const float t = 1 - found.distance2 / (reach * reach);
    shares[used++] = {p, t * t * cosine, vec3(1, local.x / spacing_, local.y / spacing_)};
  }
  const std::span<Share> found(shares.data(), used);
  float total = 0;
  for (const Share& s : found) total += s.weight;
  if (!(total > 0)) return elsewhere_->at(point);
  fit_linearly(found);
  return join(points_, found);
}

}  // namespace ssphh::gi
