#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

void draw_job(App& app, const JobStatus& status) {
  const std::string text =
      status.fraction < 0 ? fmt::format("{} … {:.0f} s", status.name, status.seconds)
                          : fmt::format("{}: {} {:.0f} %", status.name, status.stage, 100 * status.fraction);
  ImGui::SetNextItemWidth(18 * ImGui::GetFontSize());
  ImGui::ProgressBar(status.fraction < 0 ? 0.0f : static_cast<float>(status.fraction),
                     {18 * ImGui::GetFontSize(), 0}, text.c_str());
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) app.job.cancel();
}

void draw_summary(const App& app) {
  const FrameTimes& times = app.times;
  double frame = 0, relight = 0;
  for (const FrameTimes::Stage& stage : times.stages()) {
    if (stage.name == "frame") frame = static_cast<double>(stage.ms.median());
    if (stage.name == "relight") relight = static_cast<double>(stage.ms.median());
  }
  const std::string text = fmt::format("{} probes   frame {:.1f} ms   relight {:.1f} ms",
                                       app.light.empty() ? 0 : app.light.set().probes.size(), frame, relight);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", text.c_str());
}

}  // namespace

void draw_time_bar(App& app) {
  const Rect2& r = app.viewport;
  ImGui::SetNextWindowPos({r.x, r.y + r.height});
  ImGui::SetNextWindowSize({r.width, static_cast<float>(app.window.height()) - r.y - r.height});
  ImGui::Begin("time", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  const JobStatus status = app.job.status();
  if (app.scene_open() && app.document.duration > 0) {
    if (ImGui::Button(app.settings.play ? "Stop" : "Play")) app.settings.play = !app.settings.play;
    tip("plays the scene's animations there and back (Space)");
    ImGui::SameLine();
    const float rest = status.running ? 27 * ImGui::GetFontSize() : 22 * ImGui::GetFontSize();
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - rest, 80.0f));
    if (ImGui::SliderFloat("##time", &app.document.time, 0, app.document.duration, "%.2f s")) {
      app.settings.play = false;
      app.redraw();
    }
    tip("time of the scene's animations: doors and other things that move");
    ImGui::SameLine();
  }
  if (status.running) {
    draw_job(app, status);
  } else if (app.scene_open()) {
    draw_summary(app);
  }
  ImGui::End();
}

}  // namespace ssphh::viewer
