#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/rays/posed_world.h>

#include "network_data.h"

namespace ssphh::transport {
namespace {

TransportParams checked(const rays::TransportSource& source, std::span<const vec3> positions,
                        TransportParams params) {
  if (positions.empty())
    throw Error("transport", "there are no probes", "place some, or give the scene SPHLs");
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!is_finite(positions[i]))
      throw Error(fmt::format("probe {}", i), "its position is not a finite number");
  }
  const auto within = [](const char* name, int value, int low, int high) {
    if (value < low || value > high) throw Error(name, fmt::format("{} is outside {}..{}", value, low, high));
  };
  within("directions", params.directions, 8, 1 << 16);
  within("link rays", params.link_rays, 4, 1 << 16);
  within("samples", params.samples, 1, 32);
  if (!(params.surfel_size >= 0) || !std::isfinite(params.surfel_size))
    throw Error("surfel size", fmt::format("{} is no length", params.surfel_size));
  within("surfels", params.most_surfels, 1000, 1 << 24);
  require(params.surfels_per_radius > 0 && std::isfinite(params.surfels_per_radius), "surfels per radius",
          "it must be a number over 0");
  if (params.surfel_size == 0) {
    // As fine as the probes stand dense, but no finer than they could tell, nor than SurfelSet can number.
    const scene::Bounds bounds = source.part_bounds(0);
    const float apart =
        positions.size() > 1 ? probes::median_spacing({positions.begin(), positions.end()}) : 0;
    const float dense = positions.size() > 1 ? std::min(0.5f, apart / 4) : 0.5f;
    const float most = std::max({dense, apart / 8 - 0.5f, max_component(bounds.max - bounds.min) / 30000});
    params.surfel_size = std::min(bounds.radius() / params.surfels_per_radius, most);
  }
  return params;
}

}  // namespace

TransportNetwork::TransportNetwork(const rays::TransportSource& source, std::span<const vec3> positions,
                                   const TransportParams& params, float time, const Control& control)
    : data_(std::make_unique<Data>(source, checked(source, positions, params))) {
  require(std::isfinite(time), "time", "it must be a finite number of seconds");
  data_->build(positions, time, control);
}

TransportNetwork::~TransportNetwork() = default;
TransportNetwork::TransportNetwork(TransportNetwork&&) noexcept = default;
TransportNetwork& TransportNetwork::operator=(TransportNetwork&&) noexcept = default;

PoseReport TransportNetwork::set_time(float time) {
  require(std::isfinite(time), "time", "it must be a finite number of seconds");
  data_->pose_work.step = PoseWork::Step::parts;
  Pace pace;
  data_->go_on_to(time, false, pace);
  return data_->pose_work.report;
}

const std::vector<MixedHit>& TransportNetwork::mixed_hits() const {
  return data_->mixed_hits;
}
float TransportNetwork::time() const {
  return data_->time;
}
const TransportParams& TransportNetwork::params() const {
  return data_->params;
}
const ProbeGBuffer& TransportNetwork::gbuffer() const {
  return data_->gbuffer;
}
const SurfelSet& TransportNetwork::surfels() const {
  return data_->surfels;
}
const std::vector<vec3>& TransportNetwork::albedo() const {
  return data_->albedo;
}
const std::vector<rays::SurfacePoint>& TransportNetwork::samples() const {
  return data_->samples;
}
const std::vector<std::uint8_t>& TransportNetwork::sample_used() const {
  return data_->sample_used;
}
bool TransportNetwork::sample_exists(std::size_t sample) const {
  require(sample < data_->sample_exists.size(), "sample", "there is none of that index");
  return data_->sample_exists[sample];
}
const LinkRows& TransportNetwork::links() const {
  return data_->rows;
}
const Contraction& TransportNetwork::contraction() const {
  return data_->contraction;
}
const std::vector<SeenPatch>& TransportNetwork::seen() const {
  return data_->seen;
}
const std::vector<MirroredPatch>& TransportNetwork::seen_mirrored() const {
  return data_->seen_mirrored;
}
const std::vector<float>& TransportNetwork::seen_distance() const {
  return data_->seen_distance;
}
const std::vector<std::uint16_t>& TransportNetwork::seen_emission() const {
  return data_->seen_emission;
}
const EmissionPalette& TransportNetwork::palette() const {
  return data_->gbuffer.palette;
}
const std::vector<mat4>& TransportNetwork::poses() const {
  return data_->poses;
}
scene::Bounds TransportNetwork::part_world_bounds(int part) const {
  data_->check_part(part);
  return rays::transformed(data_->source.part_bounds(part), data_->poses[part]);
}
int TransportNetwork::find(int part, const rays::SurfacePoint& point) const {
  data_->check_part(part);
  return data_->find(part, point);
}
std::vector<std::int32_t> TransportNetwork::gather(std::span<const rays::SurfacePoint> points, int rays,
                                                   const Control& control) const {
  require(rays >= 1, "gather rays", "there must be at least one for each point");
  const auto per_point = static_cast<std::size_t>(rays);
  std::vector<std::int32_t> patches(points.size() * per_point);
  std::vector<rays::RayQuery> queries;
  std::vector<rays::RayHit> hits;
  ProgressStage progress(control, "gathering", points.size(), "points");
  constexpr std::size_t block = 1024;
  for (std::size_t begin = 0; begin < points.size(); begin += block) {
    control.check();
    const std::size_t end = std::min(begin + block, points.size());
    queries.clear();
    for (std::size_t i = begin; i < end; ++i) {
      for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(rays); ++r)
        queries.push_back(fan_ray(points[i], link_lift * data_->surfels.size(), r, i));
    }
    data_->see(queries, hits, [&](std::size_t i, const rays::RayHit&, int found) {
      patches[begin * per_point + i] = found;
    });
    progress.advance(end - begin);
  }
  return patches;
}
std::vector<Sight> TransportNetwork::look(std::span<const rays::RayQuery> rays) const {
  std::vector<Sight> sights(rays.size());
  std::vector<rays::RayHit> hits;
  data_->see(rays, hits, [&](std::size_t i, const rays::RayHit& hit, int patch) {
    sights[i] = {patch, hit.albedo, hit.emission, hit.group};
  });
  return sights;
}
std::size_t TransportNetwork::lost_links() const {
  return data_->lost_links;
}

}  // namespace ssphh::transport
