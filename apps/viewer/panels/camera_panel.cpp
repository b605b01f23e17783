#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

void draw_cameras(App& app) {
  heading("Cameras of the scene");
  for (const std::string& name : app.camera_names()) {
    if (ImGui::Selectable(name.c_str())) attempt(app, [&] { app.go_to_camera(name); });
  }
  if (app.document.scene->cameras.empty()) note("none");
}

void draw_view(App& app) {
  heading("View");
  View& view = app.view;
  row("eye");
  if (ImGui::DragFloat3("##eye", glm::value_ptr(view.eye), 0.02f, 0, 0, "%.2f")) app.redraw();
  if (view.orthographic) {
    row("height [m]");
    if (ImGui::DragFloat("##height", &view.yheight, 0.02f, 0.01f, 1e4f, "%.2f")) app.redraw();
  } else {
    row("field of view");
    float degrees = glm::degrees(view.yfov);
    if (ImGui::SliderFloat("##fov", &degrees, 10, 120, "%.0f°"))
      view.yfov = glm::radians(degrees), app.redraw();
  }
  row("fly [m/s]");
  ImGui::DragFloat("##speed", &app.fly_speed, 0.05f, 0.05f, 500, "%.2f");
  if (wide_button("Frame everything (F)")) app.selection = {}, app.frame_selection();
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
  if (ImGui::Button("Save")) attempt(app, [&] { app.save_path(file); });
  ImGui::SameLine();
  if (ImGui::Button("Open")) attempt(app, [&] { app.load_path(file); });
  note(fmt::format("ssphh view {} --path {} --export DIR draws the path as a sequence of pictures.",
                   app.document.source, file));
}

}  // namespace

void draw_camera_panel(App& app) {
  draw_cameras(app);
  draw_view(app);
  draw_bookmarks(app);
}

}  // namespace ssphh::viewer
