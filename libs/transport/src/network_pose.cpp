#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/rays/posed_world.h>

#include "network_data.h"

namespace ssphh::transport {
namespace {

/// Poses at which an animation's volume is sampled.
constexpr int sweep_steps = 512;

rays::RayQuery transformed(const rays::RayQuery& ray, const mat4& matrix) {
  return {vec3(matrix * vec4(ray.origin, 1)), mat3(matrix) * ray.direction, ray.t_max};
}

rays::SurfacePoint transformed(const rays::SurfacePoint& p, const mat4& matrix) {
  const mat3 linear(matrix);
  return {vec3(matrix * vec4(p.position, 1)),
          glm::normalize(glm::transpose(glm::inverse(linear)) * p.normal)};
}

}  // namespace

rays::RayQuery fan_ray(const rays::SurfacePoint& from, float lift, std::uint32_t index, std::size_t salt) {
  const std::uint64_t h = mix64(salt);
  const double u = 0.7548776662466927 * (index + 1) + static_cast<double>(h >> 32) * 0x1p-32;
  const double v = 0.5698402909980532 * (index + 1) + static_cast<double>(h & 0xffffffffu) * 0x1p-32;
  const vec2 p{static_cast<float>(u - std::floor(u)), static_cast<float>(v - std::floor(v))};
  const vec3 local = sample_cosine_hemisphere(glm::min(p, vec2(0x1.fffffep-1f)));
  return {from.position + lift * from.normal, Frame::around(from.normal).to_world(local)};
}

bool meets(const rays::RayQuery& ray, const scene::Bounds& box) {
  float near = 0, far = ray.t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1 / ray.direction[axis];
    const float a = (box.min[axis] - ray.origin[axis]) * inverse;
    const float b = (box.max[axis] - ray.origin[axis]) * inverse;
    // A ray in the plane of a side gives NaN, which min and max of this form pass over.
    near = std::max(near, std::fmin(a, b));
    far = std::min(far, std::fmax(a, b) * (1 + 1e-5f) + 1e-6f);
  }
  return near <= far;
}

bool meets_any(const rays::RayQuery& ray, const std::vector<scene::Bounds>& boxes) {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const scene::Bounds& box) { return !box.empty() && meets(ray, box); });
}

std::vector<scene::Bounds> swept_bounds(const rays::TransportSource& source) {
  std::vector<scene::Bounds> swept(static_cast<std::size_t>(source.part_count()));
  for (int part = 1; part < source.part_count(); ++part) {
    scene::Bounds& total = swept[static_cast<std::size_t>(part)];
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

rays::SurfacePoint TransportNetwork::Data::to_world(int part, const rays::SurfacePoint& point) const {
  return part == 0 ? point : transformed(point, poses[static_cast<std::size_t>(part)]);
}

rays::RayQuery TransportNetwork::Data::sample_segment(std::size_t sample) const {
  const std::size_t s = sample / sample_count();
  return surfels.segment(local_samples[s * sample_count()], local_samples[sample],
                         surfels.surfels()[s].level);
}

bool TransportNetwork::Data::parts_block(const rays::RayQuery& segment) const {
  for (const PlacedPart& p : placed) {
    const rays::RayQuery local = transformed(segment, p.to_part);
    if (!meets(local, p.bounds)) continue;
    std::uint8_t hit = 0;
    source.occluded(p.part, {&local, 1}, {&hit, 1});
    if (hit) return true;
  }
  return false;
}

bool TransportNetwork::Data::blocked(const rays::RayQuery& segment) const {
  std::uint8_t hit = 0;
  source.occluded(0, {&segment, 1}, {&hit, 1});
  return hit || parts_block(segment);
}

bool TransportNetwork::Data::covered(int part, const rays::SurfacePoint& point) const {
  const vec3 lift = link_lift * surfels.size() * point.normal;
  const rays::RayQuery through{point.position - lift, 2.0f * lift, 1};
  std::uint8_t hit = 0;
  if (part != 0) source.occluded(0, {&through, 1}, {&hit, 1});
  for (std::size_t p = 0; p < placed.size() && !hit; ++p) {
    if (placed[p].part == part) continue;
    const rays::RayQuery local = transformed(through, placed[p].to_part);
    if (meets(local, placed[p].bounds)) source.occluded(placed[p].part, {&local, 1}, {&hit, 1});
  }
  return hit != 0;
}

int TransportNetwork::Data::find(int part, const rays::SurfacePoint& point) const {
  if (part > 0) {
    // A ray that starts within a body, where another touches it, meets its inside: nothing lights that, and
    // within a body thinner than the lift sight would start on its far side.
    const float start = link_lift * surfels.size();
    const rays::RayQuery lift{point.position + start * point.normal,
                              1.05f * surfels.lift(surfels.level(part, point.position)) * point.normal, 1};
    std::uint8_t inside = 0;
    source.occluded(part, {&lift, 1}, {&inside, 1});
    if (inside) return no_surfel;
  }
  const rays::SurfacePoint world = to_world(part, point);
  return find_nearest(part, point, [&](int s) {
    const Surfel& surfel = surfels.surfels()[static_cast<std::size_t>(s)];
    return !blocked(surfels.segment(world, to_world(part, surfel.point), surfel.level));
  });
}

int TransportNetwork::Data::find_static(const rays::SurfacePoint& point) const {
  return find_nearest(0, point, [&](int s) {
    const Surfel& surfel = surfels.surfels()[static_cast<std::size_t>(s)];
    const rays::RayQuery way = surfels.segment(point, surfel.point, surfel.level);
    std::uint8_t hit = 0;
    source.occluded(0, {&way, 1}, {&hit, 1});
    return !hit;
  });
}

bool TransportNetwork::Data::near_parts(const rays::RayQuery& ray, const vec3& normal, int surfel) const {
  if (swept.size() < 2) return false;
  if (meets_any(ray, swept)) return true;
  if (surfel == no_surfel) return false;
  const rays::SurfacePoint point{ray.origin + ray.t_max * ray.direction, normal};
  const Surfel& met = surfels.surfels()[static_cast<std::size_t>(surfel)];
  return meets_any(surfels.segment(point, met.point, met.level), swept);
}

template <class Sees>
int TransportNetwork::Data::find_nearest(int part, const rays::SurfacePoint& point, const Sees& sees) const {
  for (const int s : surfels.cell(part, point)) {
    if (sees(s)) return s;
  }
  constexpr std::size_t most = 12;
  const std::vector<int> near = surfels.candidates(part, point);
  for (std::size_t i = 0; i < std::min(near.size(), most); ++i) {
    if (sees(near[i])) return near[i];
  }
  return no_surfel;
}

bool TransportNetwork::Data::meet_part(rays::RayQuery& ray, rays::RayHit& hit, int& part) const {
  bool any = false;
  for (const PlacedPart& p : placed) {
    const rays::RayQuery local = transformed(ray, p.to_part);
    if (!meets(local, p.bounds)) continue;
    rays::RayHit found;
    source.intersect(p.part, {&local, 1}, {&found, 1});
    if (!(found.distance < ray.t_max)) continue;
    ray.t_max = found.distance;
    hit = found;
    part = p.part;
    any = true;
  }
  return any;
}

Resolved TransportNetwork::Data::resolve(const MovingRay& unobstructed) const {
  rays::RayQuery ray = unobstructed.ray;
  rays::RayHit hit;
  int part = 0;
  if (meet_part(ray, hit, part)) {
    const PlacedPart& p = placed[static_cast<std::size_t>(part - 1)];
    const vec3 position = vec3(p.to_part * vec4(ray.origin + ray.t_max * ray.direction, 1));
    // The part's palette entries were made when the network was built.
    return {find(part, {position, hit.normal}), pack_albedo(hit.albedo),
            gbuffer.palette.find(hit.emission, hit.group), ray.t_max};
  }
  if (unobstructed.surfel == no_surfel)
    return {no_surfel, unobstructed.albedo, unobstructed.emission, ray.t_max};
  const rays::SurfacePoint point{ray.origin + ray.t_max * ray.direction, unobstructed.normal};
  const Surfel& surfel = surfels.surfels()[static_cast<std::size_t>(unobstructed.surfel)];
  const bool hidden = parts_block(surfels.segment(point, surfel.point, surfel.level));
  return {hidden ? find(0, point) : unobstructed.surfel, unobstructed.albedo, unobstructed.emission,
          ray.t_max};
}

void TransportNetwork::Data::see(std::span<const rays::RayQuery> rays, std::span<std::int32_t> surfel,
                                 std::span<std::uint8_t> escaped) const {
  see(rays, [&](std::size_t i, const rays::RayHit& hit, int found) {
    surfel[i] = found;
    escaped[i] = hit.escaped();
  });
}

void TransportNetwork::Data::see(
    std::span<const rays::RayQuery> rays,
    const std::function<void(std::size_t, const rays::RayHit&, int)>& visit) const {
  std::vector<rays::RayHit> hits(rays.size());
  source.intersect(0, rays, hits);
  parallel_for(rays.size(), 64, [&](std::size_t i) {
    rays::RayQuery ray = rays[i];
    ray.t_max = std::min(ray.t_max, hits[i].distance);
    rays::RayHit hit = hits[i];
    int part = 0;
    if (!meet_part(ray, hit, part) && hit.escaped()) {
      visit(i, hit, no_surfel);
      return;
    }
    vec3 position = ray.origin + ray.t_max * ray.direction;
    if (part > 0) position = vec3(placed[static_cast<std::size_t>(part - 1)].to_part * vec4(position, 1));
    visit(i, hit, find(part, {position, hit.normal}));
  });
}

std::size_t TransportNetwork::Data::used_samples(std::size_t s) const {
  const std::size_t m = sample_count();
  std::size_t used = 1;
  while (used < m && sample_exists[s * m + used]) ++used;
  return used;
}

void TransportNetwork::Data::place_parts(float new_time) {
  std::vector<mat4> new_poses(1, mat4(1));
  std::vector<PlacedPart> new_placed;
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
  poses = std::move(new_poses);
  placed = std::move(new_placed);
}

void TransportNetwork::Data::pose_samples() {
  const std::size_t m = sample_count();
  // Samples on parts move along; which of them are free of other bodies depends on the pose.
  parallel_for(surfels.count() - static_count, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = static_count + begin; s < static_count + end; ++s) {
      const Surfel& surfel = surfels.surfels()[s];
      for (std::size_t i = s * m; i < (s + 1) * m; ++i) samples[i] = to_world(surfel.part, local_samples[i]);
      for (std::size_t i = s * m; i < (s + 1) * m; ++i)
        sample_used[i] = sample_exists[i] && !covered(surfel.part, samples[i]) &&
                         (i == s * m || !blocked(surfels.segment(samples[s * m], samples[i], surfel.level)));
    }
  });
  parallel_for(hidden_samples.size(), 256, [&](std::size_t k) {
    const std::size_t i = hidden_samples[k];
    sample_used[i] = !covered(0, samples[i]) && !parts_block(sample_segment(i));
  });
}

void TransportNetwork::Data::pose_hits(PoseReport& report) {
  mixed_hits.clear();
  std::vector<std::uint8_t> changed(moving_hits.size());
  parallel_for(moving_hits.size(), 256, [&](std::size_t i) {
    const MovingRay& moving_ray = moving_hits[i];
    const Resolved found = resolve(moving_ray);
    const SeenPatch patch{found.surfel, found.albedo};
    changed[i] = patch != seen[moving_ray.owner];
    set_hit(moving_ray.owner, found);
  });
  report.hits_changed += static_cast<std::size_t>(std::ranges::count(changed, 1));
  report.rays_near_parts += moving_hits.size();
}

void TransportNetwork::Data::set_hit(std::uint32_t owner, const Resolved& found) {
  seen[owner] = {found.surfel, found.albedo};
  seen_distance[owner] = found.distance;
  if (!seen_emission.empty()) seen_emission[owner] = found.emission;
}

void TransportNetwork::Data::set_moving(std::vector<Link>&& links,
                                        std::span<const std::pair<std::size_t, std::size_t>> ranges) {
  moving = std::move(links);
  for (std::size_t s = 0; s < ranges.size(); ++s)
    rows.rows[s].moving = {moving.data() + ranges[s].first, ranges[s].second};
}

void TransportNetwork::Data::pose_links(PoseReport& report) {
  const auto rays = static_cast<std::size_t>(params.link_rays);
  const std::size_t m = sample_count(), part_surfels = surfels.count() - static_count;
  std::vector<std::int32_t> target(moving_links.size() + part_links.size(), no_surfel);
  std::vector<std::uint8_t> counted(target.size(), 1), lost(target.size(), 0);

  // Links of static surfels that a part may touch.
  parallel_for(moving_links.size(), 256, [&](std::size_t i) {
    counted[i] = sample_used[moving_links[i].sample];
    if (!counted[i]) return;
    target[i] = resolve(moving_links[i]).surfel;
    lost[i] = target[i] == no_surfel && std::isfinite(moving_links[i].ray.t_max);
  });

  // Links of the parts' own surfels: everything that they see may have changed.
  std::vector<rays::RayQuery> world(part_links.size());
  for (std::size_t i = 0; i < part_links.size(); ++i) {
    const int part = surfels.surfels()[static_count + i / rays].part;
    world[i] = transformed(part_links[i], poses[static_cast<std::size_t>(part)]);
  }
  std::vector<std::uint8_t> escaped(world.size());
  see(world, std::span(target).subspan(moving_links.size()), escaped);
  for (std::size_t i = 0; i < world.size(); ++i) {
    const std::size_t slot = moving_links.size() + i, s = static_count + i / rays;
    counted[slot] = sample_used[s * m + (i % rays) % used_samples(s)];
    lost[slot] = counted[slot] && target[slot] == no_surfel && !escaped[i];
  }

  // Rows: rays whose start is cut off from its surfel do not count.
  std::vector<Link> links;
  links.reserve(target.size());
  std::vector<std::pair<std::size_t, std::size_t>> ranges(surfels.count(), {0, 0});
  const auto add_row = [&](std::size_t s, std::size_t begin, std::size_t end, std::size_t row_rays) {
    std::size_t used = row_rays;
    for (std::size_t i = begin; i < end; ++i) used -= counted[i] ? 0 : 1;
    const std::size_t first = links.size();
    const float weight = used ? 1 / static_cast<float>(used) : 0;
    for (std::size_t i = begin; i < end; ++i) {
      if (counted[i] && target[i] != no_surfel)
        links.push_back({static_cast<std::uint32_t>(target[i]), weight});
    }
    ranges[s] = {first, links.size() - first};
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
  for (std::size_t i = 0; i < std::min(links.size(), moving.size()); ++i)
    same += links[i].surfel == moving[i].surfel;
  report.hits_changed += std::max(links.size(), moving.size()) - same;
  report.rays_near_parts += target.size();
  set_moving(std::move(links), ranges);
  lost_links = static_cast<std::size_t>(std::ranges::count(lost, 1));
}

}  // namespace ssphh::transport
