#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>

#include "mirrors.h"
#include "network_data.h"

namespace ssphh::transport {
namespace {

/// Rays per surfel and round while surfaces are still being found.
constexpr int discovery_rays = 32;
constexpr int most_rounds = 12;
/// Points per surfel that moving parts are sampled with.
constexpr double part_samples_per_surfel = 24;

/// Where a ray meets a surface, a little before it: a hit on the edge of two walls, rounded, may lie beyond
/// the other one, and all that is behind would be discovered.
vec3 just_before(const rays::RayQuery& ray, float distance) {
  return ray.origin + (1 - 2e-5f) * distance * ray.direction;
}

float mean_of(const vec3& v) {
  return (v.x + v.y + v.z) / 3;
}

/// Fills a network's data step by step.
class NetworkBuilder {
 public:
  NetworkBuilder(TransportNetwork::Data& data, const Control& control) : d_(data), control_(control) {}

  void build(std::span<const vec3> positions, float time) {
    d_.swept = swept_bounds(d_.source);
    d_.gbuffer = trace_gbuffer(d_.source, positions, d_.params.directions, control_);
    choose_sizes();
    add_probe_hits();
    discover();
    link_static_surfels();
    d_.static_count = d_.surfels.count();
    d_.find_seen_patches();
    add_part_surfels();
    d_.surfels.update_albedo();
    d_.find_patch_albedo();
    find_hidden_samples();
    find_moving_rays();
    make_fixed_rows();

    find_contraction();
    pose(time);
  }

 private:
  void pose(float time) {
    Pace pace;
    d_.go_on_to(time, false, pace);
  }

  /// Of the first and the last pose, whichever comes next: what is solved with it must not depend on when the
  /// network was built.
  void find_contraction() {
    pose(0);
    d_.contraction = contraction(d_.rows, d_.albedo);
    if (!(d_.source.duration() > 0)) return;
    pose(d_.source.duration());
    const Contraction last = contraction(d_.rows, d_.albedo);
    d_.contraction.lower = std::min(d_.contraction.lower, last.lower);
    d_.contraction.upper = std::max(d_.contraction.upper, last.upper);
  }

  /// A link as traced, before rows are made of them.
  struct RawLink {
    rays::RayQuery ray;  ///< t_max: distance of the hit
    vec3 normal;
    std::int32_t patch;
    float share = 1;                ///< what glass leaves of the light, mean over the channels
    std::size_t of = 0;             ///< index of the ray, of what it shows in a pane, too
    std::optional<vec3> from = {};  ///< of what a pane shows: MovingRay::from
  };

  std::size_t rays_per_surfel() const { return static_cast<std::size_t>(d_.params.link_rays); }
  std::size_t m() const { return d_.sample_count(); }

  /// Larger surfels far from probes and lamps, where one size for all would make too many.
  void choose_sizes() {
    const std::size_t most = static_cast<std::size_t>(d_.params.most_surfels);
    const float size = d_.surfels.size();
    SurfelSizes sizes =
        sizes_within(d_.gbuffer, size, most, lamp_places(size), lamp_places(4 * size), d_.params.grow);
    std::vector<int> part_levels;
    for (const scene::Bounds& swept : d_.swept) part_levels.push_back(sizes.level(swept));
    d_.surfels = SurfelSet(d_.source, std::move(sizes), std::move(part_levels));
  }

  /// On the scene's own lamps as they are first, for surfels follow none that move; on those that are no
  /// wider [m], beside which light falls off within a surfel.
  std::vector<vec3> lamp_places(float widest) const {
    constexpr int per_group = 256;
    std::vector<mat4> poses;
    for (int part = 0; part < d_.source.part_count(); ++part) poses.push_back(d_.source.part_pose(part, 0));
    const auto light = d_.source.direct_light(d_.source.lights(0), poses);
    std::vector<vec3> places;
    if (!light) return places;
    for (std::size_t group = 0; group < d_.source.light_groups().size(); ++group) {
      const std::vector<vec3> of_group = light->emitter_places(static_cast<int>(group), widest, per_group);
      places.insert(places.end(), of_group.begin(), of_group.end());
    }
    return places;
  }

  void add_probe_hits() {
    const ProbeGBuffer& g = d_.gbuffer;
    std::vector<ClusterPoint> points;
    std::vector<std::size_t> owner;
    d_.seen.resize(g.hits.size());
    d_.seen_distance.resize(g.hits.size());
    bool emits = false;
    for (std::size_t i = 0; i < g.hits.size(); ++i) {
      const PackedHit& hit = g.hits[i];
      d_.seen[i] = {no_patch, g.seen_albedo(i)};
      d_.seen_distance[i] = hit.distance;
      emits |= hit.emission != 0;
      if (std::isinf(hit.distance)) continue;
      const rays::RayQuery ray{g.positions[i / g.directions.size()], g.directions[i % g.directions.size()]};
      points.push_back({{just_before(ray, hit.distance), unpack_normal(hit)}, unpack_albedo(hit)});
      owner.push_back(i);
    }
    if (points.empty())
      throw Error("transport", "no probe sees any surface", "move the probes to where the scene is");
    for (const MirroredHit& hit : g.mirrored)
      points.push_back({{just_before(hit.ray, hit.ray.t_max), hit.normal}, hit.albedo});
    const std::vector<int> surfel = d_.surfels.add(0, points);
    for (std::size_t k = 0; k < owner.size(); ++k) d_.seen[owner[k]].index = surfel[k];
    for (std::size_t k = 0; k < g.mirrored.size(); ++k) {
      d_.seen_mirrored.push_back({g.mirrored[k].owner,
                                  {surfel[owner.size() + k], pack_albedo(g.mirrored[k].albedo)},
                                  g.mirrored[k].share});
    }
    if (!emits) return;
    d_.seen_emission.resize(g.hits.size());
    for (std::size_t i = 0; i < g.hits.size(); ++i) d_.seen_emission[i] = g.hits[i].emission;
  }

  /// Traces rays of part 0 and adds what they meet to the surfels; `patch` of each ray, or no_patch. What
  /// they meet by way of panes follows after them all.
  void trace_and_add(std::vector<RawLink>& links) {
    std::vector<rays::RayQuery> rays;
    for (const RawLink& link : links) rays.push_back(link.ray);
    std::vector<rays::RayHit> hits(rays.size());
    d_.source.intersect(0, rays, hits);
    std::vector<ClusterPoint> points;
    std::vector<std::size_t> owner;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      links[i].ray.t_max = hits[i].distance;
      links[i].normal = hits[i].normal;
      links[i].patch = no_patch;
      links[i].share = mean_of(hits[i].through);
      links[i].of = i;
      if (hits[i].escaped()) continue;
      points.push_back({{just_before(rays[i], hits[i].distance), hits[i].normal}, hits[i].albedo});
      owner.push_back(i);
    }
    for (const MirrorSight& sight : follow_mirrors(d_.source, rays, hits)) {
      points.push_back({{just_before(sight.ray, sight.ray.t_max), sight.normal}, sight.albedo});
      owner.push_back(links.size());
      links.push_back({sight.ray, sight.normal, no_patch, mean_of(sight.share), sight.of, sight.from});
    }
    const std::vector<int> surfel = d_.surfels.add(0, points);
    for (std::size_t k = 0; k < points.size(); ++k)
      links[owner[k]].patch = d_.patch_at(surfel[k], points[k].point.position);
  }

  rays::RayQuery link_ray(const rays::SurfacePoint& from, std::uint32_t index, std::size_t surfel) const {
    return fan_ray(from, link_lift * d_.surfels.size(), index, surfel);
  }

  /// Traces the rays of each surfel, and of those that are found on the way, block by block; returns how many
  /// surfels had their turn. `add_rays(s, links)` appends a surfel's rays; `traced(links, b)` takes a block
  /// from b.
  template <typename AddRays, typename Traced>
  std::size_t in_rounds(const char* stage, std::size_t block, AddRays&& add_rays, Traced&& traced) {
    std::size_t begin = 0;
    for (int round = 0; round < most_rounds && begin < d_.surfels.count(); ++round) {
      const std::size_t end = d_.surfels.count();
      ProgressStage progress(control_, stage, end - begin, "surfels");
      for (std::size_t b = begin; b < end; b += block) {
        control_.check();
        const std::size_t stop = std::min(b + block, end);
        std::vector<RawLink> links;
        for (std::size_t s = b; s < stop; ++s) add_rays(s, links);
        trace_and_add(links);
        traced(links, b);
        progress.advance(stop - b);
      }
      begin = end;
    }
    return begin;
  }

  /// Lets surfels look around with few rays until no new ones are found.
  void discover() {
    const auto add_rays = [&](std::size_t s, std::vector<RawLink>& links) {
      const auto members = d_.surfels.members(static_cast<int>(s));
      for (std::uint32_t r = 0; r < discovery_rays; ++r) {
        links.push_back({link_ray(members[r % members.size()].point, r, s), vec3(0), no_patch});
      }
    };
    in_rounds("finding surfels", 8192, add_rays, [](const std::vector<RawLink>&, std::size_t) {});
  }

  /// Chooses every surfel's samples and traces its links; those that are found on the way follow.
  void link_static_surfels() {
    const auto add_rays = [&](std::size_t s, std::vector<RawLink>& links) {
      if (s * m() == d_.local_samples.size()) d_.choose_samples();
      const std::size_t used = d_.used_samples(s);
      for (std::uint32_t r = 0; r < rays_per_surfel(); ++r) {
        links.push_back({link_ray(d_.local_samples[s * m() + r % used], r, s), vec3(0), no_patch});
      }
    };
    const std::size_t begin = in_rounds("linking surfels", 4096, add_rays,
                                        [&](std::vector<RawLink>& links, std::size_t b) { keep(links, b); });
    // What the last round found has no links: dark, but of no weight.
    d_.choose_samples();
    for (std::size_t s = begin; s < d_.surfels.count(); ++s) {
      fixed_rows_.emplace_back(d_.fixed.size(), 0);
    }
  }

  std::size_t sample_of_ray(std::size_t s, std::size_t ray) const {
    return s * m() + ray % d_.used_samples(s);
  }

  /// Keeps of each link only the surfel and its share, and all of it where a part may come.
  void keep(std::vector<RawLink>& links, std::size_t first_surfel) {
    std::ranges::stable_sort(links, {}, &RawLink::of);
    std::vector<Link> fixed;
    for (std::size_t i = 0; i < links.size();) {
      const std::size_t begin = links[i].of / rays_per_surfel(), s = first_surfel + begin;
      const bool all_moving = near_parts_surfel(s);
      fixed.clear();
      for (; i < links.size() && links[i].of / rays_per_surfel() == begin; ++i) {
        const RawLink& link = links[i];
        const MovingRay moving{
            .ray = link.ray,
            .normal = link.normal,
            .patch = link.patch,
            .owner = static_cast<std::uint32_t>(s),
            .sample = static_cast<std::uint32_t>(sample_of_ray(s, link.of % rays_per_surfel())),
            .share = link.share,
            .from = link.from};
        if (all_moving || d_.near_parts(moving)) {
          d_.moving_links.push_back(moving);
        } else if (link.patch != no_patch) {
          fixed.push_back({static_cast<std::uint32_t>(link.patch), link.share});
        }
      }
      add_fixed_row(fixed);
    }
  }

  /// One link for each patch; `links` have shares of a ray as weights.
  void add_fixed_row(std::vector<Link>& links) {
    std::ranges::stable_sort(links, {}, &Link::patch);
    const float weight = 1 / static_cast<float>(d_.params.link_rays);
    const std::size_t first = d_.fixed.size();
    for (std::size_t i = 0; i < links.size();) {
      const std::uint32_t patch = links[i].patch;
      float rays = 0;
      for (; i < links.size() && links[i].patch == patch; ++i) rays += links[i].weight;
      d_.fixed.push_back({patch, weight * rays});
    }
    fixed_rows_.emplace_back(first, d_.fixed.size() - first);
  }

  /// Whether some part may come between a surfel and one of its samples.
  bool near_parts_surfel(std::size_t s) const {
    if (d_.swept.size() < 2) return false;
    for (std::size_t i = s * m(); i < (s + 1) * m(); ++i) {
      if (meets_any(d_.sample_segment(i), d_.swept)) return true;
    }
    return false;
  }

  /// Both faces of every part; a face that only sees its own part from inside lights nothing.
  void add_part_surfels() {
    for (int part = 1; part < d_.source.part_count(); ++part) {
      const double size = double{d_.surfels.size(d_.surfels.level(part, vec3(0)))};
      const double density = part_samples_per_surfel / (size * size);
      std::vector<ClusterPoint> points;
      for (const rays::PartPoint& p : d_.source.sample_part(part, density)) {
        points.push_back({p.point, p.albedo});
        points.push_back({{p.point.position, -p.point.normal}, p.albedo});
      }
      points = without_enclosed(part, points);
      d_.surfels.add(part, points);
    }
    d_.choose_samples();
    for (std::size_t s = d_.static_count; s < d_.surfels.count(); ++s) {
      const std::size_t used = d_.used_samples(s);
      for (std::size_t r = 0; r < rays_per_surfel(); ++r) {
        d_.part_links.push_back(
            link_ray(d_.local_samples[s * m() + r % used], static_cast<std::uint32_t>(r), s));
      }
    }
  }

  std::vector<ClusterPoint> without_enclosed(int part, const std::vector<ClusterPoint>& points) const {
    constexpr std::uint32_t rays_per_point = 16;
    std::vector<rays::RayQuery> rays;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::uint32_t r = 0; r < rays_per_point; ++r) rays.push_back(link_ray(points[i].point, r, i));
    }
    std::vector<std::uint8_t> blocked(rays.size());
    d_.source.occluded(part, rays, blocked);
    std::vector<ClusterPoint> open;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto first = blocked.begin() + static_cast<std::ptrdiff_t>(i * rays_per_point);
      if (std::count(first, first + rays_per_point, 1) < rays_per_point) open.push_back(points[i]);
    }
    return open;
  }

  void find_hidden_samples() {
    d_.samples = d_.local_samples;
    d_.sample_used = d_.sample_exists;
    if (d_.swept.size() < 2) return;
    for (std::size_t i = 0; i < d_.static_count * m(); ++i) {
      if (d_.sample_exists[i] && meets_any(d_.sample_segment(i), d_.swept))
        d_.hidden_samples.push_back(static_cast<std::uint32_t>(i));
    }
  }

  void find_moving_rays() {
    const ProbeGBuffer& g = d_.gbuffer;
    if (d_.swept.size() < 2) return;
    for (std::size_t i = 0; i < g.hits.size(); ++i) {
      const PackedHit& hit = g.hits[i];
      const rays::RayQuery ray{g.positions[i / g.directions.size()], g.directions[i % g.directions.size()],
                               hit.distance};
      const vec3 normal = std::isinf(hit.distance) ? vec3(0) : unpack_normal(hit);
      const MovingRay moving{.ray = ray,
                             .normal = normal,
                             .patch = d_.seen[i].index,
                             .albedo = d_.seen[i].albedo,
                             .owner = static_cast<std::uint32_t>(i),
                             .emission = hit.emission};
      if (d_.near_parts(moving)) d_.moving_hits.push_back(moving);
    }
    for (std::size_t k = 0; k < g.mirrored.size(); ++k) {
      const MirroredHit& hit = g.mirrored[k];
      const MovingRay moving{.ray = hit.ray,
                             .normal = hit.normal,
                             .patch = d_.seen_mirrored[k].patch.index,
                             .albedo = d_.seen_mirrored[k].patch.albedo,
                             .owner = static_cast<std::uint32_t>(k),
                             .from = hit.from};
      if (d_.near_parts(moving)) d_.moving_mirrored.push_back(moving);
    }
    add_part_emission();
  }

  /// The parts' emission must be in the palette before any pose looks it up.
  void add_part_emission() {
    for (std::size_t s = d_.static_count; s < d_.surfels.count(); ++s) {
      const Surfel& surfel = d_.surfels.surfels()[s];
      for (const ClusterPoint& member : d_.surfels.members(static_cast<int>(s))) {
        const rays::SurfacePoint& p = member.point;
        const rays::RayQuery ray{p.position + 0.5f * d_.surfels.size() * p.normal, -p.normal,
                                 d_.surfels.size()};
        rays::RayHit hit;
        d_.source.intersect(surfel.part, {&ray, 1}, {&hit, 1});
        if (d_.gbuffer.palette.add(hit.emission, hit.group) != 0 && d_.seen_emission.empty())
          d_.seen_emission.resize(d_.gbuffer.hits.size());
      }
    }
  }

  void make_fixed_rows() {
    d_.fixed.shrink_to_fit();
    d_.rows.rows.resize(d_.surfels.count());
    d_.rows.patches = m();
    for (std::size_t s = 0; s < fixed_rows_.size(); ++s)
      d_.rows.rows[s].fixed = {d_.fixed.data() + fixed_rows_[s].first, fixed_rows_[s].second};
  }

  TransportNetwork::Data& d_;
  const Control& control_;
  std::vector<std::pair<std::size_t, std::size_t>> fixed_rows_;  ///< first link and count, per surfel
};

}  // namespace

void TransportNetwork::Data::build(std::span<const vec3> positions, float start_time,
                                   const Control& control) {
  NetworkBuilder(*this, control).build(positions, start_time);
}

}  // namespace ssphh::transport
