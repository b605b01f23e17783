#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/transport/surface_gather.h>

#include "gather_guide.h"
#include "mirrors.h"

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
                             int rays, std::span<const std::vector<Irradiance4>> direct,
                             const Control& control)
    : network_(&network), points_(std::move(points)) {
  if (rays < 4 || rays > 1 << 16) throw Error("gather rays", fmt::format("{} is outside 4..65536", rays));
  if (points_.size() > most_records)
    throw Error("surface records",
                fmt::format("{} points, at most {} can be kept", points_.size(), most_records));
  for (const std::vector<Irradiance4>& group : direct)
    require(group.size() == network.patch_count(), "surface gather",
            "there is not one irradiance for each patch");
  Rows rows(points_.size());
  trace(static_cast<std::uint32_t>(rays), direct, rows, control);
  first_.push_back(0);
  first_moving_.push_back(0);
  for (Row& row : rows) {
    links_.insert(links_.end(), row.links.begin(), row.links.end());
    moving_.insert(moving_.end(), row.moving.begin(), row.moving.end());
    first_.push_back(links_.size());
    first_moving_.push_back(moving_.size());
    openness_.push_back(row.openness);
    row = {};
  }
  update_pose();
}

void SurfaceGather::append(SurfaceGather&& other) {
  require(other.network_ == network_ && &other != this, "surface gather",
          "it must be another gather of the same network");
  if (points_.size() + other.points_.size() > most_records)
    throw Error("surface records", fmt::format("{} points, at most {} can be kept",
                                               points_.size() + other.points_.size(), most_records));
  for (std::size_t i = 1; i < other.first_.size(); ++i) {
    first_.push_back(links_.size() + other.first_[i]);
    first_moving_.push_back(moving_.size() + other.first_moving_[i]);
  }
  std::ranges::move(other.links_, std::back_inserter(links_));
  std::ranges::move(other.moving_, std::back_inserter(moving_));
  std::ranges::move(other.points_, std::back_inserter(points_));
  std::ranges::move(other.openness_, std::back_inserter(openness_));
}

void SurfaceGather::trace(std::uint32_t rays, std::span<const std::vector<Irradiance4>> direct, Rows& rows,
                          const Control& control) {
  const TransportNetwork::Data& d = *network_->data_;
  const HemisphereParts parts(rays);
  const std::vector<float> flux = patch_flux(d, direct);
  const std::vector<std::uint32_t> order = spatial_order(points_);
  constexpr std::size_t together = 64;  // are guided by the same list of what is bright
  ProgressStage progress(control, "gathering at surfaces", points_.size(), "points");
  parallel_for((order.size() + together - 1) / together, 1,
               [&](std::size_t group) {
                 const std::size_t begin = group * together, end = std::min(begin + together, order.size());
                 const std::span which(order.data() + begin, end - begin);
                 std::vector<rays::SurfacePoint> here;
                 for (const std::uint32_t p : which) here.push_back(points_[p]);
                 const std::vector<BrightPoint> bright = bright_points(d, flux, here);
                 for (const std::uint32_t p : which) rows[p] = trace_point(p, parts, rays, bright);
                 progress.advance(end - begin);
               },
               control);
}

SurfaceGather::Row SurfaceGather::trace_point(std::uint32_t p, const HemisphereParts& parts,
                                              std::uint32_t count, std::span<const BrightPoint> bright) {
  const TransportNetwork::Data& d = *network_->data_;
  const rays::SurfacePoint& point = points_[p];
  const Frame frame = Frame::around(point.normal);
  const vec3 origin = point.position + link_lift * d.surfels.size() * point.normal;
  std::vector<rays::RayQuery> rays;
  std::vector<float> weights;
  const std::vector<std::uint32_t> of_parts = rays_of_parts(parts, count, point, bright);
  for (std::size_t part = 0; part < of_parts.size(); ++part) {
    for (std::uint32_t i = 0; i < of_parts[part]; ++i) {
      rays.push_back({origin, frame.to_world(parts.direction(part, i, p))});
      weights.push_back(1 / static_cast<float>(parts.count() * of_parts[part]));
    }
  }
  std::vector<rays::RayHit> hits(rays.size());
  d.source.intersect(0, rays, hits);

  // Against their mean, slopes find nothing where all around is as bright, however the rays lie.
  vec2 mean(0);
  for (std::size_t i = 0; i < rays.size(); ++i) mean += weights[i] * slope_of(rays[i], point.normal);
  Row row;
  float nearness = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) nearness += weights[i] / std::max(hits[i].distance, 1e-30f);
  row.openness = 1 / nearness;
  std::vector<Link> all;
  const auto add = [&](const rays::RayQuery& ray, const vec3& normal, std::int32_t patch,
                       const std::optional<vec3>& from, float weight, const vec2& slope) {
    const Link link{static_cast<std::uint32_t>(std::max(patch, 0)), weight, slope};
    if (d.near_parts({.ray = ray, .normal = normal, .patch = patch, .from = from})) {
      row.moving.push_back({ray, normal, patch, from, link, weight});
    } else if (patch != no_patch) {
      all.push_back(link);
    }
  };
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rays[i].t_max = hits[i].distance;
    std::int32_t patch = no_patch;
    if (!hits[i].escaped())
      patch = d.find_static({rays[i].origin + hits[i].distance * rays[i].direction, hits[i].normal});
    // As of the surfels' links, glass takes the mean of its channels
    const float weight = weights[i] * (hits[i].through.x + hits[i].through.y + hits[i].through.z) / 3;
    add(rays[i], hits[i].normal, patch, {}, weight, weight * (slope_of(rays[i], point.normal) - mean));
  }
  for (const MirrorSight& sight : follow_mirrors(d.source, rays, hits)) {
    const std::int32_t patch =
        d.find_static({sight.ray.origin + sight.ray.t_max * sight.ray.direction, sight.normal});
    const float weight = weights[sight.of] * (sight.share.x + sight.share.y + sight.share.z) / 3;
    add(sight.ray, sight.normal, patch, sight.from, weight,
        weight * (slope_of(rays[sight.of], point.normal) - mean));
  }
  // One link for each patch; the stable order makes sums the same on every machine.
  std::ranges::stable_sort(all, {}, &Link::patch);
  for (const Link& link : all) {
    if (!row.links.empty() && row.links.back().patch == link.patch) {
      row.links.back().weight += link.weight;
      row.links.back().slope += link.slope;
    } else {
      row.links.push_back(link);
    }
  }
  return row;
}

void SurfaceGather::update_pose() {
  update_pose(0, moving_.size());
}

void SurfaceGather::update_pose(std::size_t begin, std::size_t end) {
  require(begin <= end && end <= moving_.size(), "surface gather", "there are no such rays");
  const TransportNetwork::Data& d = *network_->data_;
  parallel_for(end - begin, 256, [&](std::size_t i) {
    Moving& m = moving_[begin + i];
    const Resolved found = d.resolve({.ray = m.ray, .normal = m.normal, .patch = m.patch, .from = m.from});
    m.set_patch(found.patch);
  });
}

void SurfaceGather::get_patches(std::span<std::int32_t> out) const {
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = moving_[i].link.weight > 0 ? static_cast<std::int32_t>(moving_[i].link.patch) : no_patch;
}

void SurfaceGather::set_patches(std::span<const std::int32_t> patches) {
  for (std::size_t i = 0; i < patches.size(); ++i) moving_[i].set_patch(patches[i]);
}

void SurfaceGather::light(std::span<const Irradiance4> irradiance,
                          std::vector<probes::RecordLight>& out) const {
  const std::vector<vec3>& albedo = network_->albedo();
  require(irradiance.size() == albedo.size(), "surface gather", "there is not one irradiance for each patch");
  std::vector<vec4> radiosity(albedo.size());
  for (std::size_t s = 0; s < albedo.size(); ++s) radiosity[s] = vec4(albedo[s], 0) * irradiance[s];
  out.resize(points_.size());
  light(radiosity, 0, points_.size(), out);
}

void SurfaceGather::light(std::span<const vec4> radiosity, std::size_t begin, std::size_t end,
                          std::span<probes::RecordLight> out) const {
  require(radiosity.size() == network_->patch_count() && out.size() == points_.size() && begin <= end &&
              end <= points_.size(),
          "surface gather", "there is not one radiosity for each patch, or one light for each point");
  parallel_for(end - begin, 64, [&](std::size_t first, std::size_t last) {
    for (std::size_t p = begin + first; p < begin + last; ++p) {
      vec4 level(0), x(0), y(0);
      const auto add = [&](const Link& link) {
        const vec4 b = radiosity[link.patch];
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

}  // namespace ssphh::transport
