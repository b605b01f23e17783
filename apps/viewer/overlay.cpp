#include "overlay.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app.h"
#include "model/view_layout.h"
#include "on_screen.h"
#include "rings.h"

namespace ssphh::viewer {
namespace {

constexpr float lamp_radius = 8, handle_radius = 7;

const vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

bool near(const ImVec2& a, float x, float y, float distance) {
  return std::hypot(a.x - x, a.y - y) <= distance;
}

ImU32 display_color(const vec3& linear, int alpha = 255) {
  const float m = std::max(max_component(linear), 1e-6f);
  const auto channel = [&](float v) { return static_cast<int>(255 * std::pow(v / m, 1 / 2.2f)); };
  return IM_COL32(channel(linear.x), channel(linear.y), channel(linear.z), alpha);
}

void draw_lamps(const App& app, ImDrawList& list) {
  const std::vector<scene::LightState> lights = app.document.lighting().lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const scene::Light& light = app.document.scene->lights[i];
    if (light.type == scene::LightType::directional) continue;
    const auto at = on_screen(app, light_position(lights[i].world));
    if (!at) continue;
    const bool selected = app.selection == Selection{Kind::light, static_cast<int>(i)};
    const bool on = app.document.edits().lights[i].on && lights[i].intensity > 0;
    list.AddCircleFilled(*at, lamp_radius, IM_COL32(20, 20, 22, 160));
    if (on) list.AddCircleFilled(*at, lamp_radius - 3, display_color(lights[i].color));
    list.AddCircle(*at, lamp_radius, selected ? IM_COL32(255, 190, 80, 255) : IM_COL32(235, 235, 235, 220), 0,
                   selected ? 2.5f : 1.5f);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (selected || near(*at, mouse.x, mouse.y, lamp_radius + 3)) {
      list.AddText({at->x + lamp_radius + 5, at->y - 8}, IM_COL32(0, 0, 0, 200), light.name.c_str());
      list.AddText({at->x + lamp_radius + 4, at->y - 9}, IM_COL32(255, 255, 255, 255), light.name.c_str());
    }
  }
}

/// Figure 9 of the paper: edges of VIZ, the strong ones bright. Strength spans decades, so it is shown by its
/// logarithm.
void draw_graph(const App& app, const std::vector<unsigned char>& visible, ImDrawList& list) {
  const probes::ProbeSet& set = app.light.set();
  struct Line {
    float strength;
    std::size_t a, b;
  };
  static std::vector<Line> lines;
  lines.clear();
  float strongest = 0;
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    for (const int e : probes::select_neighbors(set.probes[i], app.settings.hier_params)) {
      const probes::Edge& edge = set.probes[i].edges[e];
      lines.push_back({edge.transfer, i, static_cast<std::size_t>(edge.from)});
      strongest = std::max(strongest, edge.transfer);
    }
  }
  constexpr std::size_t most = 4000;
  if (lines.size() > most) {
    std::nth_element(lines.begin(), lines.begin() + most, lines.end(),
                     [](const Line& a, const Line& b) { return a.strength > b.strength; });
    lines.resize(most);
  }
  for (const Line& line : lines) {
    const auto a = on_screen(app, set.probes[line.a].position),
               b = on_screen(app, set.probes[line.b].position);
    if (!a || !b) continue;
    const float share = std::clamp(1 + std::log10(line.strength / strongest) / 3, 0.0f, 1.0f);
    const bool dim = visible[line.a] == 0 && visible[line.b] == 0;
    const int alpha = static_cast<int>((dim ? 0.35f : 1.0f) * (30 + 200 * share));
    list.AddLine(*a, *b,
                 IM_COL32(static_cast<int>(90 + 165 * share), static_cast<int>(120 + 90 * share),
                          230 - static_cast<int>(150 * share), alpha),
                 1 + 2 * share);
  }
}

void draw_names(const App& app, const std::vector<unsigned char>& visible, ImDrawList& list) {
  const std::vector<probes::Probe>& probes = app.light.set().probes;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (!visible[i]) continue;
    if (const auto at = on_screen(app, probes[i].position))
      list.AddText({at->x + 8, at->y - 18}, IM_COL32(255, 255, 255, 220), probes[i].name.c_str());
  }
}

void draw_handles(const App& app, ImDrawList& list) {
  const auto position = app.selected_position();
  if (!position) return;
  const auto center = on_screen(app, *position);
  if (!center) return;
  const float length = axis_length(app, *position);
  for (int i = 0; i < 3; ++i) {
    const auto end = on_screen(app, *position + length * axes[i]);
    if (!end) continue;
    const bool active = app.drag.what == Drag::What::axis && app.drag.grip.axis == i;
    list.AddLine(*center, *end, axis_colors[i], active ? 4.0f : 2.5f);
    list.AddCircleFilled(*end, active ? handle_radius + 1 : handle_radius - 1, axis_colors[i]);
  }
  if (app.selection.is(Kind::sphl)) list.AddCircle(*center, 5, IM_COL32(255, 190, 80, 255), 0, 2);
}

std::optional<ImVec2> aim_handle(const App& app) {
  const auto origin = app.aim_origin();
  if (!origin) return {};
  const auto i = static_cast<std::size_t>(app.selection.index);
  const vec3 along = light_direction(app.document.lighting().lights[i].world);
  return on_screen(app, *origin + aim_length(app) * along);
}

/// Cones, radius and range of the selected lamp, and the handle that aims it.
void draw_lamp_shape(const App& app, ImDrawList& list) {
  if (!app.selection.is(Kind::light)) return;
  const auto i = static_cast<std::size_t>(app.selection.index);
  const Lamp& lamp = app.document.edits().lights[i].lamp;
  mat4 world = app.document.lighting().lights[i].world;
  if (const auto origin = app.aim_origin()) world = with_position(world, *origin);
  constexpr ImU32 color = IM_COL32(255, 190, 80, 170);
  // Eighths of pixels are the same on every processor.
  const auto steady = [&](const vec3& point) {
    auto at = on_screen(app, point);
    if (at) *at = {std::round(8 * at->x) / 8, std::round(8 * at->y) / 8};
    return at;
  };
  for (const std::vector<vec3>& line : lamp_lines(lamp, world, aim_length(app))) {
    for (std::size_t k = 1; k < line.size(); ++k) {
      const auto a = steady(line[k - 1]), b = steady(line[k]);
      if (a && b) list.AddLine(*a, *b, color, 1.5f);
    }
  }
  if (const auto handle = aim_handle(app)) {
    const bool active = app.drag.what == Drag::What::aim;
    list.AddCircleFilled(*handle, active ? handle_radius + 1 : handle_radius - 1,
                         IM_COL32(255, 190, 80, 255));
  }
}

void draw_wipe(const App& app, ImDrawList& list) {
  const Rect2& r = app.viewport;
  const float x = std::round(r.x + app.settings.wipe * r.width);
  list.AddLine({x, r.y}, {x, r.y + r.height}, IM_COL32(255, 255, 255, 200), 1.5f);
  const float y = r.y + 0.5f * r.height;
  list.AddCircleFilled({x, y}, 13, IM_COL32(25, 25, 28, 220));
  list.AddCircle({x, y}, 13, IM_COL32(255, 255, 255, 220), 0, 1.5f);
  list.AddTriangleFilled({x - 9, y}, {x - 4, y - 4}, {x - 4, y + 4}, IM_COL32_WHITE);
  list.AddTriangleFilled({x + 4, y + 4}, {x + 4, y - 4}, {x + 9, y}, IM_COL32_WHITE);
  const auto label = [&](const char* text, float at_x) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    const float left = at_x < x ? at_x - size.x : at_x;
    list.AddRectFilled({left - 6, r.y + 8}, {left + size.x + 6, r.y + 14 + size.y}, IM_COL32(20, 20, 22, 170),
                       3);
    list.AddText({left, r.y + 11}, IM_COL32_WHITE, text);
  };
  label("real time", x - 14);
  label("path traced", x + 14);
}

/// What the view is, where there are several or somebody walks in it, and a frame around the one at work.
void draw_sign(const App& app, ImDrawList& list) {
  const bool several = !app.others.empty();
  const Rect2& r = app.viewport;
  if (several)
    list.AddRect({r.x, r.y}, {r.x + r.width, r.y + r.height},
                 app.beside ? IM_COL32(70, 70, 74, 255) : IM_COL32(255, 190, 80, 255), 0, 0, 2);
  std::vector<std::string> texts;
  if (several) texts = {view_name(app.view)};
  if (app.walking) texts = {several ? texts[0] + ", walking" : "walking, V ends", "walking"};
  // The longest that there is room for
  const auto fits = [&](const std::string& t) { return ImGui::CalcTextSize(t.c_str()).x + 24 <= r.width; };
  const auto fitting = std::ranges::find_if(texts, fits);
  if (fitting == texts.end()) return;
  const ImVec2 size = ImGui::CalcTextSize(fitting->c_str());
  // Where neither offers, plots nor the legend stand
  const ImVec2 at{r.x + r.width - size.x - 12, r.y + r.height - size.y - 11};
  list.AddRectFilled({at.x - 6, at.y - 3}, {at.x + size.x + 6, at.y + size.y + 3}, IM_COL32(20, 20, 22, 170),
                     3);
  list.AddText(at, IM_COL32_WHITE, fitting->c_str());
}

}  // namespace

int lamp_under_mouse(const App& app, float x, float y) {
  const std::vector<scene::LightState> lights = app.document.lighting().lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (app.document.scene->lights[i].type == scene::LightType::directional) continue;
    const auto at = on_screen(app, light_position(lights[i].world));
    if (at && near(*at, x, y, lamp_radius + 3)) return static_cast<int>(i);
  }
  return -1;
}

float aim_length(const App& app) {
  const auto origin = app.aim_origin();
  const vec3 at = origin ? *origin : app.selected_position().value_or(app.view.center());
  // Beyond the coloured handles
  return 1.6f * axis_length(app, at);
}

bool aim_under_mouse(const App& app, float x, float y) {
  const auto handle = aim_handle(app);
  return handle && near(*handle, x, y, handle_radius + 4);
}

int axis_under_mouse(const App& app, float x, float y) {
  const auto position = app.selected_position();
  if (!position) return -1;
  const float length = axis_length(app, *position);
  for (int i = 0; i < 3; ++i) {
    const auto end = on_screen(app, *position + length * axes[i]);
    if (end && near(*end, x, y, handle_radius + 4)) return i;
  }
  return -1;
}

int probe_of_sphl(const App& app, int sphl) {
  const std::vector<SphlEdit>& sphls = app.document.edits().sphls;
  if (sphl < 0 || !sphls[sphl].enabled) return -1;
  const auto probe =
      std::count_if(sphls.begin(), sphls.begin() + sphl, [](const SphlEdit& s) { return s.enabled; });
  if (app.light.empty() || probe >= static_cast<std::ptrdiff_t>(app.light.set().probes.size())) return -1;
  return static_cast<int>(probe);
}

int sphl_of_probe(const App& app, int probe) {
  if (probe < 0) return -1;
  const std::vector<SphlEdit>& sphls = app.document.edits().sphls;
  for (std::size_t i = 0; i < sphls.size(); ++i) {
    if (sphls[i].enabled && probe-- == 0) return static_cast<int>(i);
  }
  return -1;
}

void draw_overlay(const App& app, const std::vector<unsigned char>& visible) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Rect2& r = app.viewport;
  list.PushClipRect({r.x, r.y}, {r.x + r.width, r.y + r.height});
  if (app.settings.graph && !app.light.empty()) draw_graph(app, visible, list);
  if (app.settings.names && !app.light.empty()) draw_names(app, visible, list);
  draw_lamps(app, list);
  draw_lamp_shape(app, list);
  draw_rings(app, list);
  draw_handles(app, list);
  if (!app.beside) draw_drag_value(app, list);
  if (app.settings.show == Show::wipe && !app.beside) draw_wipe(app, list);
  draw_sign(app, list);
  list.PopClipRect();
}

}  // namespace ssphh::viewer
