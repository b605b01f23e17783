#pragma once
/// Fields of light paths and cameras (fields.h).

#include <ssphh/rays/radiance_source.h>

#include "fields.h"

namespace ssphh::test {

void fields(auto& visit, rays::PathParams& p) {
  auto& [max_depth, passes, spp, seed] = p;
  visit("max_depth", max_depth), visit("passes", passes), visit("spp", spp), visit("seed", seed);
}
void fields(auto& visit, scene::Camera& c) {
  auto& [name, node, orthographic, yfov, yheight, aspect] = c;
  visit("name", name), visit("node", node), visit("orthographic", orthographic), visit("yfov", yfov);
  visit("yheight", yheight), visit("aspect", aspect);
}
void fields(auto& visit, scene::CameraPose& p) {
  auto& [world, camera] = p;
  visit("world", world), visit("camera", camera);
}

}  // namespace ssphh::test
