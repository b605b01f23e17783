#include "sky_edit.h"

#include <algorithm>

namespace ssphh::viewer {

std::optional<scene::SunSkyParams> shown_sky(const Document& document) {
  if (document.edits().sky) return document.edits().sky->params;
  return document.scene->environment ? document.scene->environment->sun_sky : std::nullopt;
}

void change_sky(Document& document, scene::SunSkyParams sky) {
  if (sky.model == scene::SkyModel::preetham) sky.elevation = std::max(sky.elevation, 0.0f);
  scene::SunSky made = scene::make_sun_sky(sky);
  document.edit("change the sky", [&](Edits& e) { e.sky = std::move(made); });
}

scene::SunSkyParams at_hour(const scene::SunSkyParams& sky, double hour) {
  scene::SunTime time =
      sky.time.value_or(scene::SunTime{.utc_offset = 1, .latitude = 48.1, .longitude = 11.6});
  time.hour = hour;
  return scene::at_time(sky, time);
}

}  // namespace ssphh::viewer
