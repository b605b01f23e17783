#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include <ssphh/core/sphere.h>
#include <ssphh/place/lattice.h>
#include <ssphh/place/site.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/study/default_view.h>

namespace ssphh::study {
namespace {

using rays::PosedWorld;
using rays::RayHit;
using rays::RayQuery;

constexpr float closed_share = 0.75f;  ///< of the directions, for a place that counts as inside
constexpr float room_size = 1.0f;      ///< [m]; what is smaller is a thing, be it hollow
constexpr float inside_yfov = 0.96f;   ///< a wide lens, as rooms are photographed
constexpr float outside_yfov = 0.7f;

scene::CameraPose pose_of(const vec3& eye, const vec3& forward, float yfov) {
  scene::CameraPose pose;
  pose.camera.name = "default";
  pose.camera.yfov = yfov;
  pose.world = glm::mat4_cast(glm::quatLookAt(forward, vec3(0, 1, 0)));
  pose.world[3] = vec4(eye, 1);
  return pose;
}

/// Vertices in the world, of every instance some: a detailed plant does not outweigh the room it stands in.
std::vector<vec3> some_vertices(const scene::Scene& scene, float time) {
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  std::vector<vec3> out;
  for (const scene::Instance& instance : scene.instances) {
    const mat4 matrix = instance.node < 0 ? mat4(1) : world[instance.node];
    const std::vector<vec3>& positions = scene.meshes[instance.mesh].positions;
    const double root = std::sqrt(static_cast<double>(positions.size()));
    const auto step = static_cast<std::size_t>(std::max(1.0, root / 8));
    for (std::size_t i = 0; i < positions.size(); i += step) out.emplace_back(matrix * vec4(positions[i], 1));
  }
  return out;
}

/// The box around the vertices without outliers: a wide ground of few triangles does not count.
scene::Bounds core_box(const std::vector<vec3>& vertices) {
  scene::Bounds box;
  std::vector<float> along(vertices.size());
  const std::size_t off = vertices.size() / 10;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < vertices.size(); ++i) along[i] = vertices[i][axis];
    std::ranges::sort(along);
    const float low = along[off], high = along[along.size() - 1 - off], beyond = 0.5f * (high - low);
    box.min[axis] = std::max(along.front(), low - beyond),
    box.max[axis] = std::min(along.back(), high + beyond);
  }
  return box;
}

/// Places in the box, and between things.
std::vector<vec3> candidates(const scene::Bounds& box, const std::vector<vec3>& vertices) {
  constexpr int count = 128;
  std::vector<vec3> places;
  const auto vertex = [&](float share) {
    return vertices[static_cast<std::size_t>(share * static_cast<float>(vertices.size() - 1))];
  };
  for (int i = 0; i < count; ++i) {
    const vec3 share = place::spread_in_cube(i);
    places.push_back(glm::mix(box.min, box.max, 0.04f + 0.92f * share));
    // Two vertices of one wall have their middle in its plane, which rays from there would not meet.
    places.push_back(glm::mix(box.center(), 0.5f * (vertex(share.x) + vertex(share.y)), 0.999f));
  }
  return places;
}

/// What a fan of rays meets from one place.
struct Surroundings {
  std::vector<RayQuery> rays;
  std::vector<RayHit> hits;

  Surroundings(const PosedWorld& world, const vec3& place, std::span<const vec3> directions)
      : hits(directions.size()) {
    for (const vec3& direction : directions) rays.push_back({place, direction});
    world.intersect(rays, hits);
  }
  float share(const auto& is) const {
    return static_cast<float>(std::ranges::count_if(hits, is)) / static_cast<float>(hits.size());
  }
};

std::vector<vec3> fan(int count) {
  std::vector<vec3> directions;
  for (int i = 0; i < count; ++i) directions.push_back(spherical_fibonacci(i, count));
  return directions;
}

/// About how far one sees in a room of that extent, which may be a tunnel.
float size_of(const vec3& extent) {
  return std::min(glm::length(extent), 6 * extent.y);
}

/// Looks for views of an inside.
class Inside {
 public:
  Inside(const rays::TransportSource& source, const PosedWorld& world, const scene::Bounds& core, float time)
      : source_(source), world_(world), core_(core), size_(size_of(core.max - core.min)) {
    std::vector<mat4> poses;
    for (int part = 0; part < source.part_count(); ++part) poses.push_back(source.part_pose(part, time));
    light_ = source.direct_light(source.lights(time), poses);
  }

  struct Eye {
    vec3 place;
    bool closed;  ///< in most directions; else there is a ceiling, and an opening beside
  };
  /// That of somebody who stands below the place, if one could.
  std::optional<Eye> eye_at(const vec3& place) const {
    const float down = distance(place, {0, -1, 0}), up = distance(place, {0, 1, 0});
    if (!std::isfinite(down)) return std::nullopt;
    const float floor = place.y - down, height = std::min(place.y + up, core_.max.y) - floor;
    // Nobody knows the unit of what is higher than a tower.
    const bool metres = core_.max.y - core_.min.y < 500;
    const float stature = metres ? std::min(1.6f, 0.6f * height) : 0.6f * height;
    const vec3 eye(place.x, floor + stature, place.z);
    const Surroundings seen(world_, eye, fan_);
    const float met = seen.share([](const RayHit& hit) { return !hit.escaped(); });
    const float back = seen.share([](const RayHit& hit) { return !hit.escaped() && hit.back; });
    const float clearance = std::min(0.02f * size_, 0.8f * stature);  // of the floor, too
    const bool closed = met >= closed_share;
    if (!(closed || (met >= 0.5f && std::isfinite(up))) || back > 0.25f ||
        std::ranges::any_of(seen.hits, [&](const RayHit& hit) { return hit.distance < clearance; }))
      return std::nullopt;
    return Eye{eye, closed};
  }

  /// Whether light gets to some of what is seen from here.
  bool is_lit(const vec3& place) const {
    const Surroundings seen(world_, place, fan_);
    std::vector<rays::SurfacePoint> points;
    int lit = 0;
    for (std::size_t i = 0; i < seen.hits.size(); ++i) {
      const RayHit& hit = seen.hits[i];
      if (hit.escaped() ? source_.environment_group() >= 0 : max_component(hit.emission) > 0) {
        ++lit;
      } else if (!hit.escaped()) {
        points.push_back({seen.rays[i].origin + hit.distance * seen.rays[i].direction, hit.normal});
      }
    }
    std::vector<vec3> irradiance(points.size());
    std::vector<bool> reached(points.size());
    for (int group = 0; group < static_cast<int>(source_.light_groups().size()); ++group) {
      light_->irradiance(group, points, irradiance);
      for (std::size_t i = 0; i < points.size(); ++i)
        if (max_component(irradiance[i]) > 0) reached[i] = true;
    }
    lit += static_cast<int>(std::ranges::count(reached, true));
    return lit >= 3;
  }

  /// How good a picture this is: how far it looks and how much there is to see, without things in the way.
  float quality(const vec3& eye, const vec3& forward) const {
    constexpr int columns = 16, rows = 9;
    const mat3 axes(pose_of(eye, forward, inside_yfov).world);
    const float h = std::tan(0.5f * inside_yfov);
    std::vector<vec3> directions;
    for (int i = 0; i < columns * rows; ++i) {
      const vec2 at = 2.0f * (vec2(i % columns, i / columns) + 0.5f) / vec2(columns, rows) - 1.0f;
      directions.push_back(axes * glm::normalize(vec3(at.x * h * columns / rows, at.y * h, -1)));
    }
    const Surroundings seen(world_, eye, directions);
    float far = 0, edges = 0;
    for (std::size_t i = 0; i < seen.hits.size(); ++i) {
      const RayHit& hit = seen.hits[i];
      far += std::log(std::clamp(hit.escaped() ? 0.25f : hit.distance / size_, 1e-3f, 1.0f));
      if (i % columns > 0 && is_edge(hit, seen.hits[i - 1])) ++edges;
      if (i >= columns && is_edge(hit, seen.hits[i - columns])) ++edges;
    }
    const auto count = static_cast<float>(directions.size());
    const float near = seen.share([&](const RayHit& hit) { return hit.distance < 0.06f * size_; });
    const float open = seen.share([](const RayHit& hit) { return hit.escaped(); });
    const float back = seen.share([](const RayHit& hit) { return hit.back; });
    const float dark = source_.environment_group() >= 0 ? std::max(0.0f, open - 0.25f) : open;
    return far / count + edges / count - 3 * near - 2 * dark - 2 * back;
  }

 private:
  /// Whether two rays beside each other meet different things.
  static bool is_edge(const RayHit& a, const RayHit& b) {
    if (a.escaped() || b.escaped()) return a.escaped() != b.escaped();
    return glm::dot(a.normal, b.normal) < 0.9f || std::abs(std::log(a.distance / b.distance)) > 0.3f;
  }
  float distance(const vec3& from, const vec3& direction) const {
    return Surroundings(world_, from, {&direction, 1}).hits[0].distance;
  }

  const rays::TransportSource& source_;
  const PosedWorld& world_;
  scene::Bounds core_;
  float size_;  ///< of the core [m]
  std::unique_ptr<rays::DirectLight> light_;
  std::vector<vec3> fan_ = fan(place::fan_size);
};

std::optional<scene::CameraPose> inside_view(const rays::TransportSource& source, const PosedWorld& world,
                                             const scene::Bounds& core, const std::vector<vec3>& vertices,
                                             float time) {
  const vec3 extent = core.max - core.min;
  if (std::min(extent.x, extent.z) < room_size) return std::nullopt;
  const Inside inside(source, world, core, time);
  const std::vector<vec3> places = candidates(core, vertices);
  std::vector<vec3> eyes;
  std::size_t closed = 0;
  for (const vec3& place : places) {
    if (const auto eye = inside.eye_at(place)) eyes.push_back(eye->place), closed += eye->closed ? 1 : 0;
  }
  if (5 * closed < places.size()) return std::nullopt;

  struct Choice {
    vec3 eye, forward;
    float quality;
  };
  std::vector<Choice> choices;
  constexpr int headings = 24;
  for (const vec3& eye : eyes) {
    for (int i = 0; i < headings; ++i) {
      const float heading = 2 * pi * static_cast<float>(i) / headings;
      const vec3 forward = glm::normalize(vec3(std::cos(heading), -0.1f, std::sin(heading)));
      choices.push_back({eye, forward, inside.quality(eye, forward)});
    }
  }
  std::ranges::stable_sort(choices, std::greater(), &Choice::quality);
  for (std::size_t i = 0; i < std::min<std::size_t>(choices.size(), 64); ++i) {
    if (inside.is_lit(choices[i].eye)) return pose_of(choices[i].eye, choices[i].forward, inside_yfov);
  }
  return std::nullopt;
}

/// From in front, to the right and above: as near as the box still fits into a square picture.
scene::CameraPose outside_view(const scene::Bounds& box) {
  const vec3 away = glm::normalize(vec3(0.45f, 0.3f, 1));
  const mat3 axes = glm::mat3_cast(glm::quatLookAt(-away, vec3(0, 1, 0)));
  const float tangent = std::tan(0.5f * outside_yfov) / 1.08f;  // with a margin
  const vec3 center = box.center();
  float distance = 1e-3f;
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                 corner & 4 ? box.max.z : box.min.z);
    const vec3 local = glm::transpose(axes) * (p - center);
    distance = std::max(distance, local.z + std::max(std::abs(local.x), std::abs(local.y)) / tangent);
  }
  return pose_of(center + distance * away, -away, outside_yfov);
}

}  // namespace

scene::CameraPose default_view(const scene::Scene& scene, const rays::TransportSource& source, float time) {
  scene::check_indices(scene);
  const std::vector<vec3> vertices = some_vertices(scene, time);
  if (vertices.empty()) return pose_of(vec3(0), {0, 0, -1}, outside_yfov);
  const scene::Bounds core = core_box(vertices);
  const PosedWorld world(source, time);
  if (const auto inside = inside_view(source, world, core, vertices, time)) return *inside;
  return outside_view(core);
}

}  // namespace ssphh::study
