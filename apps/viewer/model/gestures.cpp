#include "gestures.h"

#include <cmath>

#include "pick.h"

namespace ssphh::viewer {
namespace {

Show next_comparison(Show shown) {
  return shown == Show::realtime ? Show::wipe
         : shown == Show::wipe   ? Show::truth
         : shown == Show::truth  ? Show::pixelated
                                 : Show::realtime;
}

vec3 unit(int axis) {
  vec3 direction(0);
  direction[axis] = 1;
  return direction;
}

}  // namespace

vec3 fly_direction(const std::function<bool(char key)>& held) {
  const auto axis = [&](char plus, char minus) {
    return static_cast<float>(held(plus)) - static_cast<float>(held(minus));
  };
  return {axis('D', 'A'), axis('E', 'Q'), axis('W', 'S')};
}

View dragged(const View& view, ViewDrag drag, const vec2& pixels, float height) {
  const vec2 turn = -0.005f * pixels;
  if (drag == ViewDrag::orbit) return orbited(view, turn.x, turn.y);
  if (drag == ViewDrag::look) return turned(view, turn.x, turn.y);
  const float seen = view.orthographic ? view.yheight : 2 * view.focus * std::tan(0.5f * view.yfov);
  return moved(view, seen / height * vec3(-pixels.x, pixels.y, 0));
}

View wheeled(const View& view, float notches) {
  return dollied(view, std::pow(0.9f, notches));
}

Settings after_key(Settings s, char key, bool animated) {
  if (key == ' ' && animated) s.play = !s.play;
  if (key == 'P') s.balls = !s.balls;
  if (key == 'L') s.lobes = !s.lobes, s.balls |= s.lobes;
  if (key == 'G') s.graph = !s.graph;
  if (key == 'T') s.show = next_comparison(s.show);
  if (key == 'J') s.histogram = !s.histogram;
  if (key == 'U') s.waveform = !s.waveform;
  if (key == 'M') s.views = s.views >= 4 ? 1 : s.views >= 2 ? 4 : 2;
  if (key == 'K') s.false_color = !s.false_color;
  if (key >= '1' && key <= '8') s.debug = static_cast<DebugView>(key - '1');
  if (key == '[') s.exposure -= 0.5f, s.auto_exposure = false;
  if (key == ']') s.exposure += 0.5f, s.auto_exposure = false;
  if (key == '\\') s.auto_exposure = !s.auto_exposure;
  return s;
}

Grip taken(const rays::RayQuery& ray, const vec3& place, int axis, const vec3& forward) {
  Grip grip{axis, place, vec3(0)};
  if (axis >= 0)
    grip.grabbed.x = along_axis(ray, place, unit(axis)).value_or(0);
  else
    grip.grabbed = on_plane(ray, place, forward).value_or(place);
  return grip;
}

std::optional<vec3> pulled(const Grip& grip, const rays::RayQuery& ray, const vec3& forward) {
  if (grip.axis >= 0) {
    const auto along = along_axis(ray, grip.start, unit(grip.axis));
    if (!along) return std::nullopt;
    return grip.start + (*along - grip.grabbed.x) * unit(grip.axis);
  }
  const auto point = on_plane(ray, grip.start, forward);
  if (!point) return std::nullopt;
  return grip.start + *point - grip.grabbed;
}

}  // namespace ssphh::viewer
