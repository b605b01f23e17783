#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/builtin.h>

#include "builtin/scenes.h"

namespace ssphh::scene {

const std::vector<BuiltinScene>& builtin_scenes() {
  static const std::vector<BuiltinScene> table = {
      {"cornell", "Cornell box of 2 m with an area light, a red and a green wall, two boxes", make_cornell},
      {"furnace", "sphere of albedo 0.5 under an environment of radiance 1: it leaves exactly 0.5",
       make_furnace},
      {"box", "closed box seen from inside, Le = 1, albedo 0.5: radiance 2 everywhere", make_glowing_box},
      {"two-rooms", "two rooms, a doorway, a door that opens from time 0 to 1, a lamp in room A",
       make_two_rooms},
      {"court", "open court under a smooth sky of degree 2 that shows how it is turned; no other light",
       make_court},
      {"gallery1", "gallery lit by hidden lamps: colour bleeding from walls and panels to white bodies",
       make_gallery1},
      {"gallery2", "gallery lit by hidden lamps: spheres, boxes, tori and columns on plinths", make_gallery2},
      {"gallery3", "gallery lit by hidden lamps: torus knots and spirals", make_gallery3},
      {"house", "three furnished rooms and a corridor under sun and sky, on a plain of 250 m", make_house},
  };
  return table;
}

Scene make_builtin(std::string_view name) {
  std::string names;
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.name == name) return scene.make();
    names += (names.empty() ? "" : ", ") + scene.name;
  }
  throw Error(fmt::format("builtin:{}", name), "no such built-in scene", "there are: " + names);
}

}  // namespace ssphh::scene
