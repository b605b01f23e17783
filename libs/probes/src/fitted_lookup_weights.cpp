#include "fitted_lookup_weights.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
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
  std::array<std::uint16_t, 512> slots_;  ///< of an open hash table that is never full
  std::array<ProbeWeight, most_surface_points * max_weights> sums_;
  static_assert(std::tuple_size_v<decltype(sums_)> < std::tuple_size_v<decltype(slots_)>);
  std::size_t count_ = 0;
};

/// Those that have weights.
std::vector<rays::SurfacePoint> lit_points(const FittedPoints& fitted) {
  std::vector<rays::SurfacePoint> points;
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    if (fitted.weights[i].count > 0) points.push_back(fitted.points[i]);
  }
  return points;
}

}  // namespace

bool operator==(const FittedPoints& a, const FittedPoints& b) {
  return std::ranges::equal(a.points, b.points,
                            [](const rays::SurfacePoint& p, const rays::SurfacePoint& q) {
                              return p.position == q.position && p.normal == q.normal;
                            }) &&
         a.weights == b.weights;
}

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

FittedLookupWeights::Weights::Weights(const FittedPoints& fitted, std::size_t probe_count) {
  static_assert(limits::probes <= 65536);
  require_whole(fitted, std::min(probe_count, limits::probes));
  for (const PointWeights& weights : fitted.weights) {
    if (weights.used().empty()) continue;
    begin.push_back(static_cast<std::uint32_t>(probe.size()));
    for (const ProbeWeight& entry : weights.used()) {
      probe.push_back(static_cast<std::uint16_t>(entry.probe));
      weight.push_back(entry.weight);
    }
  }
  begin.push_back(static_cast<std::uint32_t>(probe.size()));
}

/// Σ of the points' weights by probe; the largest where there are too many, at the same sum.
ProbeWeights FittedLookupWeights::join(std::span<const SurfaceShare> shares) const {
  SumByProbe by_probe;
  for (const SurfaceShare& share : shares) {
    for (std::uint32_t i = weights_.begin[share.point]; i < weights_.begin[share.point + 1]; ++i)
      by_probe.add(weights_.probe[i], share.weight * weights_.weight[i]);
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
    : weights_(fitted, probe_count),
      points_(lit_points(fitted), std::move(sees)),
      elsewhere_(std::move(elsewhere)) {}

ProbeWeights FittedLookupWeights::at(const rays::SurfacePoint& point) const {
  SurfaceShares storage;
  const std::span<const SurfaceShare> shares = points_.at(point, storage);
  return shares.empty() ? elsewhere_->at(point) : join(shares);
}

std::size_t FittedLookupWeights::bytes() const {
  const Weights& w = weights_;
  return points_.bytes() + w.begin.size() * sizeof(w.begin[0]) +
         w.probe.size() * (sizeof(w.probe[0]) + sizeof(w.weight[0])) + elsewhere_->bytes();
}

}  // namespace ssphh::probes
