#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/study/surface_points.h>

namespace ssphh::study {
namespace {

constexpr std::size_t lines_per_batch = 2048;
constexpr int most_crossings = 256;  ///< of one line
constexpr std::size_t nearest_origins = 16;
constexpr int scattered_rays = 16;
/// Lines per point wanted after which there is nothing to find.
constexpr std::size_t most_lines = 2000;

/// Whether places see an origin.
class Reach {
 public:
  Reach(const rays::PosedWorld& surfaces, std::span<const vec3> origins)
      : surfaces_(surfaces), origins_(origins), lift_(1e-4f * surfaces.bounds().radius()) {}

  /// reached[i] = 1 where point i sees one of the origins nearest to it.
  void sight(std::span<const rays::SurfacePoint> points, std::span<std::uint8_t> reached) const {
    std::vector<rays::RayQuery> segments;
    std::vector<std::size_t> of;
    std::vector<std::pair<float, std::size_t>> order;
    for (std::size_t i = 0; i < points.size(); ++i) {
      order.clear();
      const vec3 start = lifted(points[i]);
      for (std::size_t o = 0; o < origins_.size(); ++o) {
        const vec3 to = origins_[o] - start;
        if (glm::dot(to, points[i].normal) > 0) order.emplace_back(glm::dot(to, to), o);
      }
      const std::size_t kept = std::min(order.size(), nearest_origins);
      std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end());
      for (std::size_t k = 0; k < kept; ++k) {
        segments.push_back({start, origins_[order[k].second] - start, 1});
        of.push_back(i);
      }
    }
    std::vector<std::uint8_t> blocked(segments.size());
    surfaces_.occluded(segments, blocked);
    for (std::size_t s = 0; s < segments.size(); ++s) {
      if (!blocked[s]) reached[of[s]] = 1;
    }
  }

  /// The same by way of one diffuse reflection.
  void scattered(std::span<const rays::SurfacePoint> points, std::span<std::uint8_t> reached) const {
    std::vector<rays::RayQuery> rays;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (reached[i]) continue;
      const Frame frame = Frame::around(points[i].normal);
      for (int r = 0; r < scattered_rays; ++r) {
        const vec2 u((static_cast<float>(r) + 0.5f) / scattered_rays,
                     static_cast<float>(reverse_bits(static_cast<std::uint32_t>(r))) * 0x1p-32f);
        rays.push_back({lifted(points[i]), frame.to_world(sample_cosine_hemisphere(u))});
        of.push_back(i);
      }
    }
    std::vector<rays::RayHit> hits(rays.size());
    surfaces_.intersect(rays, hits);
    std::vector<rays::SurfacePoint> met;
    std::vector<std::size_t> met_of;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (hits[r].escaped()) continue;
      met.push_back({rays[r].origin + hits[r].distance * rays[r].direction, hits[r].normal});
      met_of.push_back(of[r]);
    }
    std::vector<std::uint8_t> sees(met.size(), 0);
    sight(met, sees);
    for (std::size_t m = 0; m < met.size(); ++m) {
      if (sees[m]) reached[met_of[m]] = 1;
    }
  }

  /// reached[i] = 0 where something stands nearer than `distance` before point i.
  void clear(std::span<const rays::SurfacePoint> points, float distance,
             std::span<std::uint8_t> reached) const {
    if (!(distance > 0)) return;
    std::vector<rays::RayQuery> segments;
    for (const rays::SurfacePoint& point : points)
      segments.push_back({lifted(point), point.normal, distance});
    std::vector<std::uint8_t> blocked(segments.size());
    surfaces_.occluded(segments, blocked);
    for (std::size_t i = 0; i < points.size(); ++i) reached[i] &= blocked[i] ? 0 : 1;
  }

 private:
  vec3 lifted(const rays::SurfacePoint& point) const { return point.position + lift_ * point.normal; }

  const rays::PosedWorld& surfaces_;
  std::span<const vec3> origins_;
  float lift_;
};

/// What of the box holds surfaces.
scene::Bounds part_within(const scene::Bounds& scene, const scene::Bounds& box) {
  const scene::Bounds part{glm::max(scene.min, box.min), glm::min(scene.max, box.max)};
  if (!glm::all(glm::lessThan(box.min, box.max)))
    throw Error("box", "it is none", "give the lower corner first, x0,y0,z0,x1,y1,z1");
  if (!glm::all(glm::lessThanEqual(part.min, part.max)))
    throw Error(
        "box", fmt::format("it lies outside of the scene, which reaches from {:g}, {:g}, {:g} to {:g}, {:g}, "
                           "{:g}",
                           scene.min.x, scene.min.y, scene.min.z, scene.max.x, scene.max.y, scene.max.z));
  return part;
}

/// Where a ray from within the box leaves it, in units of its direction.
float way_out(const scene::Bounds& box, const rays::RayQuery& ray) {
  float way = ray.t_max;
  for (glm::length_t c = 0; c < 3; ++c) {
    if (ray.direction[c] == 0) continue;
    const float side = ray.direction[c] > 0 ? box.max[c] : box.min[c];
    way = std::min(way, std::max((side - ray.origin[c]) / ray.direction[c], 0.0f));
  }
  return way;
}

/// All that a batch of isotropic random lines through the sphere around `part` meets in it, line after line.
std::vector<rays::SurfacePoint> cross(const rays::PosedWorld& surfaces, const scene::Bounds& part,
                                      std::uint64_t seed, std::size_t first_line) {
  const vec3 center = part.center();
  const float radius = 1.001f * part.radius(), step = 1e-5f * (1.001f * surfaces.bounds().radius());
  std::vector<rays::RayQuery> rays;
  for (std::size_t i = 0; i < lines_per_batch; ++i) {
    Pcg32 random(seed, first_line + i);
    const vec3 direction = sample_uniform_sphere(random.uniform2());
    const vec2 u = random.uniform2();
    const float r = radius * std::sqrt(u.x), angle = 2 * pi * u.y;
    const Frame frame = Frame::around(direction);
    rays.push_back(
        {center - radius * direction + frame.x * (r * std::cos(angle)) + frame.y * (r * std::sin(angle)),
         direction, 2 * radius});
  }

  // Go from one crossing to the next.
  struct Crossing {
    std::size_t line;
    rays::SurfacePoint point;
  };
  std::vector<Crossing> crossings;
  std::vector<std::size_t> line(rays.size());
  std::iota(line.begin(), line.end(), 0);
  std::vector<rays::RayHit> hits;
  std::vector<std::uint8_t> moves;
  for (int crossed = 0; crossed < most_crossings && !rays.empty(); ++crossed) {
    hits.resize(rays.size());
    moves.resize(rays.size());
    surfaces.intersect(rays, hits, moves);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].escaped()) continue;
      const vec3 position = rays[i].origin + hits[i].distance * rays[i].direction;
      crossings.push_back({line[i], {position, hits[i].normal, moves[i] != 0}});
      rays[kept] = {position + step * rays[i].direction, rays[i].direction,
                    rays[i].t_max - hits[i].distance - step};
      line[kept++] = line[i];
    }
    rays.resize(kept);
    line.resize(kept);
  }
  std::ranges::stable_sort(crossings, [](const Crossing& a, const Crossing& b) { return a.line < b.line; });
  // What lies in a side of the box lies in it, however the crossing was rounded.
  const scene::Bounds grown{part.min - step, part.max + step};
  std::vector<rays::SurfacePoint> points;
  for (const Crossing& crossing : crossings)
    if (within(grown, crossing.point.position)) points.push_back(crossing.point);
  return points;
}

}  // namespace

std::vector<rays::SurfacePoint> reachable_points(const rays::TransportSource& source,
                                                 std::span<const vec3> origins, float time,
                                                 const SurfacePointParams& params, const Control& control) {
  if (params.count <= 0) throw Error("surface points", fmt::format("{} points are none", params.count));
  if (origins.empty()) throw Error("surface points", "there is neither camera nor probe to see them from");
  const rays::PosedWorld surfaces(source, time);
  if (surfaces.bounds().empty()) throw Error("surface points", "the scene has no surfaces");

  const scene::Bounds part = params.box ? part_within(surfaces.bounds(), *params.box) : surfaces.bounds();

  const Reach reach(surfaces, origins);
  const auto wanted = static_cast<std::size_t>(params.count);
  std::vector<rays::SurfacePoint> points;
  ProgressStage progress(control, "surface points", wanted, "points");
  for (std::size_t line = 0; points.size() < wanted; line += lines_per_batch) {
    control.check();
    if (line > most_lines * wanted + 100 * lines_per_batch) {
      throw Error("surface points",
                  fmt::format("only {} of {} points{} can be reached from cameras and probes", points.size(),
                              wanted, params.box ? " in the box" : ""),
                  "place probes inside of what is to be lit");
    }
    const std::vector<rays::SurfacePoint> candidates = cross(surfaces, part, params.seed, line);
    std::vector<std::uint8_t> reached(candidates.size(), 0);
    reach.sight(candidates, reached);
    reach.scattered(candidates, reached);
    reach.clear(candidates, params.clearance, reached);
    const std::size_t before = points.size();
    for (std::size_t i = 0; i < candidates.size() && points.size() < wanted; ++i) {
      if (reached[i]) points.push_back(candidates[i]);
    }
    progress.advance(points.size() - before);
  }
  return points;
}

std::vector<rays::SurfacePoint> points_in_view(const rays::TransportSource& source,
                                               const scene::CameraPose& camera, float aspect, float time,
                                               int count, std::uint64_t seed) {
  if (count < 1) throw Error("surface points", fmt::format("{} is no number of points", count));
  const rays::PosedWorld surfaces(source, time);
  const vec3 eye(camera.world[3]), right = glm::normalize(vec3(camera.world[0]));
  const vec3 up = glm::normalize(vec3(camera.world[1])), forward = -glm::normalize(vec3(camera.world[2]));
  const bool parallel = camera.camera.orthographic;
  const float half = parallel ? camera.camera.yheight / 2 : std::tan(camera.camera.yfov / 2);
  std::vector<rays::RayQuery> rays;
  for (int i = 0; i < 8 * count; ++i) {
    Pcg32 random(seed + 2, static_cast<std::uint64_t>(i));
    const vec2 at = half * vec2(aspect, 1) * (2.0f * random.uniform2() - 1.0f);
    const vec3 aside = at.x * right + at.y * up;
    rays.push_back(parallel ? rays::RayQuery{eye + aside, forward}
                            : rays::RayQuery{eye, glm::normalize(forward + aside)});
  }
  std::vector<rays::RayHit> hits(rays.size());
  std::vector<std::uint8_t> moves(rays.size());
  surfaces.intersect(rays, hits, moves);
  std::vector<rays::SurfacePoint> points;
  for (std::size_t i = 0; i < rays.size() && points.size() < static_cast<std::size_t>(count); ++i) {
    if (!hits[i].escaped())
      points.push_back(
          {rays[i].origin + hits[i].distance * rays[i].direction, hits[i].normal, moves[i] != 0});
  }
  return points;
}

std::vector<std::uint8_t> sees_any(const rays::TransportSource& source,
                                   std::span<const rays::SurfacePoint> points, std::span<const vec3> places,
                                   float time) {
  const rays::PosedWorld surfaces(source, time);
  std::vector<std::uint8_t> seen(points.size(), 0);
  Reach(surfaces, places).sight(points, seen);
  return seen;
}

std::vector<rays::SurfacePoint> points_in_the_open(const rays::TransportSource& source,
                                                   std::span<const rays::SurfacePoint> surfaces, float time,
                                                   std::uint64_t seed,
                                                   const std::optional<scene::Bounds>& box) {
  const rays::PosedWorld posed(source, time);
  const float lift = 1e-4f * posed.bounds().radius();
  std::vector<rays::RayQuery> rays;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    Pcg32 random(seed, i);
    const vec3 direction =
        Frame::around(surfaces[i].normal).to_world(sample_cosine_hemisphere(random.uniform2()));
    rays.push_back({surfaces[i].position + lift * surfaces[i].normal, direction});
  }
  std::vector<rays::RayHit> hits(rays.size());
  posed.intersect(rays, hits);
  std::vector<rays::SurfacePoint> points;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].escaped()) continue;
    Pcg32 random(seed + 1, i);
    const float most = box ? std::min(hits[i].distance, way_out(*box, rays[i])) : hits[i].distance;
    const float way = (0.05f + 0.9f * random.uniform()) * most;
    points.push_back(
        {rays[i].origin + way * rays[i].direction, sample_uniform_sphere(random.uniform2()), true});
  }
  return points;
}

}  // namespace ssphh::study
