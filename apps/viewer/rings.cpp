#include "rings.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app.h"
#include "model/lamp_aim.h"
#include "model/lengths.h"
#include "on_screen.h"

namespace ssphh::viewer {
namespace {

constexpr int corners = 72;
/// Of the axes' length: beyond their handles, and nearer than the one that aims.
constexpr float ring_size = 1.32f, turn_size = 1.16f;
constexpr float reach = 6;  ///< of the mouse [pixels]

/// About the world's axes, and about the aim of a lamp where that turn is seen.
std::vector<Ring> rings_of(const App& app) {
  const auto origin = app.aim_origin();
  if (!origin) return {};
  const float length = axis_length(app, *origin);
  std::vector<Ring> rings;
  for (int i = 0; i < 3; ++i) {
    vec3 axis(0);
    axis[i] = 1;
    rings.push_back({*origin, axis, ring_size * length});
  }
  const auto i = static_cast<std::size_t>(app.selection.index);
  if (has_turn(app.document.edits().lights[i].lamp))
    rings.push_back({*origin, -light_direction(app.document.lighting().lights[i].world), turn_size * length});
  return rings;
}

/// Whether a point of a ring is not on the far side of the ball that the ring lies on.
bool faces_eye(const App& app, const Ring& ring, const vec3& point) {
  const vec3 to_eye =
      app.view.orthographic ? -app.view.forward() : glm::normalize(app.view.eye - ring.center);
  return glm::dot(point - ring.center, to_eye) > -0.15f * ring.radius;
}

}  // namespace

std::optional<RingUnderMouse> ring_under_mouse(const App& app, float x, float y) {
  std::optional<RingUnderMouse> nearest;
  float least = reach;
  const std::vector<Ring> rings = rings_of(app);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const std::vector<vec3> points = ring_points(rings[i], corners);
    for (std::size_t k = 1; k < points.size(); ++k) {
      const auto a = on_screen(app, points[k - 1]), b = on_screen(app, points[k]);
      if (!a || !b || !faces_eye(app, rings[i], points[k])) continue;
      const vec2 from(a->x, a->y), way = vec2(b->x, b->y) - from;
      const float along =
          std::clamp(glm::dot(vec2(x, y) - from, way) / std::max(glm::dot(way, way), 1e-6f), 0.0f, 1.0f);
      const float distance = glm::distance(vec2(x, y), from + along * way);
      if (distance >= least) continue;
      least = distance;
      nearest = {static_cast<int>(i), rings[i], glm::mix(points[k - 1], points[k], along)};
    }
  }
  return nearest;
}

float place_step(const App& app) {
  const Settings& s = app.settings;
  if (s.snap == ImGui::GetIO().KeyCtrl) return 0;
  return s.snap_step > 0 ? s.snap_step : snap_step(lengths_of(app.document.bounds));
}

float angle_step(const App& app) {
  return app.settings.snap == ImGui::GetIO().KeyCtrl ? 0 : glm::radians(app.settings.snap_angle);
}

void draw_rings(const App& app, ImDrawList& list) {
  const bool drags = app.drag.what == Drag::What::ring;
  const std::vector<Ring> rings = rings_of(app);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const ImU32 color = i < 3 ? axis_colors[i] : chosen_color;
    const bool active = drags && app.drag.ring.ring.axis == rings[i].axis;
    // Runs of one look, each a line
    std::vector<ImVec2> line;
    bool front = true;
    const auto end = [&] {
      const ImU32 alpha = front ? IM_COL32(0, 0, 0, 255) : IM_COL32(0, 0, 0, 50);
      list.AddPolyline(line.data(), static_cast<int>(line.size()), color & (alpha | 0x00ffffffu), 0,
                       active ? 3.5f : 2.0f);
      line.clear();
    };
    for (const vec3& point : ring_points(rings[i], corners)) {
      const auto at = on_screen(app, point);
      const bool faces = active || faces_eye(app, rings[i], point);
      // Eighths of pixels are the same on every processor.
      const ImVec2 steady = at ? ImVec2(std::round(8 * at->x) / 8, std::round(8 * at->y) / 8) : ImVec2();
      if (!line.empty() && (!at || faces != front)) {
        if (at) line.push_back(steady);
        end();
      }
      front = faces;
      if (at) line.push_back(steady);
    }
    if (!line.empty()) end();
  }
  if (!drags) return;
  // From where it was taken to where it is
  const RingGrip& grip = app.drag.ring;
  const auto center = on_screen(app, grip.ring.center);
  const auto at = [&](float angle) {
    return on_screen(
        app, grip.ring.center + grip.ring.radius * glm::angleAxis(angle, grip.ring.axis) * grip.grabbed);
  };
  for (const float angle : {0.0f, app.drag.turned}) {
    const auto end = at(angle);
    if (center && end) list.AddLine(*center, *end, IM_COL32(255, 255, 255, 150), 1.5f);
  }
}

void draw_drag_value(const App& app, ImDrawList& list) {
  using What = Drag::What;
  const What what = app.drag.what;
  const bool moves = what == What::object || what == What::axis;
  if (!app.drag.moved || !(moves || what == What::ring)) return;
  std::string text = fmt::format("{:+.1f}°", glm::degrees(app.drag.turned));
  if (moves) {
    const auto place = app.selected_position();
    if (!place) return;
    const int decimals = lengths_of(app.document.bounds).decimals;
    text =
        fmt::format("{:.{}f}, {:.{}f}, {:.{}f}", place->x, decimals, place->y, decimals, place->z, decimals);
    if (what == What::axis) {
      const int axis = app.drag.grip.axis;
      text = fmt::format("{} {:.{}f} m ({:+.{}f})", "xyz"[axis], (*place)[axis], decimals,
                         (*place)[axis] - app.drag.grip.start[axis], decimals);
    }
  }
  const ImVec2 mouse = ImGui::GetIO().MousePos, size = ImGui::CalcTextSize(text.c_str());
  const Rect2& r = app.viewport;
  const float gap = ImGui::GetFontSize();
  const float x = std::min(mouse.x + gap, r.x + r.width - size.x - 8);
  const float y = std::max(mouse.y - gap - size.y, r.y + 4);
  list.AddRectFilled({x - 5, y - 3}, {x + size.x + 5, y + size.y + 3}, IM_COL32(20, 20, 22, 200), 3);
  list.AddText({x, y}, IM_COL32_WHITE, text.c_str());
}

}  // namespace ssphh::viewer
