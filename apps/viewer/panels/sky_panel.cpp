#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include <ssphh/scene/calendar.h>

#include "app.h"
#include "model/sky_edit.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

bool slider(const char* label, const char* id, double& value, float low, float high, const char* format) {
  row(label);
  auto number = static_cast<float>(value);
  const bool moved = ImGui::SliderFloat(id, &number, low, high, format, ImGuiSliderFlags_AlwaysClamp);
  if (moved) value = static_cast<double>(number);
  return moved;
}

/// The sun by the clock; whether something of it changed.
bool draw_sun_time(App& app, scene::SunTime& time) {
  const std::string clock = scene::clock_text(std::round(time.hour * 60) / 60);
  bool changed = slider("time of day", "##hour", time.hour, 0, 24, clock.c_str());
  seal_after_edit(app);
  tip("by the clock; light follows");
  row("month, day");
  std::array<int, 2> date = {time.month, time.day};
  if (ImGui::DragInt2("##date", date.data(), 0.1f, 1, 31, "%d", ImGuiSliderFlags_AlwaysClamp)) {
    time.month = std::clamp(date[0], 1, 12);
    time.day = std::min(date[1], scene::days_of_month(time.year, time.month));
    changed = true;
  }
  seal_after_edit(app);
  changed |= slider("latitude", "##latitude", time.latitude, -90, 90, "%.1f°");
  seal_after_edit(app);
  tip("north is positive");
  changed |= slider("longitude", "##longitude", time.longitude, -180, 180, "%.1f°");
  seal_after_edit(app);
  tip("east is positive");
  changed |= slider("ahead of UTC", "##offset", time.utc_offset, -14, 14, "%.1f h");
  seal_after_edit(app);
  tip("of the clock, summer time included");
  changed |= slider("north", "##north", time.north, -180, 180, "%.0f°");
  seal_after_edit(app);
  tip("where north lies: degrees from -z, clockwise seen from above");
  return changed;
}

bool draw_sun_angles(App& app, scene::SunSkyParams& sky) {
  const float least = sky.model == scene::SkyModel::preetham ? 0.0f : -30.0f;
  row("sun's height");
  bool changed =
      ImGui::SliderAngle("##elevation", &sky.elevation, least, 90, "%.1f°", ImGuiSliderFlags_AlwaysClamp);
  seal_after_edit(app);
  tip("above the horizon");
  double compass = glm::degrees(static_cast<double>(sky.azimuth)) + 90;
  compass -= 360 * std::floor(compass / 360);
  if (slider("sun's azimuth", "##azimuth", compass, 0, 360, "%.0f°")) {
    sky.azimuth = static_cast<float>(glm::radians(compass - 90));
    changed = true;
  }
  seal_after_edit(app);
  tip("by compass: 0 is -z, 90 is +x");
  return changed;
}

}  // namespace

void draw_sky(App& app) {
  const auto shown = shown_sky(app.document);
  if (!shown) return;
  scene::SunSkyParams sky = *shown;
  heading("Sky");
  row("model");
  bool changed = false;
  if (ImGui::BeginCombo("##model", std::string(name_of(sky.model)).c_str())) {
    for (const std::string& name : names_of<scene::SkyModel>()) {
      if (!ImGui::Selectable(name.c_str(), name == name_of(sky.model))) continue;
      app.document.history.seal();
      sky.model = *parse_enum<scene::SkyModel>(name);
      changed = true;
    }
    ImGui::EndCombo();
  }
  tip("physical: air, haze and ozone around the earth, dusk and night, too; preetham: a fit for days");
  bool by_time = sky.time.has_value();
  if (ImGui::Checkbox("sun by date and place", &by_time)) {
    app.document.history.seal();
    if (by_time) sky = at_hour(sky, 12);
    if (!by_time) sky.time.reset();
    changed = true;
  }
  if (sky.time) {
    scene::SunTime time = *sky.time;
    if (draw_sun_time(app, time)) {
      sky = scene::at_time(sky, time);
      changed = true;
    }
    note(fmt::format("The sun is {:.1f}° {} the horizon.", std::abs(glm::degrees(sky.elevation)),
                     sky.elevation < 0 ? "below" : "above"));
  } else {
    changed |= draw_sun_angles(app, sky);
  }
  row("turbidity");
  changed |=
      ImGui::SliderFloat("##turbidity", &sky.turbidity, 1.7f, 10, "%.1f", ImGuiSliderFlags_AlwaysClamp);
  seal_after_edit(app);
  tip("haze: 2 very clear, 10 hazy");
  if (!changed) return;
  attempt(app, [&] { change_sky(app.document, sky); });
  app.redraw();
}

}  // namespace ssphh::viewer
