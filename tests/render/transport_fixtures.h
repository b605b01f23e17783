#pragma once
/// What the tests of light transport share: places, small networks, scenes turned and repainted.

#include <cmath>
#include <vector>

#include <ssphh/core/random.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/scene/query.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/relight_session.h>

#include "lit_session.h"
#include "root_4pi.h"

namespace ssphh::test {

/// The scene's own SPHLs.
inline std::vector<scene::ProbePlace> places_of(const scene::Scene& scene) {
  std::vector<scene::ProbePlace> places;
  for (const scene::ProbePlace& place : scene::sphl_places(scene))
    places.push_back({place.name, place.position, place.radius});
  return places;
}

/// Adds a diffuse body at a node of its own; returns the node.
inline int add_body(scene::Scene& scene, const std::string& name, scene::Mesh mesh, const vec3& albedo,
                    const vec3& emission = vec3(0), const vec3& place = vec3(0)) {
  scene::Node& node = scene.nodes.emplace_back();
  node.name = name;
  node.local.translation = place;
  scene::Material& look = scene.materials.emplace_back();
  look.base_color = albedo, look.specular = 0, look.emission = emission;
  mesh.material = static_cast<int>(scene.materials.size()) - 1;
  scene.meshes.push_back(std::move(mesh));
  scene::Instance& instance = scene.instances.emplace_back();
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  instance.node = static_cast<int>(scene.nodes.size()) - 1;
  return instance.node;
}

inline void add_sphl(scene::Scene& scene, const std::string& name, const vec3& place, float radius = 0.1f) {
  scene.nodes.emplace_back().local.translation = place;
  scene.sphls.push_back({name, static_cast<int>(scene.nodes.size()) - 1, radius});
}

/// The room [−1, 1]³ of six walls in different colours, the ceiling glowing with `glow`, and four SPHLs.
inline scene::Scene coloured_room(const vec3& glow) {
  scene::Scene scene;
  const auto wall = [&](const std::string& name, int axis, float side, const vec3& albedo,
                        const vec3& emission = vec3(0)) {
    vec3 corner(-1), u(0), v(0);
    u[(axis + 1) % 3] = 2, v[(axis + 2) % 3] = 2;
    corner[axis] = side;
    scene::Mesh quad = scene::make_quad(corner, u, v);
    add_body(scene, name, side < 0 ? quad : scene::flipped(quad), albedo, emission);
  };
  wall("left", 0, -1, {0.7f, 0.1f, 0.1f});
  wall("right", 0, 1, {0.1f, 0.6f, 0.2f});
  wall("floor", 1, -1, vec3(0.5f));
  wall("ceiling", 1, 1, vec3(0.6f), glow);
  wall("back", 2, -1, {0.2f, 0.3f, 0.8f});
  wall("front", 2, 1, vec3(0.75f));
  add_sphl(scene, "middle", {0, 0, 0});
  add_sphl(scene, "low", {0.4f, -0.7f, 0.3f});
  add_sphl(scene, "corner", {-0.6f, 0.5f, -0.6f});
  add_sphl(scene, "wall", {0.8f, 0.1f, -0.2f});
  scene::validate(scene);
  return scene;
}

/// A few hundred surfels: a network in a tenth of a second.
inline transport::TransportParams small_network() {
  transport::TransportParams params;
  params.directions = 256;
  params.surfel_size = 0.4f;
  params.link_rays = 64;
  return params;
}

/// builtin:box, every wall with this albedo and Le = 1, lit.
struct GlowingBox {
  explicit GlowingBox(float rho)
      : scene(painted(rho)), source(scene), session(source, places_of(scene), params()) {
    session.update();
  }
  static scene::Scene painted(float rho) {
    scene::Scene box = scene::make_builtin("box");
    for (scene::Material& material : box.materials) material.base_color = vec3(rho);
    return box;
  }
  static transport::RelightParams params() {
    transport::RelightParams p;
    p.transport = small_network();
    p.degree = 2;
    return p;
  }

  scene::Scene scene;
  trace::TransportScene source;
  LitSession session;
};

/// A box [low, high]³ seen from inside.
struct Walls {
  vec3 low, high;

  /// Wall 2·axis at the low end, 2·axis + 1 at the high end.
  rays::SurfacePoint at(int wall, const vec2& u) const {
    const int axis = wall / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
    rays::SurfacePoint p{low, vec3(0)};
    p.position[a] += u.x * (high[a] - low[a]);
    p.position[b] += u.y * (high[b] - low[b]);
    if (wall % 2 == 1) p.position[axis] = high[axis];
    p.normal[axis] = wall % 2 == 1 ? -1.0f : 1.0f;
    return p;
  }
  /// Square metres.
  double area(int wall) const {
    const int axis = wall / 2;
    const vec3 e = high - low;
    return double(e[(axis + 1) % 3]) * double(e[(axis + 2) % 3]);
  }
};

}  // namespace ssphh::test
