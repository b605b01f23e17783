#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

ImTextureID texture_id(unsigned texture) {
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));  // ImGui's way with OpenGL
}

void draw_welcome(App& app) {
  const Rect2& r = app.area;
  const JobStatus status = app.job.status();
  const std::string loading =
      status.running ? fmt::format("{} … {:.0f} s", status.name, status.seconds) : std::string();
  const char* loads[] = {loading.c_str(), "", "", "Escape cancels"};
  const char* drops[] = {"Drop a scene here", ".glb .gltf .obj .ssphh.json", "", "or"};
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  float y = r.y + 0.42f * r.height;
  for (const char* line : status.running ? loads : drops) {
    const ImVec2 size = ImGui::CalcTextSize(line);
    list.AddText({r.x + 0.5f * (r.width - size.x), y}, IM_COL32(200, 200, 205, 255), line);
    y += 1.6f * size.y;
  }
  if (status.running) return;
  ImGui::SetNextWindowPos({r.x + 0.5f * r.width, y}, ImGuiCond_Always, {0.5f, 0});
  ImGui::Begin("welcome", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoBackground);
  if (ImGui::Button("Open… (Ctrl+O)")) app.ask_for_file(FileDialog::For::open);
  if (ImGui::Button("Look at two rooms")) attempt(app, [&] { app.request_open("builtin:two-rooms"); });
  tip("A built-in scene; the menu File has others.");
  ImGui::End();
}

/// A line over the picture's upper edge: what the user may want to do next. Returns its height with the
/// margin.
float draw_offer(App& app) {
  if (!app.panels || !app.scene_open() || !app.light.empty() || app.job.running()) return 0;
  const Rect2& r = app.area;
  ImGui::SetNextWindowPos({r.x + 0.5f * r.width, r.y + 14}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("offer", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::AlignTextToFramePadding();
  // In a small window text wraps and the button stands below.
  ImGui::PushTextWrapPos(0.9f * r.width);
  if (app.document.edits().sphls.empty()) {
    ImGui::TextUnformatted("This scene has no probes: only direct light is shown.");
  } else {
    ImGui::Text("%zu SPHLs, not lit yet.", app.document.edits().sphls.size());
    beside("Light them", 0.9f * r.width);
    if (ImGui::Button("Light them")) attempt(app, [&] { app.light_scene_probes(); });
  }
  ImGui::PopTextWrapPos();
  const char* place = r.width > 20 * ImGui::GetFontSize() ? "Place probes and light them" : "Place probes";
  if (r.width > 39 * ImGui::GetFontSize()) ImGui::SameLine();
  if (ImGui::Button(place)) attempt(app, [&] { app.place_probes(0); });
  const float high = ImGui::GetWindowHeight() + 14;
  ImGui::End();
  return high;
}

/// Over its lower edge: what was done, or went wrong. Returns its height with the margin.
float draw_message(App& app) {
  const double age = app.window.seconds() - app.message_since;
  const double stays = app.message_is_error ? 15 : 4;
  if (app.message.empty() || age > stays) return 0;
  const Rect2& r = app.area;
  ImGui::SetNextWindowPos({r.x + 0.5f * r.width, r.y + r.height - 14}, ImGuiCond_Always, {0.5f, 1});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("message", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
  if (app.message_is_error) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1, 0.5f, 0.45f, 1));
  ImGui::PushTextWrapPos(0.8f * r.width);
  ImGui::TextUnformatted(app.message.c_str());
  ImGui::PopTextWrapPos();
  if (app.message_is_error) ImGui::PopStyleColor();
  const float high = ImGui::GetWindowHeight() + 14;
  ImGui::End();
  return high;
}

}  // namespace

void draw_picture(const App& app) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Rect2& r = app.viewport;
  const ImVec2 from{r.x, r.y}, to{r.x + r.width, r.y + r.height};
  const bool truth = !app.beside && needs_truth(app.settings) && app.picture.has_truth();
  const float line =
      app.settings.show == Show::wipe && app.settings.debug != DebugView::leak ? app.settings.wipe : 0;
  // OpenGL's first row is the lowest one, a file's the highest.
  if (!app.beside && app.shows_instead()) {
    list.AddImage(texture_id(app.picture.instead_texture().id()), from, to);
  } else {
    list.AddImage(texture_id(app.picture.realtime_texture()), from, to, {0, 1}, {1, 0});
  }
  if (truth)
    list.AddImage(texture_id(app.picture.truth_texture()), {r.x + line * r.width, r.y}, to, {line, 0},
                  {1, 1});
  if (const gl::Texture* const outline = app.outline())
    list.AddImage(texture_id(outline->id()), from, to, {0, 1}, {1, 0});
}

void draw_panels(App& app) {
  const auto width = static_cast<float>(app.window.width()), height = static_cast<float>(app.window.height());
  float top = 0, left = 0, bottom = 0;
  if (app.panels) {
    draw_menu(app);
    top = ImGui::GetFrameHeight();
    bottom = ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y;
    left = draw_sidebar(app, top, height - top);
  }
  app.area = {left, top, std::max(width - left, 1.0f), std::max(height - top - bottom, 1.0f)};
  app.arrange_views();
  if (app.panels) draw_time_bar(app);
  if (!app.scene_open()) draw_welcome(app);
  // The keys are not read through something else.
  const float above = app.help ? 0 : draw_offer(app), below = draw_message(app);
  const Rect2& r = app.area;
  const Rect2 room{r.x, r.y + above, r.width, r.height - above - below};
  if (!app.help) draw_readings(app, room), draw_inspector(app, room);
  draw_help(app);
  draw_file_dialog(app);
  draw_question(app);
}

}  // namespace ssphh::viewer
