#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/require.h>

#include "network_data.h"

namespace ssphh::transport {

void TransportNetwork::prepare_poses(int count, const Control& control) {
  Data& d = *data_;
  if (count < 2)
    throw Error("poses", fmt::format("{} poses leave nothing to blend", count),
                "give at least 2, or 0 for none");
  const float now = d.time;
  d.prepared.clear();
  ProgressStage progress(control, "poses", static_cast<std::uint64_t>(count), "poses");
  for (int k = 0; k < count; ++k) {
    control.check();
    const float time = d.source.duration() * static_cast<float>(k) / static_cast<float>(count - 1);
    set_time(time);
    PreparedPose& pose = d.prepared.emplace_back();
    pose.time = time;
    pose.links = d.moving;
    for (const LinkRows::Row& row : d.rows.rows)
      pose.rows.emplace_back(
          row.moving.empty() ? 0 : static_cast<std::size_t>(row.moving.data() - d.moving.data()),
          row.moving.size());
    for (const MovingRay& ray : d.moving_hits) {
      const SeenPatch& patch = d.seen[ray.owner];
      pose.hits.push_back({patch.index, patch.albedo,
                           d.seen_emission.empty() ? std::uint16_t{0} : d.seen_emission[ray.owner],
                           d.seen_distance[ray.owner]});
    }
    progress.advance(1);
  }
  std::size_t most = 0;
  for (const PreparedPose& pose : d.prepared) most = std::max(most, pose.links.size());
  d.moving.reserve(2 * most);  // blends take no memory; rows are laid out anew below
  d.pose_work.links.reserve(2 * most);
  d.mixed_hits.reserve(d.moving_hits.size());
  set_time(now);
}

PoseReport TransportNetwork::set_time_between(float time) {
  Data& d = *data_;
  require(d.prepared.size() >= 2, "poses", "none were prepared to blend between");
  require(std::isfinite(time), "time", "it must be a finite number of seconds");
  d.pose_work.step = PoseWork::Step::parts;
  Pace pace;
  d.go_on_to(time, true, pace);
  return d.pose_work.report;
}

void TransportNetwork::Data::blend_poses() {
  // Find the two poses around the time.
  std::size_t after = 1;
  while (after + 1 < prepared.size() && prepared[after].time < time) ++after;
  const PreparedPose &a = prepared[after - 1], &b = prepared[after];
  const float length = b.time - a.time;
  const float share = length > 0 ? std::clamp((time - a.time) / length, 0.0f, 1.0f) : 0;

  // Blend the rows: both poses' links, each with its share.
  std::vector<Link>& links = pose_work.links;
  auto& ranges = pose_work.ranges;
  links.clear();
  ranges.resize(rows.rows.size());
  for (std::size_t s = 0; s < ranges.size(); ++s) {
    const std::size_t first = links.size();
    const auto add = [&](const PreparedPose& pose, float weight) {
      if (weight == 0) return;
      for (std::size_t i = 0; i < pose.rows[s].second; ++i) {
        const Link& link = pose.links[pose.rows[s].first + i];
        links.push_back({link.patch, weight * link.weight});
      }
    };
    add(a, 1 - share);
    add(b, share);
    ranges[s] = {first, links.size() - first};
  }
  set_moving();

  // Blend what probe rays see; what panes show is as it is now.
  pose_mirrored();
  mixed_hits.clear();
  for (std::size_t i = 0; i < moving_hits.size(); ++i) {
    const std::uint32_t owner = moving_hits[i].owner;
    const SeenPatch before{a.hits[i].patch, a.hits[i].albedo}, then{b.hits[i].patch, b.hits[i].albedo};
    const bool nearer_b = share >= 0.5f;
    set_hit(owner, nearer_b ? b.hits[i] : a.hits[i]);
    if (before != then) {
      mixed_hits.push_back({owner, nearer_b ? before : then, nearer_b ? 1 - share : share});
      ++pose_work.report.hits_changed;
    }
  }
  pose_work.report.rays_near_parts = moving_hits.size() + moving_links.size();
}

std::size_t TransportNetwork::pose_bytes() const {
  std::size_t bytes = data_->kept.bytes();
  for (const PreparedPose& pose : data_->prepared) {
    bytes += pose.links.size() * sizeof(Link) + pose.rows.size() * sizeof(pose.rows[0]) +
             pose.hits.size() * sizeof(Resolved);
  }
  return bytes;
}

}  // namespace ssphh::transport
