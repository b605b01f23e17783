#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/rays/posed_world.h>

#include "network_data.h"

namespace ssphh::transport {
namespace {

/// Poses at which an animation's volume is sampled.
constexpr int sweep_steps = 512;

/// Rays of the first piece of a step that has little time.
constexpr std::size_t least_rays = 256;

}  // namespace

std::vector<scene::Bounds> swept_bounds(const rays::TransportSource& source) {
  std::vector<scene::Bounds> swept(static_cast<std::size_t>(source.part_count()));
  for (int part = 1; part < source.part_count(); ++part) {
    scene::Bounds& total = swept[part];
    const scene::Bounds box = source.part_bounds(part);
    if (box.empty()) continue;
    // Between two steps a corner may bulge out by less than it moves.
    vec3 largest_step(0);
    scene::Bounds last;
    for (int i = 0; i <= sweep_steps; ++i) {
      const float time = source.duration() * static_cast<float>(i) / sweep_steps;
      const scene::Bounds now = rays::transformed(box, source.part_pose(part, time));
      total.add(now.min);
      total.add(now.max);
      if (i > 0)
        largest_step =
            glm::max(largest_step, glm::max(glm::abs(now.min - last.min), glm::abs(now.max - last.max)));
      last = now;
    }
    const vec3 margin = largest_step + 1e-4f * (total.max - total.min) + 1e-6f;
    total.min -= margin;
    total.max += margin;
  }
  return swept;
}

std::size_t TransportNetwork::Data::used_samples(std::size_t s) const {
  const std::size_t m = sample_count();
  std::size_t used = 1;
  while (used < m && sample_exists[s * m + used]) ++used;
  return used;
}

bool TransportNetwork::Data::go_on_to(float new_time, bool between, Pace& pace) {
  using enum PoseWork::Step;
  PoseWork& work = pose_work;
  const auto next = [&](PoseWork::Step step) {
    work.step = step;
    work.done = 0;
    return !pace.over();
  };
  switch (work.step) {
    case parts:
      work.report = {};
      place_parts(new_time);
      place_samples();
      if (!between && recall_pose()) {
        next(rows);
        pose_rows();
        next(parts);
        return true;
      }
      pose_samples();
      if (between) {
        blend_poses();
        return true;
      }
      if (!next(hits)) return false;
      [[fallthrough]];
    case hits:
      if (!pose_hits(pace) || !next(links)) return false;
      [[fallthrough]];
    case links:
      if (!pose_links(pace) || !next(sights)) return false;
      [[fallthrough]];
    case sights:
      if (!pose_part_links(pace) || !next(rows)) return false;
      [[fallthrough]];
    case rows:
      pose_rows();
      keep_pose();
      next(parts);
  }
  return true;
}

void TransportNetwork::Data::place_parts(float new_time) {
  std::vector<mat4>& new_poses = pose_work.poses;
  std::vector<PlacedPart>& new_placed = pose_work.placed;
  new_poses.assign(1, mat4(1));
  new_placed.clear();
  for (int part = 1; part < source.part_count(); ++part) {
    const auto p = static_cast<std::size_t>(part);
    const mat4 pose = new_poses.emplace_back(source.part_pose(part, new_time));
    const scene::Bounds local = source.part_bounds(part);
    new_placed.push_back({part, local, pose, glm::inverse(pose)});
    if (local.empty()) continue;
    const scene::Bounds now = rays::transformed(local, pose);
    if (glm::any(glm::lessThan(now.min, swept[p].min)) || glm::any(glm::greaterThan(now.max, swept[p].max))) {
      throw Error(
          fmt::format("part \"{}\"", source.part_name(part)),
          fmt::format("at {} s it leaves the volume that its animation was sampled to sweep", new_time),
          "give the animation slower or fewer oscillations");
    }
  }
  time = new_time;
  poses.swap(new_poses);
  placed.swap(new_placed);
}

void TransportNetwork::Data::place_samples() {
  const std::size_t m = sample_count();
  parallel_for(surfels.count() - static_count, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = static_count + begin; s < static_count + end; ++s) {
      for (std::size_t i = s * m; i < (s + 1) * m; ++i)
        samples[i] = to_world(surfels.surfels()[s].part, local_samples[i]);
    }
  });
}

void TransportNetwork::Data::pose_samples() {
  const std::size_t m = sample_count();
  parallel_for(surfels.count() - static_count, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = static_count + begin; s < static_count + end; ++s) {
      const Surfel& surfel = surfels.surfels()[s];
      const rays::SurfacePoint middle = to_world(surfel.part, surfel.point);
      for (std::size_t i = s * m; i < (s + 1) * m; ++i)
        sample_used[i] = sample_exists[i] && !covered(surfel.part, samples[i]) &&
                         !blocked(SurfelSet::segment(middle, surfel.height, samples[i], surfel.height));
    }
  });
  parallel_for(hidden_samples.size(), 256, [&](std::size_t k) {
    const std::size_t i = hidden_samples[k];
    sample_used[i] = !covered(0, samples[i]) && !parts_block(sample_segment(i));
  });
}

bool TransportNetwork::Data::pose_hits(Pace& pace) {
  mixed_hits.clear();
  PoseWork& work = pose_work;
  work.changed.resize(moving_hits.size());
  const bool all =
      pace.go_on(work.done, moving_hits.size(), least_rays, [&](std::size_t first, std::size_t end) {
        parallel_for(end - first, 256, [&](std::size_t k) {
          const std::size_t i = first + k;
          const MovingRay& moving_ray = moving_hits[i];
          const Resolved found = resolve(moving_ray);
          const SeenPatch patch{found.patch, found.albedo};
          work.changed[i] = patch != seen[moving_ray.owner];
          set_hit(moving_ray.owner, found);
        });
      });
  if (!all) return false;
  work.report.hits_changed += static_cast<std::size_t>(std::ranges::count(work.changed, 1));
  work.report.rays_near_parts += moving_hits.size();
  pose_mirrored();
  return true;
}

void TransportNetwork::Data::pose_mirrored() {
  parallel_for(moving_mirrored.size(), 256, [&](std::size_t i) {
    const Resolved found = resolve(moving_mirrored[i]);
    seen_mirrored[moving_mirrored[i].owner].patch = {found.patch, found.albedo};
  });
}

void TransportNetwork::Data::set_hit(std::uint32_t owner, const Resolved& found) {
  seen[owner] = {found.patch, found.albedo};
  seen_distance[owner] = found.distance;
  if (!seen_emission.empty()) seen_emission[owner] = found.emission;
}

void TransportNetwork::Data::set_moving() {
  moving.swap(pose_work.links);
  for (std::size_t s = 0; s < pose_work.ranges.size(); ++s)
    rows.rows[s].moving = {moving.data() + pose_work.ranges[s].first, pose_work.ranges[s].second};
}

/// Links of static surfels that a part may touch.
bool TransportNetwork::Data::pose_links(Pace& pace) {
  PoseWork& work = pose_work;
  const std::size_t count = moving_links.size() + part_links.size();
  work.target.resize(count);
  work.counted.resize(count);
  work.lost.resize(count);
  return pace.go_on(work.done, moving_links.size(), least_rays, [&](std::size_t first, std::size_t end) {
    parallel_for(end - first, 256, [&](std::size_t k) {
      const std::size_t i = first + k;
      const MovingRay& link = moving_links[i];
      work.counted[i] = sample_used[link.sample];
      work.target[i] = work.counted[i] ? resolve(link).patch : no_patch;
      work.lost[i] = work.counted[i] && work.target[i] == no_patch && std::isfinite(link.ray.t_max);
    });
  });
}

/// Links of the parts' own surfels: everything that they see may have changed.
bool TransportNetwork::Data::pose_part_links(Pace& pace) {
  PoseWork& work = pose_work;
  const auto rays = static_cast<std::size_t>(params.link_rays);
  const std::size_t m = sample_count();
  return pace.go_on(work.done, part_links.size(), least_rays, [&](std::size_t first, std::size_t end) {
    work.world.resize(end - first);
    for (std::size_t i = first; i < end; ++i) {
      const int part = surfels.surfels()[static_count + i / rays].part;
      work.world[i - first] = transformed(part_links[i], poses[part]);
    }
    see(work.world, work.hits, [&](std::size_t k, const rays::RayHit& hit, int patch) {
      const std::size_t i = first + k, slot = moving_links.size() + i, s = static_count + i / rays;
      work.target[slot] = patch;
      work.counted[slot] = sample_used[s * m + (i % rays) % used_samples(s)];
      work.lost[slot] = work.counted[slot] && patch == no_patch && !hit.escaped();
    });
  });
}

/// Rays whose start is cut off from its surfel do not count.
void TransportNetwork::Data::pose_rows() {
  PoseWork& work = pose_work;
  const auto rays = static_cast<std::size_t>(params.link_rays);
  const std::size_t part_surfels = surfels.count() - static_count;
  work.links.clear();
  work.links.reserve(work.target.size());
  work.ranges.assign(surfels.count(), {0, 0});
  const auto mirrored = [&](std::size_t i) { return i < moving_links.size() && moving_links[i].from; };
  const auto share = [&](std::size_t i) { return i < moving_links.size() ? moving_links[i].share : 1.0f; };
  const auto add_row = [&](std::size_t s, std::size_t begin, std::size_t end, std::size_t row_rays) {
    std::size_t used = row_rays;
    for (std::size_t i = begin; i < end; ++i) used -= work.counted[i] || mirrored(i) ? 0 : 1;
    const std::size_t first = work.links.size();
    const float weight = used ? 1 / static_cast<float>(used) : 0;
    for (std::size_t i = begin; i < end; ++i) {
      if (work.counted[i] && work.target[i] != no_patch)
        work.links.push_back({static_cast<std::uint32_t>(work.target[i]), weight * share(i)});
    }
    work.ranges[s] = {first, work.links.size() - first};
  };
  for (std::size_t i = 0; i < moving_links.size();) {
    std::size_t end = i;
    while (end < moving_links.size() && moving_links[end].owner == moving_links[i].owner) ++end;
    add_row(moving_links[i].owner, i, end, rays);
    i = end;
  }
  for (std::size_t p = 0; p < part_surfels; ++p)
    add_row(static_count + p, moving_links.size() + p * rays, moving_links.size() + (p + 1) * rays, rays);

  std::size_t same = 0;
  for (std::size_t i = 0; i < std::min(work.links.size(), moving.size()); ++i)
    same += work.links[i].patch == moving[i].patch;
  work.report.hits_changed += std::max(work.links.size(), moving.size()) - same;
  work.report.rays_near_parts += work.target.size();
  set_moving();
  lost_links = static_cast<std::size_t>(std::ranges::count(work.lost, 1));
}

}  // namespace ssphh::transport
