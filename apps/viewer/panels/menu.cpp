#include <fmt/format.h>
#include <imgui.h>

#include <ssphh/scene/builtin.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

void draw_file_menu(App& app) {
  if (ImGui::BeginMenu("Open a built-in scene")) {
    for (const scene::BuiltinScene& scene : scene::builtin_scenes()) {
      if (ImGui::MenuItem(scene.name.c_str()))
        attempt(app, [&] { app.request_open("builtin:" + scene.name); });
      tip(scene.description.c_str());
    }
    ImGui::EndMenu();
  }
  ImGui::MenuItem("Drop files on the window to open them", nullptr, false, false);
  ImGui::Separator();
  const bool open = app.scene_open();
  if (ImGui::MenuItem("Save scene", "Ctrl+S", false, open)) attempt(app, [&] { app.save(); });
  if (ImGui::MenuItem("Save probes as probes.sphl", nullptr, false, open && !app.light.empty()))
    attempt(app, [&] { app.save_probes("probes.sphl"); });
  if (ImGui::MenuItem("Save times as times.csv", nullptr, false, open))
    attempt(app, [&] { app.save_stats("times.csv"); });
  ImGui::Separator();
  if (ImGui::MenuItem("Quit")) app.window.close();
}

void draw_edit_menu(App& app) {
  const std::string undo = app.document.history.undo_name(), redo = app.document.history.redo_name();
  if (ImGui::MenuItem(("Undo " + undo).c_str(), "Ctrl+Z", false, !undo.empty())) app.undo();
  if (ImGui::MenuItem(("Redo " + redo).c_str(), "Ctrl+Y", false, !redo.empty())) app.redo();
  ImGui::Separator();
  if (ImGui::MenuItem("Place an SPHL", "N", app.place_mode)) app.place_mode = !app.place_mode;
  if (ImGui::MenuItem("Delete the SPHL", "Del", false, app.selection.is(Kind::sphl))) app.delete_selection();
}

void draw_view_menu(App& app) {
  Settings& s = app.settings;
  const char* names[] = {"All light", "Direct light only", "Indirect light only", "Albedo",
                         "Normals",   "Shadows",           "Chosen SPHL",         "Leaked light"};
  for (int i = 0; i < 8; ++i) {
    const auto view = static_cast<DebugView>(i);
    if (ImGui::MenuItem(names[i], fmt::format("{}", i + 1).c_str(), s.debug == view)) s.debug = view;
  }
  ImGui::Separator();
  const char* shows[] = {"Real time only",      "Ground truth only", "Wipe between both",
                         "Absolute difference", "Signed difference", "Difference in blocks"};
  for (int i = 0; i < 6; ++i) {
    const auto show = static_cast<Show>(i);
    if (ImGui::MenuItem(shows[i], nullptr, s.show == show)) s.show = show;
  }
  ImGui::Separator();
  ImGui::MenuItem("Probes as balls", "P", &s.balls);
  ImGui::MenuItem("Lobes", "L", &s.lobes);
  ImGui::MenuItem("Graph of the hierarchy", "G", &s.graph);
  ImGui::MenuItem("Panels", "Tab", &app.panels);
}

}  // namespace

void draw_menu(App& app) {
  if (!ImGui::BeginMainMenuBar()) return;
  if (ImGui::BeginMenu("File")) draw_file_menu(app), ImGui::EndMenu();
  if (ImGui::BeginMenu("Edit", app.scene_open())) draw_edit_menu(app), ImGui::EndMenu();
  if (ImGui::BeginMenu("View", app.scene_open())) draw_view_menu(app), ImGui::EndMenu();
  if (ImGui::BeginMenu("Help")) {
    ImGui::MenuItem("Mouse and keys", "F1", &app.help);
    ImGui::EndMenu();
  }
  if (app.scene_open()) {
    const std::string title = app.document.source;
    ImGui::SameLine(ImGui::GetWindowWidth() - ImGui::CalcTextSize(title.c_str()).x - 12);
    ImGui::TextDisabled("%s", title.c_str());
  }
  ImGui::EndMainMenuBar();
}

}  // namespace ssphh::viewer
