// Walking through the scene.

#include "app.h"
#include "model/walk_scale.h"

namespace ssphh::viewer {

void App::toggle_walk() {
  redraw();
  if (walking) {
    walking = false;
    return say("flying again");
  }
  const rays::PosedWorld world(*picking_, document.time);
  const auto place = above_ground(view, world);
  if (!place) return say("there is no ground to walk on, below or ahead; go above some first");
  walker = walker_in(*place, walker, world);
  view = stood(*place, walker, world).value_or(*place);
  walking = true, path_plays = false;
  say("walking: W A S D, Shift runs, drags look around; V or Escape ends");
}

void App::walk(const vec2& way, float seconds) {
  if (view.orthographic || path_plays) walking = false;
  if (!walking) return;
  const View next = walked(view, walker.speed() * seconds * way, walker,
                           rays::PosedWorld(*picking_, document.time), seconds);
  if (next == view) return;
  view = next;
  redraw();
}

}  // namespace ssphh::viewer
