#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

float value_at(void* data, int i) {
  return static_cast<const History1d*>(data)->at(i);
}

void draw_graph(const FrameTimes::Stage& stage) {
  History1d values = stage.ms;
  const float highest = std::max(values.quantile(0.99), 0.01f);
  ImGui::PushID(stage.name.c_str());
  ImGui::PlotLines("##ms", value_at, &values, values.count(), 0,
                   fmt::format("{}   {:.2f} ms", stage.name, values.median()).c_str(), 0, 1.2f * highest,
                   {ImGui::GetContentRegionAvail().x, 2.6f * ImGui::GetTextLineHeight()});
  tip(fmt::format("median {:.3f} ms, 99th percentile {:.3f} ms, last {:.3f} ms, of {} frames",
                  values.median(), values.quantile(0.99), values.last(), values.count())
          .c_str());
  ImGui::PopID();
}

}  // namespace

void draw_stats_panel(App& app) {
  heading("Last frame");
  const realtime::FrameStats& s = app.last_stats;
  ImGui::TextWrapped("%s", app.report.renderer.c_str());
  ImGui::TextWrapped("%d × %d pixels", app.picture.width(), app.picture.height());
  ImGui::TextWrapped("%llu draw calls, %llu triangles", static_cast<unsigned long long>(s.draw_calls),
                     static_cast<unsigned long long>(s.triangles));
  ImGui::TextWrapped("%.1f kB uploaded, %d shadow maps drawn", static_cast<double>(s.bytes_uploaded) / 1024,
                     s.shadow_maps_drawn);
  if (app.light.live()) {
    const transport::RelightReport& r = app.light.report();
    ImGui::TextWrapped("relight %.1f ms: pose %.1f, direct %.1f,", r.total_ms(), r.pose_ms, r.direct_ms);
    ImGui::TextWrapped("solve %.1f (%d steps), project %.1f", r.solve_ms, r.solve.iterations, r.project_ms);
  }
  heading("Times [ms], last 240 frames drawn");
  for (const FrameTimes::Stage& stage : app.times.stages()) draw_graph(stage);
  static char file[256] = "times.csv";
  file_row("file", file);
  if (save_button(app, "Save .csv or .json", "Replace the file", file))
    attempt(app, [&] { app.save_stats(file); });
  beside("Begin anew");
  if (ImGui::Button("Begin anew")) app.times.clear();
}

}  // namespace ssphh::viewer
