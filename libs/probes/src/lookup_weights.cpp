#include <algorithm>
#include <cmath>

#include <ssphh/core/error.h>
#include <ssphh/core/require_named.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/lookup_weights.h>

#include "fitted_lookup_weights.h"
#include "probe_sight.h"

namespace ssphh::probes {
namespace {

using NearList = ProbeSight::NearList;

/// The method `distance`, which also serves where the others find nothing.
class DistanceWeights : public VisibleWeights {
 public:
  DistanceWeights(std::span<const vec3> positions, const WeightParams& params)
      : sight_(positions, params), wanted_(std::clamp(params.nearest, 1, max_weights)) {}
  std::size_t bytes() const override { return sight_.bytes(); }

  ProbeWeights at(const rays::SurfacePoint& at, const SeesProbe& sees) const override {
    const vec3 &x = at.position, &n = at.normal;
    NearList near;
    const int count = sight_.nearest(x, near);
    int visible = sight_.visible_first(near, count, wanted_, at, sees);
    const bool none_seen = visible == 0;
    if (none_seen) {
      std::sort(near.begin(), near.begin() + count);
      visible = std::min(count, wanted_);
    }
    float nearest2 = near[0].distance2;
    for (int i = 1; i < visible; ++i) nearest2 = std::min(nearest2, near[i].distance2);
    ProbeWeights out;
    for (int i = 0; i < visible; ++i) {
      const geometry::Near& probe = near[i];
      out.add(probe.index, distance_weight(probe, nearest2, x, n));
    }
    normalise(out);
    if (none_seen) {
      for (ProbeWeight& entry : out.used()) entry.weight *= hidden_share(sight_.cosine(entry.probe, x, n));
    }
    return out;
  }

 protected:
  static void normalise(ProbeWeights& weights) {
    float sum = 0;
    for (const ProbeWeight& entry : weights.used()) sum += entry.weight;
    for (ProbeWeight& entry : weights.used()) entry.weight /= sum;
  }

  ProbeSight sight_;
  int wanted_;

 private:
  /// What a hidden probe that stands in for visible ones keeps of its weight: nothing below the tangent
  /// plane, for on the far side of a roof or wall there is another room's light.
  static float hidden_share(float cosine) { return std::clamp(hidden_slope * cosine, 0.0f, 1.0f); }

  /// Inverse squared distance, relative to the nearest so that nothing overflows, times a wrapped cosine
  /// (Majercik et al., Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields, JCGT 2019): a
  /// probe behind the surface sees the light of other surfaces.
  float distance_weight(const geometry::Near& probe, float nearest2, const vec3& x, const vec3& n) const {
    if (!(probe.distance2 > 0)) return 1;
    const float wrapped = 0.5f * (1 + sight_.cosine(probe.index, x, n));
    return nearest2 / probe.distance2 * (wrapped * wrapped + wrapped_floor);
  }
};

class TrilinearWeights final : public DistanceWeights {
 public:
  using DistanceWeights::DistanceWeights;
  ProbeWeights at(const rays::SurfacePoint& point, const SeesProbe& sees) const override {
    const vec3& x = point.position;
    const float spacing = sight_.spacing();
    // A cell's corners lie within √3 spacings, as do up to 27 probes of a grid.
    std::array<geometry::Near, 27> near;
    const int count = sight_.nearest(x, near, std::sqrt(3.0f) * spacing);
    ProbeWeights out;
    for (int i = 0; i < count && out.count < max_weights; ++i) {
      const geometry::Near& probe = near[i];
      const vec3 tent = 1.0f - glm::abs(sight_.position(probe.index) - x) / spacing;
      if (!(std::min({tent.x, tent.y, tent.z}) > least_tent) || !sight_.sees(probe, point, sees)) continue;
      out.add(probe.index, tent.x * tent.y * tent.z);
    }
    if (out.count == 0) return DistanceWeights::at(point, sees);
    normalise(out);
    return out;
  }
};

class MlsWeights final : public DistanceWeights {
 public:
  using DistanceWeights::DistanceWeights;
  ProbeWeights at(const rays::SurfacePoint& point, const SeesProbe& sees) const override {
    const vec3& x = point.position;
    NearList near;
    const float radius = mls_reach * sight_.spacing();
    const int count = sight_.nearest(x, near, radius);
    const int visible = sight_.visible_first(near, count, count, point, sees);
    if (visible == 0) return DistanceWeights::at(point, sees);

    // Fit a + b·(p − x) to the probes, weighted by a bump of two spacings; the value at x is a. A ridge on b
    // keeps the fit flat along directions in which the probes do not differ.
    std::array<vec4, max_weights> place;
    std::array<float, max_weights> bump;
    mat4 normal_matrix(0);
    float total = 0;
    for (int i = 0; i < visible; ++i) {
      const auto k = static_cast<std::size_t>(i);
      place[k] = vec4(1, (sight_.position(near[k].index) - x) / sight_.spacing());
      const float t = std::max(0.0f, 1 - near[k].distance2 / (radius * radius));
      bump[k] = t * t + mls_least_bump;
      total += bump[k];
      for (int c = 0; c < 4; ++c) normal_matrix[c] += bump[k] * place[k][c] * place[k];
    }
    for (int c = 1; c < 4; ++c) normal_matrix[c][c] += mls_ridge * total;
    const vec4 first_row = glm::inverse(normal_matrix)[0];
    ProbeWeights out;
    for (int i = 0; i < visible; ++i) {
      const auto k = static_cast<std::size_t>(i);
      out.add(near[k].index, bump[k] * glm::dot(first_row, place[k]));
    }
    normalise(out);
    return out;
  }
};

/// One probe has no spacing: it counts everywhere.
bool has_spacing(std::span<const vec3> positions, const WeightParams& params) {
  return params.spacing > 0 || std::isfinite(median_spacing(positions));
}

/// The chosen method, or what stands in for one that needs more than probes.
WeightMethod method_of_probes(const WeightParams& params) {
  for (const WeightMethod method : {params.chosen(false), params.fallback})
    if (method != WeightMethod::fitted && method != WeightMethod::surface) return method;
  return WeightMethod::mls;
}

/// Visible weights of which every point is asked with the same sight.
class SeenWeights final : public LookupWeights {
 public:
  SeenWeights(std::unique_ptr<VisibleWeights> weights, SeesProbe sees)
      : weights_(std::move(weights)), sees_(std::move(sees)) {}
  ProbeWeights at(const rays::SurfacePoint& point) const override { return weights_->at(point, sees_); }
  std::size_t bytes() const override { return weights_->bytes(); }

 private:
  std::unique_ptr<VisibleWeights> weights_;
  SeesProbe sees_;
};

}  // namespace

WeightParams weights_named(const std::string& name) {
  WeightParams params;
  if (!name.empty()) params.method = enum_named<WeightMethod>("weights", name);
  return params;
}

float median_spacing(std::span<const vec3> positions) {
  const geometry::NearestPoints nearest(positions);
  std::vector<float> distance;
  for (const vec3& p : positions) {
    // Probes in one place say nothing of the spacing.
    std::array<geometry::Near, max_weights> near;
    const int count = nearest.find(p, near);
    float found = std::numeric_limits<float>::infinity();
    for (int i = count - 1; i >= 0; --i) {
      if (near[i].distance2 > 0) found = std::sqrt(near[i].distance2);
    }
    distance.push_back(found);
  }
  if (distance.empty()) return std::numeric_limits<float>::infinity();
  const auto middle = distance.begin() + static_cast<std::ptrdiff_t>(distance.size() / 2);
  std::nth_element(distance.begin(), middle, distance.end());
  return *middle;
}

std::unique_ptr<VisibleWeights> make_visible_weights(std::span<const vec3> positions,
                                                     const WeightParams& params) {
  if (positions.empty()) throw Error("probe lookup", "the probe set is empty", "bake a scene with SPHLs");
  require(std::ranges::all_of(positions, is_finite), "probe lookup", "a probe's position is not finite");
  require(params.spacing >= 0 && std::isfinite(params.spacing) && params.normal_offset >= 0 &&
              std::isfinite(params.normal_offset),
          "probe lookup", "spacing and normal offset must be lengths");
  const WeightMethod method = method_of_probes(params);
  require_named("lookup weights", method);
  if (method == WeightMethod::distance || !has_spacing(positions, params))
    return std::make_unique<DistanceWeights>(positions, params);
  if (method == WeightMethod::trilinear) return std::make_unique<TrilinearWeights>(positions, params);
  return std::make_unique<MlsWeights>(positions, params);
}

std::unique_ptr<LookupWeights> make_weights(std::span<const vec3> positions, SeesProbe sees,
                                            const WeightParams& params, const FittedPoints* fitted) {
  require(sees != nullptr, "probe lookup", "nothing tells what sees the probes");
  auto around = std::make_unique<SeenWeights>(make_visible_weights(positions, params), sees);
  const WeightMethod method = params.chosen(fitted != nullptr);
  if (method == WeightMethod::fitted && !fitted)
    throw Error("probe lookup", "there are no fitted weights", "fit some, or choose others");
  if (!fitted || (method != WeightMethod::fitted && method != WeightMethod::surface)) return around;
  return std::make_unique<FittedLookupWeights>(*fitted, positions.size(), std::move(sees), std::move(around));
}

}  // namespace ssphh::probes
