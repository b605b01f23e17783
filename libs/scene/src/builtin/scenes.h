#pragma once
/// The makers behind the table of builtin.cpp.

#include <ssphh/scene/scene.h>

namespace ssphh::scene {

Scene make_cornell();
Scene make_furnace();
Scene make_glowing_box();
Scene make_two_rooms();
Scene make_court();
Scene make_gallery1();
Scene make_gallery2();
Scene make_gallery3();
Scene make_house();
Scene make_ajar();
Scene make_tunnel();
Scene make_torch();
Scene make_car();
Scene make_fishtank();
Scene make_town(int houses);
Scene make_random(int seed);

}  // namespace ssphh::scene
