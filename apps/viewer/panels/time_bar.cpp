#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

/// Of the pixels that are left.
void draw_job(App& app, const JobStatus& status) {
  const float em = ImGui::GetFontSize();
  const ImGuiStyle& style = ImGui::GetStyle();
  const float button = ImGui::CalcTextSize("Cancel").x + 2 * style.FramePadding.x;
  const float width =
      std::clamp(ImGui::GetContentRegionAvail().x - button - style.ItemSpacing.x, 3 * em, 18 * em);
  const bool known = status.fraction >= 0;
  const std::string amount =
      known ? fmt::format("{:.0f} %", 100 * status.fraction) : fmt::format("{:.0f} s", status.seconds);
  const std::string longest = known ? fmt::format("{}: {} {}", status.name, status.stage, amount)
                                    : fmt::format("{} … {}", status.name, amount);
  // The longest that fits
  std::string text = amount;
  for (const std::string& t : {fmt::format("{} {}", status.name, amount), longest})
    if (ImGui::CalcTextSize(t.c_str()).x + 2 * style.FramePadding.x <= width) text = t;
  ImGui::ProgressBar(known ? static_cast<float>(status.fraction) : 0.0f, {width, 0}, text.c_str());
  if (text != longest) tip(longest.c_str());
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
  std::string text = fmt::format("{} probes", app.light.empty() ? 0 : app.light.set().probes.size());
  const std::string more[] = {fmt::format("   frame {:.1f} ms", frame),
                              fmt::format("   relight {:.1f} ms", relight)};
  for (const std::string& part : more) {
    if (ImGui::CalcTextSize((text + part).c_str()).x > ImGui::GetContentRegionAvail().x) break;
    text += part;
  }
  if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x) return;
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", text.c_str());
}

}  // namespace

void draw_time_bar(App& app) {
  const Rect2& r = app.area;
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
