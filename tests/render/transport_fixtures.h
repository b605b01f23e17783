#pragma once
/// What the tests of light transport share: places, small networks, scenes turned and repainted.

#include <cmath>
#include <vector>

#include <ssphh/core/random.h>
#include <ssphh/gi/relight_session.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::test {

/// The scene's own SPHLs.
inline std::vector<gi::ProbePlace> places_of(const scene::Scene& scene) {
  std::vector<gi::ProbePlace> places;
  for (const scene::SphlPlace& place : scene::sphl_places(scene))
    places.push_back({place.name, place.position, place.radius});
  return places;
}

inline std::vector<vec3> positions_of(const std::vector<gi::ProbePlace>& places) {
  std::vector<vec3> positions;
  for (const gi::ProbePlace& place : places) positions.push_back(place.position);
  return positions;
}

/// A few hundred surfels: a network in a tenth of a second.
inline gi::TransportParams small_network() {
  gi::TransportParams params;
  params.directions = 256;
  params.surfel_size = 0.4f;
  params.link_rays = 64;
  return params;
}

/// A box [low, high]³ seen from inside.
struct Walls {
  vec3 low, high;

  /// Wall 2·axis at the low end, 2·axis + 1 at the high end.
  scene::SurfacePoint at(int wall, const vec2& u) const {
    const int axis = wall / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
    scene::SurfacePoint p{low, vec3(0)};
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

/// The same scene turned about the origin as a whole, animations, lights and SPHLs included.
inline scene::Scene turned(scene::Scene scene, const quat& rotation) {
  scene::Node root;
  root.name = "turned";
  root.local.rotation = rotation;
  for (scene::Node& node : scene.nodes) ++node.parent;
  scene.nodes.insert(scene.nodes.begin(), root);
  for (scene::Instance& instance : scene.instances) {
    if (instance.light_group.empty()) instance.light_group = scene::light_group(scene, instance);
    ++instance.node;
  }
  for (scene::Camera& camera : scene.cameras) ++camera.node;
  for (scene::Light& light : scene.lights) ++light.node;
  for (scene::Sphl& sphl : scene.sphls) ++sphl.node;
  for (scene::Animation& animation : scene.animations) {
    for (scene::AnimationChannel& channel : animation.channels) ++channel.node;
  }
  return scene;
}

}  // namespace ssphh::test
