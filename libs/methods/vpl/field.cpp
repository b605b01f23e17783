#include "field.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/geometry/nearest.h>

namespace ssphh::methods::vpl {
namespace {

constexpr std::size_t shadow_batch = 512;

}  // namespace

VplField::VplField(std::vector<Vpl> lights, const rays::PosedWorld& surfaces, const VplParams& params,
                   float cluster_error)
    : lights_(std::move(lights)),
      surfaces_(surfaces),
      params_(params),
      cluster_error_(cluster_error),
      lift_(1e-4f * surfaces.bounds().radius()) {
  if (cluster_error > 0) tree_ = build_light_tree(lights_);
}

/// Sum over all lights of of(light) · power/π where a shadow ray gets through.
template <class Transfer>
vec3 VplField::gather(const rays::SurfacePoint& at, const Transfer& of) const {
  const vec3 start = at.position + lift_ * at.normal;
  std::vector<rays::RayQuery> segments;
  std::vector<vec3> arriving;
  std::vector<std::uint8_t> blocked;
  vec3 sum(0);
  const auto flush = [&] {
    blocked.resize(segments.size());
    surfaces_.occluded(segments, blocked);
    for (std::size_t i = 0; i < segments.size(); ++i) sum += blocked[i] ? vec3(0) : arriving[i];
    segments.clear(), arriving.clear();
  };
  for (const Vpl& light : lights_) {
    const float share = of(light);
    if (!(share > 0)) continue;
    segments.push_back({start, light.position - start, 1});
    arriving.push_back(share / pi * light.power);
    if (segments.size() == shadow_batch) flush();
  }
  flush();
  return sum;
}

vec3 VplField::irradiance(const rays::SurfacePoint& at) const {
  const Receiver receiver{at.position, at.normal};
  if (!tree_.empty()) {
    return gather_cut(tree_, lights_, receiver, at.position + lift_ * at.normal, surfaces_, params_,
                      cluster_error_)
        .irradiance;
  }
  return gather(at, [&](const Vpl& light) { return transfer(receiver, light, params_); });
}

vec3 VplField::glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const {
  const float a = std::max(roughness * roughness, 1e-3f);
  Receiver receiver{at.position, at.normal, std::min(2 / (a * a) - 2, sharpest_lobe), r};
  receiver.exponent = std::max(receiver.exponent, 1.0f);
  const float least = std::pow(least_of_lobe, 1 / receiver.exponent);
  return gather(at, [&](const Vpl& light) {
    const vec3 way = light.position - at.position;
    // Of a spherical light the edge may lie in the lobe though its middle does not.
    if (params_.kind == VplKind::point && glm::dot(way, r) < least * glm::length(way)) return 0.0f;
    return transfer(receiver, light, params_);
  });
}

double VplField::lost_energy(std::span<const rays::SurfacePoint> points) const {
  std::vector<double> open(points.size()), kept(points.size());
  parallel_for(points.size(), 1, [&](std::size_t i) {
    const Receiver at{points[i].position, points[i].normal};
    open[i] = static_cast<double>(
        luminance(gather(points[i], [&](const Vpl& l) { return unbounded_transfer(at, l); })));
    kept[i] = static_cast<double>(
        luminance(gather(points[i], [&](const Vpl& l) { return transfer(at, l, params_); })));
  });
  double all = 0, left = 0;
  for (std::size_t i = 0; i < points.size(); ++i) all += open[i], left += kept[i];
  return all > 0 ? 1 - left / all : 0;
}

double VplField::mean_cut(std::span<const rays::SurfacePoint> points) const {
  if (tree_.empty()) return static_cast<double>(lights_.size());
  std::vector<int> lights(points.size());
  parallel_for(points.size(), 1, [&](std::size_t i) {
    lights[i] = gather_cut(tree_, lights_, {points[i].position, points[i].normal},
                           points[i].position + lift_ * points[i].normal, surfaces_, params_, cluster_error_)
                    .lights;
  });
  double sum = 0;
  for (const int n : lights) sum += n;
  return points.empty() ? 0 : sum / static_cast<double>(points.size());
}

void set_radii(std::vector<Vpl>& lights, float factor) {
  constexpr std::size_t neighbour = 8;
  std::vector<vec3> positions;
  for (const Vpl& light : lights) positions.push_back(light.position);
  const geometry::NearestPoints nearest(positions);
  for (Vpl& light : lights) {
    geometry::Near found[neighbour + 1];  // itself is the first
    const int count = nearest.find(light.position, found);
    light.radius = factor * std::sqrt(found[count - 1].distance2);
  }
}

}  // namespace ssphh::methods::vpl
