#include "walk_scale.h"

namespace ssphh::viewer {

Walker walker_in(const View& view, const Walker& walker, const rays::PosedWorld& world) {
  float apart = 0;
  for (const float way : {1.0f, -1.0f}) {
    const rays::RayQuery ray{view.eye, vec3(0, way, 0)};
    rays::RayHit hit;
    world.intersect({&ray, 1}, {&hit, 1});
    if (hit.escaped()) return walker;
    apart += hit.distance;
  }
  return {apart > 100 * walker.eye ? 0.6f * apart : walker.eye};
}

}  // namespace ssphh::viewer
