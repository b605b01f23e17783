#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include <ssphh/transport/network.h>

#include "app.h"
#include "model/lengths.h"
#include "overlay.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

/// Qualities with what each costs.
void draw_quality(App& app) {
  row("quality");
  const std::string now(name_of(app.settings.quality));
  const bool open = ImGui::BeginCombo("##quality", (now + (app.quality_by_hand() ? ", by hand" : "")).c_str(),
                                      ImGuiComboFlags_HeightLargest);
  if (!open)
    tip("How much is spent on the light that the window finds: window is soon there, the others are those of "
        "ssphh bake.");
  const LightKnown known = app.light_known();
  if (!open) return note(cost_text(app.settings.quality, known));
  for (const auto& [quality, name] : enum_table(Quality{})) {
    ImGui::PushID(static_cast<int>(quality));
    if (ImGui::Selectable(std::string(name).c_str(), quality == app.settings.quality))
      app.use_quality(quality);
    note(cost_text(quality, known));
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

void draw_source(App& app) {
  heading("Light of the probes");
  if (app.light.empty()) {
    note(app.document.edits().sphls.empty()
             ? "No probes: the picture has direct light only."
             : fmt::format("{} SPHLs that hold no light yet.", app.document.edits().sphls.size()));
  } else if (app.light.is_glance()) {
    note(fmt::format("{} probes at a glance: {}", app.light.set().probes.size(),
                     app.job.running() ? "their whole light is on its way."
                                       : "their whole light was cancelled, or cannot be found."));
  } else if (app.light.live()) {
    note(fmt::format(
        "{} probes, live: they follow lamps and doors by light transport between {} surface "
        "patches.",
        app.light.set().probes.size(), app.light.live_light()->session().network().surfel_count()));
  } else {
    note(fmt::format("{} probes, fixed ({}): they follow light groups only.", app.light.set().probes.size(),
                     app.light.origin()));
  }
  draw_quality(app);
  static float spacing = 0;
  row("spacing [m]");
  const Lengths lengths = lengths_of(app.document.bounds);
  ImGui::DragFloat("##spacing", &spacing, lengths.step, 0, 1e4f * lengths.step,
                   spacing > 0 ? length_format(lengths.decimals) : "automatic");
  tip("of placed probes; 0: some 100 to 200 of them");
  if (wide_button("Place probes")) attempt(app, [&] { app.place_probes(spacing); });
  if (!app.document.edits().sphls.empty() && (!app.light.live() || app.light.is_glance()) &&
      wide_button("Light them live"))
    attempt(app, [&] { app.light_scene_probes(); });
}

void draw_bake(App& app) {
  heading("Path traced: GEN and VIZ");
  bake::BakeParams& p = app.bake_params;
  row("samples");
  ImGui::SliderInt("##spp", &p.path.spp, 1, 256);
  tip("Paths per texel of a probe's cube map; the quality sets them, too.");
  row("bounces");
  ImGui::SliderInt("##depth", &p.path.max_depth, 1, 32);
  row("cube face");
  ImGui::SliderInt("##face", &p.face_size, 8, 128);
  const bool running = app.job.running();
  ImGui::BeginDisabled(running);
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  if (ImGui::Button("GEN, VIZ", {half, 0})) attempt(app, [&] { app.start_gen(false); });
  tip("path traces the light of every probe, then the edges between them; probes appear as they finish");
  ImGui::SameLine();
  if (ImGui::Button("VIZ alone", {half, 0})) attempt(app, [&] { app.start_gen(true); });
  tip("edges of the hierarchy beside the light that is there");
  ImGui::EndDisabled();
}

void draw_lookup(App& app) {
  heading("How surfaces take it");
  setting_widget(app, "lookup", "lookup");
  if (app.settings.lookup == probes::LookupMethod::irradiance) setting_widget(app, "weights", "weights");
  setting_slider(app, "bands", "degree", 0, probes::max_irradiance_degree, "%.0f");
  const std::size_t edges = app.light.empty() ? 0 : probes::edge_count(app.light.set());
  ImGui::BeginDisabled(edges == 0);
  setting_widget(app, "hierarchy", "hier");
  if (app.settings.hier) {
    setting_widget(app, "operator", "operator");
    setting_widget(app, "light", "layer");
  }
  setting_widget(app, "neighbours N′", "neighbors");
  setting_slider(app, "threshold P", "threshold", 0, 0.1f, "%.4f");
  ImGui::EndDisabled();
  if (edges == 0) note("The hierarchy needs edges: run VIZ.");
}

void draw_display(App& app) {
  heading("On the screen");
  setting_widget(app, "balls (P)", "balls");
  setting_widget(app, "coloured by", "ball");
  const Lengths lengths = lengths_of(app.document.bounds);
  setting_slider(app, "radius [m]", "ball-size", 0, 50 * lengths.step,
                 app.settings.ball_size > 0 ? length_format(lengths.decimals) : "automatic");
  setting_widget(app, "lobes (L)", "lobes");
  setting_widget(app, "graph (G)", "graph");
  setting_widget(app, "names", "names");
}

/// Coefficients of the selected probe by band: bars of all m, RGB as colours, negative ones downward.
void draw_coefficients(const sh::RadianceSh& light) {
  const float width = ImGui::GetContentRegionAvail().x, height = 5 * ImGui::GetTextLineHeight();
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(from, {from.x + width, from.y + height}, IM_COL32(30, 30, 32, 255), 3);
  float largest = 1e-9f;
  for (std::size_t k = 1; k < light.values.size(); ++k)
    largest = std::max(largest, max_component(glm::abs(light.values[k])));
  const float step = width / static_cast<float>(light.values.size()), middle = from.y + 0.5f * height;
  constexpr ImU32 colors[3] = {IM_COL32(230, 90, 80, 200), IM_COL32(100, 200, 100, 200),
                               IM_COL32(100, 140, 250, 200)};
  for (int l = 0; l <= light.degree(); ++l) {
    if (l % 2 == 1) {
      list.AddRectFilled({from.x + step * static_cast<float>(l * l), from.y},
                         {from.x + step * static_cast<float>((l + 1) * (l + 1)), from.y + height},
                         IM_COL32(255, 255, 255, 14));
    }
  }
  for (std::size_t k = 0; k < light.values.size(); ++k) {
    for (int c = 0; c < 3; ++c) {
      const float value = std::clamp(light.values[k][c] / largest, -1.0f, 1.0f);
      const float x = from.x + step * (static_cast<float>(k) + static_cast<float>(c) / 3);
      list.AddRectFilled({x, middle}, {x + std::max(step / 3 - 0.5f, 1.0f), middle - 0.48f * height * value},
                         colors[c]);
    }
  }
  ImGui::Dummy({width, height});
  if (ImGui::IsItemHovered()) {
    const auto k = static_cast<int>((ImGui::GetIO().MousePos.x - from.x) / step);
    if (k >= 0 && k < static_cast<int>(light.values.size())) {
      const int l = static_cast<int>(std::sqrt(static_cast<float>(k)));
      ImGui::SetTooltip("l = %d, m = %d:  %.4g  %.4g  %.4g", l, k - l * (l + 1), light[k].x, light[k].y,
                        light[k].z);
    }
  }
}

/// Edges of the selected probe, the strongest first; a click selects the neighbour.
void draw_neighbors(App& app, const probes::Probe& p) {
  if (p.edges.empty()) return;
  std::vector<const probes::Edge*> edges;
  for (const probes::Edge& edge : p.edges) edges.push_back(&edge);
  std::ranges::stable_sort(edges, std::ranges::greater{}, &probes::Edge::transfer);
  note("P, neighbour");
  const std::size_t shown = std::min<std::size_t>(edges.size(), 6);
  ImGui::BeginChild("neighbors", {0, (static_cast<float>(shown) + 1) * ImGui::GetTextLineHeightWithSpacing()},
                    true);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(edges.size()));
  int chosen = -1;
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const probes::Edge& edge = *edges[i];
      const std::string& name = app.light.set().probes[edge.from].name;
      ImGui::PushID(i);
      if (ImGui::Selectable(fmt::format("{:.5f}  {}", edge.transfer, name).c_str()))
        chosen = sphl_of_probe(app, edge.from);
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
  if (chosen >= 0) app.select({Kind::sphl, chosen});
}

void draw_selected(App& app) {
  const auto i = static_cast<std::size_t>(app.selection.index);
  const SphlEdit& sphl = app.document.edits().sphls[i];
  heading(sphl.name.c_str());
  const Lengths lengths = lengths_of(app.document.bounds);
  row("position");
  vec3 position = *app.selected_position();
  if (ImGui::DragFloat3("##position", glm::value_ptr(position), lengths.step, 0, 0,
                        length_format(lengths.decimals)))
    app.move_selected(position);
  seal_after_edit(app);
  row("VIZ radius");
  float radius = sphl.radius;
  const std::string metres = std::string(length_format(lengths.decimals + 1)) + " m";
  if (ImGui::DragFloat("##radius", &radius, 0.5f * lengths.step, 0.1f * lengths.step, 1e3f * lengths.step,
                       metres.c_str()))
    app.document.edit("radius of " + sphl.name, [&](Edits& e) { e.sphls[i].radius = radius; });
  seal_after_edit(app);
  if (ImGui::Button("Delete")) return app.delete_selection();
  const int probe = probe_of_sphl(app, app.selection.index);
  if (probe < 0) return;
  const probes::Probe& p = app.light.set().probes[probe];
  const vec3 mean = p.self.empty() ? vec3(0) : p.self[0] * 0.28209479f;
  ImGui::TextWrapped("mean radiance  %.3g %.3g %.3g", mean.x, mean.y, mean.z);
  ImGui::TextWrapped("degree %d, %zu edges", p.self.degree(), p.edges.size());
  draw_neighbors(app, p);
  if (!p.self.empty()) draw_coefficients(p.self);
  if (app.light.set().hierarchy) {
    note("with its neighbours' light:");
    draw_coefficients(app.light.set().hierarchy->sum[probe]);
  }
}

void draw_list(App& app) {
  const std::vector<SphlEdit>& sphls = app.document.edits().sphls;
  heading(fmt::format("SPHLs ({})", sphls.size()).c_str());
  if (ImGui::Button(app.place_mode ? "click a surface …" : "Place one (N)")) app.place_mode = !app.place_mode;
  ImGui::BeginChild("list", {0, 7 * ImGui::GetTextLineHeightWithSpacing()}, true);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(sphls.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      ImGui::PushID(i);
      bool enabled = sphls[i].enabled;
      if (ImGui::Checkbox("##enabled", &enabled))
        app.document.edit_at_once("switch SPHL", [&](Edits& e) { e.sphls[i].enabled = enabled; });
      ImGui::SameLine();
      if (ImGui::Selectable(sphls[i].name.c_str(), app.selection == Selection{Kind::sphl, i})) {
        app.selection = {Kind::sphl, i};
        app.settings.balls = true;
      }
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
  if (app.selection.is(Kind::sphl)) draw_selected(app);
}

void draw_files(App& app) {
  heading("File");
  static char file[256] = "probes.sphl";
  file_row("probes", file);
  if (save_button(app, "Save", "Replace", file)) attempt(app, [&] { app.save_probes(file); });
  ImGui::SameLine();
  if (ImGui::Button("Open")) attempt(app, [&] { app.take_probe_file(file); });
}

}  // namespace

void draw_probe_panel(App& app) {
  draw_source(app);
  draw_display(app);
  draw_list(app);
  draw_lookup(app);
  draw_bake(app);
  draw_files(app);
}

}  // namespace ssphh::viewer
