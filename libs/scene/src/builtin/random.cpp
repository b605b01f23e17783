#include <algorithm>

#include <ssphh/scene/query.h>

#include "random/draw.h"
#include "scenes.h"

namespace ssphh::scene {
namespace {

/// All lengths times `by`, with the light that keeps radiance what it was.
void scale_scene(Scene& scene, float by) {
  for (Node& node : scene.nodes) node.local.translation *= by;
  for (Mesh& mesh : scene.meshes) {
    for (vec3& position : mesh.positions) position *= by;
  }
  for (Material& material : scene.materials) material.thickness *= by, material.attenuation_distance *= by;
  for (Light& light : scene.lights) {
    light.radius *= by;
    if (light.type == LightType::point || light.type == LightType::spot) light.intensity *= by * by;
  }
}

constexpr float least_extent = 1e-3f, most_extent = 1e4f;

}  // namespace

/// A flat, a hall, a street or things on a table; half of them in metres, the others of 1 mm to 10 km.
Scene make_random(int seed) {
  RandomScene s{.draw = Draw(seed), .glass = Draw(seed, 0x91a55), .b = Builder("random")};
  Draw& draw = s.draw;
  const int kind = draw.pick(8);
  const bool night = draw.chance(0.4f);
  add_daylight(s, night ? Daylight::none : static_cast<Daylight>(1 + draw.pick(3)));
  if (kind < 4)
    add_flat(s);
  else if (kind == 4)
    add_hall(s);
  else if (kind == 5)
    add_street(s);
  else
    add_tabletop(s);
  if (draw.chance(0.5f)) {
    const float extent = 2 * world_bounds(s.b.scene(), world_matrices(s.b.scene())).radius();
    scale_scene(s.b.scene(), draw.scaled(least_extent, most_extent) / extent);
  }
  return s.b.finish();
}

}  // namespace ssphh::scene
