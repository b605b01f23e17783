#pragma once
/// Fields of a render and of what it gives (fields.h).

#include <ssphh/trace/render_state.h>

#include "path_fields.h"

namespace ssphh::test {

void fields(auto& visit, trace::Tile& t) {
  auto& [x, y, width, height] = t;
  visit("x", x), visit("y", y), visit("width", width), visit("height", height);
}
void fields(auto& visit, trace::RenderParams& p) {
  auto& [width, height, tile, camera, projection, path, per_group] = p;
  visit("width", width), visit("height", height), visit("tile", tile), visit("camera", camera);
  visit("projection", projection), visit("path", path), visit("per_group", per_group);
}
void fields(auto& visit, image::Image& i) {
  auto& [width, height, channels, pixels] = i;
  visit("width", width), visit("height", height), visit("channels", channels), visit("pixels", pixels);
}
void fields(auto& visit, trace::RenderState& s) {
  auto& [passes_done, paths, rays, color, direct, indirect, albedo, normal, depth, coverage, groups, key] = s;
  visit("passes_done", passes_done), visit("paths", paths), visit("rays", rays), visit("color", color);
  visit("direct", direct), visit("indirect", indirect), visit("albedo", albedo), visit("normal", normal);
  visit("depth", depth), visit("coverage", coverage), visit("groups", groups), visit("key", key);
}

}  // namespace ssphh::test
