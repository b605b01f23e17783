#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/gi/fitted_weights.h>

#include "nearest.h"
#include "probe_table.h"

namespace ssphh::gi {
namespace {

constexpr std::size_t most_near = 24;

std::vector<vec3> positions_of(const FittedPoints& fitted) {
  std::vector<vec3> positions;
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    if (fitted.weights[i].count > 0) positions.push_back(fitted.points[i].position);
  }
  return positions;
}

}  // namespace

struct FittedLookup::Data {
  Data(const ProbeSet& set, const FittedPoints& fitted, const scene::RadianceSource& source_in,
       const LookupParams& params)
      : source(source_in),
        elsewhere(set, source_in, params),
        table(set, params),
        near_points(positions_of(fitted)),
        spacing(median_spacing(positions_of(fitted))) {
    for (std::size_t i = 0; i < fitted.points.size(); ++i) {
      for (const ProbeWeight& weight : fitted.weights[i].used()) {
        if (weight.probe < 0 || static_cast<std::size_t>(weight.probe) >= set.probes.size())
          throw Error(fmt::format("fitted point {}", i),
                      fmt::format("it names probe {}, which there is not", weight.probe));
      }
      if (fitted.weights[i].count == 0) continue;
      points.push_back(fitted.points[i]);
      weights.push_back(fitted.weights[i]);
    }
    at_own_normal.resize(points.size());
    parallel_for(points.size(), 256, [&](std::size_t begin, std::size_t end) {
      ProbeTable::Basis basis;
      for (std::size_t p = begin; p < end; ++p) {
        table.irradiance_basis(points[p].normal, basis);
        at_own_normal[p] = irradiance(p, basis);
      }
    });
  }

  /// Σ_j v_j E_j(n) with the weights of a point.
  vec3 irradiance(std::size_t point, const ProbeTable::Basis& basis) const {
    vec3 sum(0);
    for (const ProbeWeight& w : weights[point].used())
      sum += w.weight * table.irradiance(w.probe, basis.data());
    return sum;
  }

  const scene::RadianceSource& source;
  IrradianceLookup elsewhere;
  ProbeTable table;
  NearestPoints near_points;
  float spacing;
  std::vector<scene::SurfacePoint> points;  ///< those that have weights
  std::vector<ProbeWeights> weights;
  std::vector<vec3> at_own_normal;  ///< irradiance
};

FittedLookup::FittedLookup(const ProbeSet& set, const FittedPoints& fitted,
                           const scene::RadianceSource& source, const LookupParams& params)
    : data_(std::make_unique<Data>(set, fitted, source, params)) {}
FittedLookup::~FittedLookup() = default;

vec3 FittedLookup::irradiance(const vec3& x, const vec3& n) const {
  const Data& d = *data_;
  const float radius = 4 * d.spacing;
  std::array<Near, most_near> near;
  const int count = d.near_points.find(x, near, radius);
  const Frame frame = Frame::around(n);
  const float lift = 0.02f * d.spacing;
  ProbeTable::Basis basis;
  d.table.irradiance_basis(n, basis);

  // Fit a + b·(u, v) in the tangent plane; the value at x is a.
  mat3 gram(0);
  mat3 right(0);  // a column per channel
  vec3 low(std::numeric_limits<float>::infinity()), high(0);
  float total = 0;
  const float reach =
      count == static_cast<int>(most_near) ? std::sqrt(near[most_near - 1].distance2) * 1.0001f : radius;
  for (int i = 0; i < count; ++i) {
    const Near& found = near[static_cast<std::size_t>(i)];
    const auto p = static_cast<std::size_t>(found.index);
    const scene::SurfacePoint& point = d.points[p];
    const float cosine = glm::dot(point.normal, n);
    const vec3 local = frame.to_local(point.position - x);
    if (cosine < 0.7f || std::abs(local.z) > 0.5f * d.spacing + 0.1f * std::sqrt(found.distance2)) continue;
    if (found.distance2 > 1e-6f * d.spacing * d.spacing &&
        !d.source.visible(x + lift * n, point.position + lift * point.normal))
      continue;
    const float t = 1 - found.distance2 / (reach * reach);
    const float weight = t * t * cosine;
    const vec3 place(1, local.x / d.spacing, local.y / d.spacing);
    // On curved surfaces the point's weights serve, with the normal asked for.
    const vec3 e = cosine > 0.9999f ? d.at_own_normal[p] : d.irradiance(p, basis);
    for (int c = 0; c < 3; ++c) gram[c] += weight * place[c] * place;
    for (int c = 0; c < 3; ++c) right[c] += weight * e[c] * place;
    low = glm::min(low, e);
    high = glm::max(high, e);
    total += weight;
  }
  if (!(total > 0)) return d.elsewhere.irradiance(x, n);
  constexpr float ridge = 0.05f;
  gram[1][1] += ridge * total;
  gram[2][2] += ridge * total;
  const vec3 first_row = glm::inverse(gram)[0];
  const vec3 fit(glm::dot(first_row, right[0]), glm::dot(first_row, right[1]), glm::dot(first_row, right[2]));
  return glm::clamp(fit, low, high);
}

vec3 FittedLookup::glossy(const vec3& x, const vec3& n, const vec3& r, float roughness) const {
  return data_->elsewhere.glossy(x, n, r, roughness);
}

}  // namespace ssphh::gi
