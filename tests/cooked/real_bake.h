#pragma once
/// Bakes of built-in scenes, each made once for all tests of the program, and the files that are cooked of
/// them.

#include <map>
#include <string>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/place/init.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

#include "cooked_room.h"

namespace ssphh::test {

/// Few rays: a file is compared with what it was made of, not with a truth.
struct RealBake {
  RealBake(scene::Scene scene_in, OnSurfaces on_surfaces) : scene(std::move(scene_in)), source(scene) {
    bake::TransportBakeParams params;
    params.transport.surfels_per_radius = 8;
    params.transport.directions = 128;
    params.transport.link_rays = 16;
    params.records = {.points = on_surfaces == OnSurfaces::records ? 600 : 0, .rays = 64};
    params.fit = on_surfaces == OnSurfaces::fitted;
    bake::TransportBakeReport report;
    set = bake::bake_transport(source, places(), params, report);
    const cook::CookScene cook_scene{scene, source};
    bytes = cook::cook(set, &cook_scene).bytes;
  }

  std::vector<vec3> origins() const {
    std::vector<vec3> out;
    for (const probes::Probe& probe : set.probes) out.push_back(probe.position);
    return out;
  }

  scene::Scene scene;
  trace::TransportScene source;
  probes::ProbeSet set;
  std::vector<std::byte> bytes;  ///< of the cooked file

 private:
  /// The scene's own SPHLs; 60 found where it has none.
  probes::ProbeSet places() const {
    if (!scene::sphl_places(scene).empty()) return place::init_from_scene(scene, 5);
    place::PlaceParams found = place::place_params(scene);
    found.count = 60;
    return place::init_from_placement(scene, place::place_probes(source, found), 5);
  }
};

/// Room B of two-rooms is dark: a lamp of another group there, and two probes' light has two sources.
inline scene::Scene lit_two_rooms() {
  scene::Scene scene = scene::make_builtin("two-rooms");
  scene::Light lamp = scene.lights.at(0);
  lamp.name = lamp.group = "lamp B";
  scene::Node node = scene.nodes.at(static_cast<std::size_t>(lamp.node));
  node.name = lamp.name;
  node.local.translation.x = -node.local.translation.x;
  lamp.node = static_cast<int>(scene.nodes.size());
  lamp.color = vec3(0.5f, 1, 2);
  scene.nodes.push_back(node);
  scene.lights.push_back(lamp);
  return scene;
}

/// Of a built-in scene, or lit_two_rooms() ("rooms").
inline const RealBake& real_bake(const std::string& name, OnSurfaces on_surfaces = OnSurfaces::records) {
  static std::map<std::pair<std::string, OnSurfaces>, RealBake> bakes;
  const std::pair key(name, on_surfaces);
  if (const auto found = bakes.find(key); found != bakes.end()) return found->second;
  return bakes.try_emplace(key, name == "rooms" ? lit_two_rooms() : scene::make_builtin(name), on_surfaces)
      .first->second;
}

}  // namespace ssphh::test
