#include "fitted_lookup_weights.h"

#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/probe_limits.h>

namespace ssphh::probes {
namespace {

/// Sums weights by probe, in the order in which probes first come.
class SumByProbe {
 public:
  SumByProbe() { slots_.fill(none); }
  void add(int probe, float weight) {
    std::size_t slot = static_cast<std::size_t>(probe) % slots_.size();
    while (slots_[slot] != none && sums_[slots_[slot]].probe != probe) slot = (slot + 1) % slots_.size();
    if (slots_[slot] == none) {
      slots_[slot] = static_cast<std::uint16_t>(count_);
      sums_[count_++] = {probe, 0};
    }
    sums_[slots_[slot]].weight += weight;
  }
  std::span<ProbeWeight> sums() { return {sums_.data(), count_}; }

 private:
  static constexpr std::uint16_t none = 0xffff;
  std::array<std::uint16_t, 256> slots_;  ///< of an open hash table that is never full
  std::array<ProbeWeight, most_fitted_points * max_weights> sums_;
  static_assert(std::tuple_size_v<decltype(sums_)> < std::tuple_size_v<decltype(slots_)>);
  std::size_t count_ = 0;
};

}  // namespace

void require_whole(const FittedPoints& fitted, std::size_t probe_count) {
  require(fitted.weights.size() == fitted.points.size(), "fitted points", "not every point has its weights");
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    const auto fail = [i](const std::string& problem) {
      throw Error(fmt::format("fitted point {}", i), problem);
    };
    if (!is_finite(fitted.points[i].position) || !is_finite(fitted.points[i].normal))
      fail("its place is not finite");
    const int count = fitted.weights[i].count;
    if (count < 0 || count > max_weights)
      fail(fmt::format("it has {} weights, not 0..{}", count, max_weights));
    for (const ProbeWeight& entry : fitted.weights[i].used()) {
      if (entry.probe < 0 || static_cast<std::size_t>(entry.probe) >= probe_count)
        fail(fmt::format("it names probe {}, which there is not", entry.probe));
      if (!std::isfinite(entry.weight)) fail("a weight is not finite");
    }
  }
}

FittedLookupWeights::Points::Points(const FittedPoints& fitted, std::size_t probe_count) {
  static_assert(limits::probes <= 65536);
  require_whole(fitted, std::min(probe_count, limits::probes));
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    const std::span<const ProbeWeight> weights = fitted.weights[i].used();
    if (weights.empty()) continue;
    position.push_back(fitted.points[i].position);
    normal.emplace_back(glm::round(32767.0f * fitted.points[i].normal));
    begin.push_back(static_cast<std::uint32_t>(probe.size()));
    for (const ProbeWeight& entry : weights) {
      probe.push_back(static_cast<std::uint16_t>(entry.probe));
      weight.push_back(entry.weight);
    }
  }
  begin.push_back(static_cast<std::uint32_t>(probe.size()));
}

/// Turns the weights into those of a linear fit's value at x.
void FittedLookupWeights::fit_linearly(std::span<Share> shares) {
  mat3 gram(0);
  float total = 0;
  for (const Share& s : shares) {
    for (int c = 0; c < 3; ++c) gram[c] += s.weight * s.place[c] * s.place;
    total += s.weight;
  }
  gram[1][1] += fitted_ridge * total;
  gram[2][2] += fitted_ridge * total;
  const vec3 row = glm::inverse(gram)[0];
  float most = 1;  // of the way from the mean to the fit
  for (const Share& s : shares) {
    const float relative = total * glm::dot(row, s.place);  // 1: as in the mean
    if (relative < fitted_lowest) most = std::min(most, (1 - fitted_lowest) / (1 - relative));
  }
  float sum = 0;
  for (Share& s : shares) {
    s.weight *= (1 - most) / total + most * glm::dot(row, s.place);
    sum += s.weight;
  }
  for (Share& s : shares) s.weight /= sum;  // the ridge leaves it at 1 but for rounding
}

/// Σ of the points' weights by probe; the largest where there are too many, at the same sum.
ProbeWeights FittedLookupWeights::join(std::span<const Share> shares) const {
  SumByProbe by_probe;
  for (const Share& share : shares) {
    for (std::uint32_t i = points_.begin[share.point]; i < points_.begin[share.point + 1]; ++i)
      by_probe.add(points_.probe[i], share.weight * points_.weight[i]);
  }
  const std::span<ProbeWeight> all = by_probe.sums();
  ProbeWeights out;
  const std::size_t kept = std::min(all.size(), out.entries.size());
  float scale = 1;
  if (kept < all.size()) {
    float before = 0, after = 0;
    for (const ProbeWeight& w : all) before += w.weight;
    std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(kept),
                             [](const ProbeWeight& a, const ProbeWeight& b) {
                               const float wa = std::abs(a.weight), wb = std::abs(b.weight);
                               return wa > wb || (wa == wb && a.probe < b.probe);
                             });
    for (const ProbeWeight& w : all.first(kept)) after += w.weight;
    if (after > 0) scale = before / after;
  }
  for (const ProbeWeight& w : all.first(kept)) out.add(w.probe, scale * w.weight);
  return out;
}

FittedLookupWeights::FittedLookupWeights(const FittedPoints& fitted, std::size_t probe_count, SeesProbe sees,
                                         std::unique_ptr<LookupWeights> elsewhere)
    : points_(fitted, probe_count),
      near_(points_.position),
      spacing_(median_spacing(points_.position)),
      sees_(std::move(sees)),
      elsewhere_(std::move(elsewhere)) {}

ProbeWeights FittedLookupWeights::at(const rays::SurfacePoint& point) const {
  if (point.moves) return elsewhere_->at(point);
  const vec3 &x = point.position, &n = point.normal;
  const float radius = 4 * spacing_;
  std::array<geometry::Near, most_fitted_points> near;
  const int count = near_.find(x, near, radius);
  const Frame frame = Frame::around(n);
  const float lift = 0.02f * spacing_;
  // Points fade out toward the farthest that is looked at.
  const float reach = count == static_cast<int>(most_fitted_points)
                          ? std::sqrt(near[most_fitted_points - 1].distance2) * 1.0001f
                          : radius;
  std::array<Share, most_fitted_points> shares;
  std::size_t used = 0;
  for (int i = 0; i < count; ++i) {
    const geometry::Near& found = near[static_cast<std::size_t>(i)];
    const auto p = static_cast<std::size_t>(found.index);
    const vec3 other = points_.position[p], other_normal = vec3(points_.normal[p]) / 32767.0f;
    const float cosine = glm::dot(other_normal, n);
    const vec3 local = frame.to_local(other - x);
    const float off_plane = fitted_off_plane * spacing_ + fitted_off_plane_slope * std::sqrt(found.distance2);
    if (cosine < fitted_cosine || std::abs(local.z) > off_plane) continue;
    if (found.distance2 > 1e-6f * spacing_ * spacing_ && !sees_(x + lift * n, other + lift * other_normal))
      continue;
    const float t = 1 - found.distance2 / (reach * reach);
    shares[used++] = {p, t * t * cosine, vec3(1, local.x / spacing_, local.y / spacing_)};
  }
  const std::span<Share> found(shares.data(), used);
  float total = 0;
  for (const Share& s : found) total += s.weight;
  if (!(total > 0)) return elsewhere_->at(point);
  fit_linearly(found);
  return join(found);
}

std::size_t FittedLookupWeights::bytes() const {
  const Points& p = points_;
  return p.position.size() * (sizeof(p.position[0]) + sizeof(p.normal[0])) +
         p.begin.size() * sizeof(p.begin[0]) + p.probe.size() * (sizeof(p.probe[0]) + sizeof(p.weight[0])) +
         near_.bytes() + elsewhere_->bytes();
}

}  // namespace ssphh::probes
