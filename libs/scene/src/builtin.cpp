#include <charconv>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/builtin.h>

#include "builtin/scenes.h"

namespace ssphh::scene {
namespace {

/// `setting` is "KEY=NUMBER".
Scene make_numbered(const BuiltinScene& scene, std::string_view setting) {
  const std::string whole = fmt::format("builtin:{}?{}", scene.name, setting);
  if (!scene.number) throw Error(whole, "this scene takes no number", "write builtin:" + scene.name);
  const BuiltinNumber& number = *scene.number;
  const auto equals = setting.find('=');
  const std::string_view digits = equals == setting.npos ? "" : setting.substr(equals + 1);
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool read = !digits.empty() && error == std::errc() && end == digits.data() + digits.size();
  if (setting.substr(0, equals) != number.key || !read || value < number.least || value > number.most) {
    throw Error(whole, "is not understood",
                fmt::format("write builtin:{}?{}=N with N from {} to {}", scene.name, number.key,
                            number.least, number.most));
  }
  return number.make(value);
}

}  // namespace

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
      {"house", "three furnished rooms behind glass and a corridor under sun and sky, on a plain of 250 m",
       make_house},
      {"ajar", "room lit past a red door: from a corridor, and by a lamp between the door and the wall",
       make_ajar},
      {"tunnel", "road tunnel of 870 m with a lamp every 30 m, open at both ends", make_tunnel},
      {"torch",
       "vault lit by a torch whose flames move, and by an SPHL that is a fire; both repeat after 2 s",
       make_torch},
      {"car", "a car with lamps drives through a dark garage in 4 s", make_car},
      {"fishtank",
       "dark room lit through the waves of a round tank whose lamp stands in the water; repeats after 4 s",
       make_fishtank},
      {"town", "that house again and again on a plain", [] { return make_town(8); },
       BuiltinNumber{"houses", 1, 4096, 8, make_town}},
      {"random", "flat, hall, street or table drawn by a seed, of 1 mm to 10 km, under light of any kind",
       [] { return make_random(0); }, BuiltinNumber{"seed", 0, 1'000'000'000, 0, make_random}},
  };
  return table;
}

Scene make_builtin(std::string_view name) {
  const auto mark = name.find('?');
  const std::string_view base = name.substr(0, mark);
  std::string names;
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.name == base)
      return mark == name.npos ? scene.make() : make_numbered(scene, name.substr(mark + 1));
    names += (names.empty() ? "" : ", ") + scene.name;
  }
  throw Error(fmt::format("builtin:{}", name), "no such built-in scene", "there are: " + names);
}

}  // namespace ssphh::scene
