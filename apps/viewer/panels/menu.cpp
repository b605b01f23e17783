#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include <ssphh/scene/builtin.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

/// Scenes of before; those that are gone are grey, and can be taken out.
void draw_recent(App& app) {
  static std::vector<bool> there;
  const std::vector<std::string> recent = app.preferences.recent;
  std::error_code ignored;
  // Once for each time that it is opened: a file may lie on a slow disk.
  if (ImGui::IsWindowAppearing() || there.size() != recent.size()) {
    there.clear();
    for (const std::string& scene : recent) there.push_back(std::filesystem::exists(scene, ignored));
  }
  for (std::size_t i = 0; i < recent.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (there[i]) {
      if (ImGui::MenuItem(recent[i].c_str())) attempt(app, [&] { app.request_open(recent[i]); });
    } else {
      ImGui::TextDisabled("%s", recent[i].c_str());
      tip("This file is not there any more.");
      ImGui::SameLine();
      if (ImGui::SmallButton("Remove")) app.remember_scene(recent[i], false);
    }
    ImGui::PopID();
  }
}

void draw_file_menu(App& app) {
  if (ImGui::MenuItem("Open…", "Ctrl+O")) app.ask_for_file(FileDialog::For::open);
  if (ImGui::BeginMenu("Open recent", !app.preferences.recent.empty())) draw_recent(app), ImGui::EndMenu();
  if (ImGui::BeginMenu("Open a built-in scene")) {
    for (const scene::BuiltinScene& scene : scene::builtin_scenes()) {
      if (ImGui::MenuItem(scene.name.c_str()))
        attempt(app, [&] { app.request_open("builtin:" + scene.name); });
      tip(scene.description.c_str());
    }
    ImGui::EndMenu();
  }
  ImGui::MenuItem("Dropping a file on the window opens it, too", nullptr, false, false);
  ImGui::Separator();
  const bool open = app.scene_open();
  if (ImGui::MenuItem("Save scene", "Ctrl+S", false, open)) attempt(app, [&] { app.save(); });
  if (ImGui::MenuItem("Save scene as…", "Ctrl+Shift+S", false, open))
    app.ask_for_file(FileDialog::For::scene);
  if (ImGui::MenuItem("Save edits as overlay…", nullptr, false, open)) app.ask_for_overlay();
  tip("a small file that names the scene and holds lamps, cameras, SPHLs and what else was changed in it");
  if (ImGui::MenuItem("Save probes as…", nullptr, false, open && !app.light.empty()))
    app.ask_for_file(FileDialog::For::probes);
  if (ImGui::MenuItem("Save picture as…", "Ctrl+F12", false, open))
    app.ask_for_file(FileDialog::For::picture);
  tip("What is seen as a .png, or its linear radiance as an .exr, without balls, outline and panels.");
  if (ImGui::MenuItem("Show the picture in tev", "Shift+F12", false, open && app.elsewhere))
    attempt(app, [&] { app.show_elsewhere(); });
  tip("as linear radiance, and the truth where one is traced, in the viewer of HDR pictures tev, which must "
      "be running");
  if (ImGui::MenuItem("Save times of frames", nullptr, false, open))
    attempt(app, [&] { app.save_stats(app.free_file(".csv")); });
  tip("as a new .csv file in the current folder; the panel Times saves them under a name");
  ImGui::Separator();
  if (ImGui::MenuItem("Quit")) app.window.close();
}

void draw_edit_menu(App& app) {
  const std::string undo = app.document.history.undo_name(), redo = app.document.history.redo_name();
  if (ImGui::MenuItem(("Undo " + undo).c_str(), "Ctrl+Z", false, !undo.empty())) app.undo();
  if (ImGui::MenuItem(("Redo " + redo).c_str(), "Ctrl+Y", false, !redo.empty())) app.redo();
  ImGui::Separator();
  if (ImGui::MenuItem("Place an SPHL", "N", app.place_mode)) app.place_mode = !app.place_mode;
  if (ImGui::BeginMenu("Add a lamp")) draw_lamp_kinds(app), ImGui::EndMenu();
  const bool lamp = app.selection.is(Kind::light);
  if (ImGui::MenuItem("Duplicate the lamp", "Ctrl+D", false, lamp)) app.duplicate_lamp();
  if (ImGui::MenuItem("Aim the lamp", "X", app.aim_mode, app.can_aim())) app.aim_mode = !app.aim_mode;
  if (ImGui::MenuItem("Snap to steps", "Ctrl, dragging", app.settings.snap))
    app.settings.snap = !app.settings.snap;
  tip("Places and directions that are dragged in the picture go in steps, and freely with Ctrl. The steps "
      "stand in the panel Light, below the lamp.");
  if (ImGui::MenuItem("Delete", "Del", false, lamp || app.selection.is(Kind::sphl))) app.delete_selection();
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
  ImGui::MenuItem("Histogram", "J", &s.histogram);
  ImGui::MenuItem("Waveform", "U", &s.waveform);
  ImGui::MenuItem("False colours", "K", &s.false_color);
  ImGui::MenuItem("Panels", "Tab", &app.panels);
  if (ImGui::MenuItem("Values under the mouse", "I", app.inspecting)) app.toggle_inspector();
  ImGui::Separator();
  if (ImGui::BeginMenu("Views side by side")) {
    for (int count = 1; count <= most_views; ++count) {
      const char* const key = count == 3 ? nullptr : "M";
      if (ImGui::MenuItem(fmt::format("{}", count).c_str(), key, s.views == count)) s.views = count;
    }
    ImGui::EndMenu();
  }
  if (ImGui::MenuItem("Walk", "V", app.walking)) app.toggle_walk();
  tip("W A S D go on the ground at the eye's height, up to walls and along them; drags look around.");
  if (ImGui::MenuItem("From the front", "Num 1")) app.view_along({0, 0, -1});
  if (ImGui::MenuItem("From the right", "Num 3")) app.view_along({-1, 0, 0});
  if (ImGui::MenuItem("From above", "Num 7")) app.view_along({0, -1, 0});
  if (ImGui::MenuItem("Orthographic", "Num 5", app.view.orthographic)) app.toggle_orthographic();
  if (ImGui::MenuItem("View before", "Alt+Left")) app.view_back();
  if (ImGui::MenuItem("View after", "Alt+Right")) app.view_forward();
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
    // The whole path, its name, or nothing: what there is room for.
    const float margin = std::max(12.0f, 1.5f * ImGui::GetStyle().WindowPadding.x);
    const float room = ImGui::GetWindowWidth() - ImGui::GetCursorPosX() - margin;
    const std::string& source = app.document.source;
    for (const std::string& title : {source, std::filesystem::path(source).filename().string()}) {
      const float width = ImGui::CalcTextSize(title.c_str()).x;
      if (width > room) continue;
      ImGui::SameLine(ImGui::GetWindowWidth() - width - margin);
      ImGui::TextDisabled("%s", title.c_str());
      break;
    }
  }
  ImGui::EndMainMenuBar();
}

}  // namespace ssphh::viewer
