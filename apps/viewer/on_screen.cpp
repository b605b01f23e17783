#include "on_screen.h"

#include <algorithm>
#include <cmath>

#include "app.h"
#include "model/lengths.h"

namespace ssphh::viewer {
namespace {

float least_depth(const App& app) {
  return 0.1f * lengths_of(app.document.bounds).least;
}

}  // namespace

std::optional<ImVec2> on_screen(const App& app, const vec3& point) {
  const Rect2& r = app.viewport;
  const vec3 p = project(app.view, point, r.aspect());
  if (p.z <= least_depth(app)) return {};
  return ImVec2(r.x + p.x * r.width, r.y + (1 - p.y) * r.height);
}

float axis_length(const App& app, const vec3& point) {
  if (app.view.orthographic) return 0.12f * app.view.yheight;
  const float depth = std::max(project(app.view, point, app.viewport.aspect()).z, least_depth(app));
  return 0.24f * depth * std::tan(0.5f * app.view.yfov);
}

}  // namespace ssphh::viewer
