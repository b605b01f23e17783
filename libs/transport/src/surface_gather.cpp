#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/surface_gather.h>

#include "network_data.h"

namespace ssphh::transport {
namespace {

/// Slopes of rays that graze are taken as of this cosine: the few that do would rule the derivative's noise.
constexpr float least_slope_cosine = 0.1f;

vec2 slope_of(const rays::RayQuery& ray, const vec3& normal) {
  const vec3 local = Frame::around(normal).to_local(ray.direction);
  return vec2(local) / std::max(local.z, least_slope_cosine);
}

}  // namespace

SurfaceGather::SurfaceGather(const TransportNetwork& network, std::vector<rays::SurfacePoint> points,
                             int rays, const Control& control)
    : network_(&network), points_(std::move(points)), rays_(static_cast<std::uint32_t>(rays)) {
  if (rays < 4 || rays > 1 << 16) throw Error("gather rays", fmt::format("{} is outside 4..65536", rays));
  constexpr std::size_t most_points = std::size_t{1} << 16;
  if (points_.size() > most_points)
    throw Error("surface records",
                fmt::format("{} points, at most {} can be kept", points_.size(), most_points));
  first_.push_back(0);
  first_moving_.push_back(0);
  ProgressStage progress(control, "gathering at surfaces", points_.size(), "points");
  constexpr std::size_t block = 1024;
  for (std::size_t begin = 0; begin < points_.size(); begin += block) {
    control.check();
    const std::size_t end = std::min(begin + block, points_.size());
    trace(begin, end, control);
    progress.advance(end - begin);
  }
  update_pose();
}

void SurfaceGather::trace(std::size_t begin, std::size_t end, const Control& control) {
  const TransportNetwork::Data& d = *network_->data_;
  std::vector<rays::RayQuery> rays;
  for (std::size_t p = begin; p < end; ++p) {
    for (std::uint32_t r = 0; r < rays_; ++r)
      rays.push_back(fan_ray(points_[p], link_lift * d.surfels.size(), r, p));
  }
  std::vector<rays::RayHit> hits(rays.size());
  d.source.intersect(0, rays, hits);
  std::vector<std::int32_t> surfel(rays.size(), no_surfel);
  parallel_for(
      rays.size(), 256,
      [&](std::size_t i) {
        rays[i].t_max = hits[i].distance;
        if (hits[i].escaped()) return;
        surfel[i] = d.find_static({rays[i].origin + hits[i].distance * rays[i].direction, hits[i].normal});
      },
      control);

  const float weight = 1 / static_cast<float>(rays_);
  std::vector<Link> row;
  for (std::size_t p = begin; p < end; ++p) {
    row.clear();
    const std::size_t first_ray = (p - begin) * rays_;
    // Against their mean, slopes find nothing where all around is as bright, however the rays lie.
    vec2 mean(0);
    for (std::size_t i = first_ray; i < first_ray + rays_; ++i)
      mean += weight * slope_of(rays[i], points_[p].normal);
    for (std::size_t i = first_ray; i < first_ray + rays_; ++i) {
      const Link link{static_cast<std::uint32_t>(std::max(surfel[i], 0)), weight,
                      weight * (slope_of(rays[i], points_[p].normal) - mean)};
      if (d.near_parts(rays[i], hits[i].normal, surfel[i])) {
        moving_.push_back({rays[i], hits[i].normal, surfel[i], link, static_cast<std::uint32_t>(p)});
      } else if (surfel[i] != no_surfel) {
        row.push_back(link);
      }
    }
    // One link for each surfel; the stable order makes sums the same on every machine.
    std::ranges::stable_sort(row, {}, &Link::surfel);
    const std::size_t first = links_.size();
    for (const Link& link : row) {
      if (links_.size() > first && links_.back().surfel == link.surfel) {
        links_.back().weight += link.weight;
        links_.back().slope += link.slope;
      } else {
        links_.push_back(link);
      }
    }
    first_.push_back(links_.size());
    first_moving_.push_back(moving_.size());
  }
}

void SurfaceGather::update_pose() {
  const TransportNetwork::Data& d = *network_->data_;
  const float weight = 1 / static_cast<float>(rays_);
  parallel_for(moving_.size(), 256, [&](std::size_t i) {
    Moving& m = moving_[i];
    const Resolved found = d.resolve({m.ray, m.normal, m.surfel, 0, 0, 0, 0});
    m.link.weight = found.surfel == no_surfel ? 0 : weight;
    m.link.surfel = static_cast<std::uint32_t>(std::max(found.surfel, 0));
  });
}

void SurfaceGather::light(std::span<const Irradiance4> irradiance,
                          std::vector<probes::RecordLight>& out) const {
  const std::vector<vec3>& albedo = network_->albedo();
  require(irradiance.size() == albedo.size(), "surface gather",
          "there is not one irradiance for each surfel");
  std::vector<vec4> radiosity(albedo.size());
  for (std::size_t s = 0; s < albedo.size(); ++s) radiosity[s] = vec4(albedo[s], 0) * irradiance[s];
  out.resize(points_.size());
  parallel_for(points_.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      vec4 level(0), x(0), y(0);
      const auto add = [&](const Link& link) {
        const vec4 b = radiosity[link.surfel];
        level += link.weight * b;
        x += link.slope.x * b;
        y += link.slope.y * b;
      };
      for (std::size_t i = first_[p]; i < first_[p + 1]; ++i) add(links_[i]);
      for (std::size_t i = first_moving_[p]; i < first_moving_[p + 1]; ++i) {
        if (moving_[i].link.weight > 0) add(moving_[i].link);
      }
      const Frame frame = Frame::around(points_[p].normal);
      for (glm::length_t c = 0; c < 3; ++c) out[p][c] = vec3(frame.x[c] * x + frame.y[c] * y);
      out[p][3] = vec3(level);
    }
  });
}

std::size_t SurfaceGather::bytes() const {
  return points_.size() * sizeof(points_[0]) + links_.size() * sizeof(Link) +
         moving_.size() * sizeof(Moving) + (first_.size() + first_moving_.size()) * sizeof(std::size_t);
}

std::vector<rays::SurfacePoint> record_points(const TransportNetwork& network, int most) {
  const std::vector<rays::SurfacePoint> points = surfel_points(network);
  return points.empty() ? points : spread_points(points, most);
}

}  // namespace ssphh::transport
