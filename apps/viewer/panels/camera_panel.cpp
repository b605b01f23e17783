#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include "app.h"
#include "model/frame_files.h"
#include "model/lengths.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

void draw_chosen(App& app) {
  const auto i = static_cast<std::size_t>(app.camera);
  const std::string now = app.document.edits().cameras[i].name;
  row("name");
  char text[128] = "";
  now.copy(text, sizeof text - 1);
  if (ImGui::InputText("##name", text, sizeof text,
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll)) {
    attempt(app, [&] {
      app.document.edit_at_once("rename " + now, [&](Edits& e) { rename_camera(e, i, text); });
    });
  }
  tip("Enter takes it");
  if (ImGui::Button("Take this view")) {
    app.document.edit_at_once("view of " + now, [&](Edits& e) { e.cameras[i].view = app.view; });
    app.say(now + " has the view of now");
  }
  tip("the camera looks from here from now on");
  beside("Delete");
  if (!ImGui::Button("Delete")) return;
  app.document.edit_at_once("delete " + now,
                            [&](Edits& e) { e.cameras.erase(e.cameras.begin() + app.camera); });
  app.camera = -1;
  app.say("deleted: " + now);
}

void draw_cameras(App& app) {
  heading("Cameras");
  const auto count = static_cast<int>(app.document.edits().cameras.size());
  if (app.camera >= count) app.camera = -1;
  for (int i = 0; i < count; ++i) {
    const std::string name = app.document.edits().cameras[i].name;
    ImGui::PushID(i);
    if (ImGui::Selectable(name.empty() ? "(no name)" : name.c_str(), app.camera == i)) {
      app.camera = i;
      attempt(app, [&] { app.go_to_camera(name); });
    }
    ImGui::PopID();
  }
  if (count == 0) note("none");
  if (app.camera >= 0) draw_chosen(app);
  static char name[128] = "";
  row("new name");
  ImGui::InputText("##new", name, sizeof name);
  if (!wide_button("Save this view as a camera")) return;
  attempt(app, [&] {
    app.save_camera(name);
    name[0] = 0;
  });
}

void draw_view(App& app) {
  heading("View");
  View& view = app.view;
  const Lengths lengths = lengths_of(app.document.bounds);
  row("eye");
  if (ImGui::DragFloat3("##eye", glm::value_ptr(view.eye), 2 * lengths.step, 0, 0,
                        length_format(lengths.decimals)))
    app.redraw();
  if (view.orthographic) {
    row("height [m]");
    if (ImGui::DragFloat("##height", &view.yheight, 2 * lengths.step, lengths.step, 1e6f * lengths.step,
                         length_format(lengths.decimals)))
      app.redraw();
  } else {
    row("field of view");
    float degrees = glm::degrees(view.yfov);
    if (ImGui::SliderFloat("##fov", &degrees, 10, 120, "%.0f°"))
      view.yfov = glm::radians(degrees), app.redraw();
  }
  row("fly [m/s]");
  ImGui::DragFloat("##speed", &app.fly_speed, 5 * lengths.step, 5 * lengths.step, 5e4f * lengths.step,
                   length_format(lengths.decimals));
  row("eye height [m]");
  ImGui::DragFloat("##tall", &app.walker.eye, lengths.step, lengths.step, 1e4f * lengths.step,
                   length_format(lengths.decimals), ImGuiSliderFlags_AlwaysClamp);
  tip("Of who walks, above the ground.");
  if (wide_button(app.walking ? "Stop walking (V)" : "Walk (V)")) app.toggle_walk();
  if (wide_button("Frame everything (F)")) app.selection = {}, app.frame_selection();
}

/// The path as a sequence of pictures.
void draw_frames(App& app) {
  if (app.frames) {
    const float share = static_cast<float>(app.frames->done()) / static_cast<float>(app.frames->count());
    ImGui::ProgressBar(share, {-1, 0},
                       fmt::format("frame {} of {}", app.frames->done() + 1, app.frames->count()).c_str());
    if (wide_button("Stop (Escape)")) stop_frames(app);
    return;
  }
  if (app.bookmarks.empty()) return;
  static char folder[256] = "frames";
  static int fps = 30;
  file_row("frames in", folder);
  row("a second");
  ImGui::DragInt("##fps", &fps, 0.2f, 1, 240, "%d", ImGuiSliderFlags_AlwaysClamp);
  const std::filesystem::path first = std::filesystem::path(folder) / frame_name(0);
  if (save_button(app, "Draw the frames", "Replace the frames there", first, -1))
    attempt(app, [&] { export_frames(app, folder, fps); });
}

void draw_bookmarks(App& app) {
  heading("Bookmarks and path");
  CameraPath& path = app.bookmarks;
  int remove = -1;
  for (std::size_t i = 0; i < path.keys.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const CameraKey& key = path.keys[i];
    if (ImGui::Selectable(fmt::format("{:5.1f} s  {}", key.time, key.name).c_str(), false, 0,
                          {ImGui::GetContentRegionAvail().x - 30, 0})) {
      app.path_time = key.time;
      app.go_to(key);
    }
    ImGui::SameLine();
    if (ImGui::SmallButton("×")) remove = static_cast<int>(i);
    tip("delete");
    ImGui::PopID();
  }
  if (remove >= 0) path.keys.erase(path.keys.begin() + remove);
  if (wide_button("Add this view (B)")) app.add_bookmark();
  if (path.keys.size() > 1) {
    if (ImGui::Button(app.path_plays ? "Stop" : "Play")) {
      if (!app.path_plays && app.path_time >= path.keys.back().time) app.path_time = path.keys.front().time;
      app.path_plays = !app.path_plays;
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##at", &app.path_time, path.keys.front().time, path.keys.back().time, "%.2f s"))
      app.go_to(at(path, app.path_time));
  }
  static char file[256] = "path.json";
  file_row("file", file);
  if (save_button(app, "Save", "Replace", file)) attempt(app, [&] { app.save_path(file); });
  ImGui::SameLine();
  if (ImGui::Button("Open")) attempt(app, [&] { app.load_path(file); });
  draw_frames(app);
}

}  // namespace

void draw_camera_panel(App& app) {
  draw_cameras(app);
  draw_view(app);
  draw_bookmarks(app);
}

}  // namespace ssphh::viewer
