#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/pipeline/sky_options.h>

namespace ssphh::pipeline {
namespace {

scene::SunTime sun_time_of(const SkyOptions& o) {
  const struct {
    const char* option;
    const std::string& text;
    const char* example;
  } parts[] = {{"--date", o.date, "2026-06-21"},
               {"--time-of-day", o.time_of_day, "17:30"},
               {"--place", o.place, "48.1,11.6"}};
  for (const auto& given : parts) {
    for (const auto& missing : parts) {
      if (!given.text.empty() && missing.text.empty())
        throw Error(fmt::format("{} {}", given.option, given.text),
                    fmt::format("is not enough to find the sun: {} is missing", missing.option),
                    fmt::format("add {} {}, for instance", missing.option, missing.example));
    }
  }
  scene::SunTime time;
  scene::read_date(time, o.date, "--date");
  scene::read_place(time, o.place, "--place");
  time.hour = scene::read_hour(o.time_of_day, "--time-of-day");
  time.utc_offset =
      o.utc_offset ? static_cast<double>(*o.utc_offset) : scene::nautical_utc_offset(time.longitude);
  time.north = static_cast<double>(o.north);
  return time;
}

}  // namespace

std::optional<scene::SunSkyParams> sun_sky_of(const SkyOptions& o) {
  const bool by_time = !o.date.empty() || !o.time_of_day.empty() || !o.place.empty();
  if (!by_time && (o.utc_offset || o.north != 0))
    throw Error(o.utc_offset ? "--utc-offset" : "--north", "is of a sun by date and time",
                "add --date, --time-of-day and --place, or turn the sun by --sun-azimuth");
  if (!o.model && !o.preetham && !by_time) return std::nullopt;
  if (o.preetham && o.model && *o.model != scene::SkyModel::preetham)
    throw Error("--sun-sky", "is Preetham's sky, and --sky names another", "leave one of them out");
  scene::SunSkyParams sky;
  sky.model = o.model.value_or(o.preetham ? scene::SkyModel::preetham : scene::SkyModel::physical);
  sky.turbidity = o.turbidity;
  sky.elevation = glm::radians(o.elevation);
  sky.azimuth = glm::radians(o.azimuth - 90);
  return by_time ? scene::at_time(sky, sun_time_of(o)) : sky;
}

void tell_of_sun(const scene::Scene& scene) {
  if (!scene.environment || !scene.environment->sun_sky) return;
  const scene::SunSkyParams& sky = *scene.environment->sun_sky;
  const float elevation = glm::degrees(sky.elevation);
  if (sky.time) {
    const scene::SunTime& t = *sky.time;
    log_info(
        "the sun stands {:.1f}° above the horizon, {:.1f}° from north over east; clocks are {:+g} h from UTC",
        elevation, scene::sun_position(t).azimuth, t.utc_offset);
  }
  if (elevation > -0.27f) return;
  log_warning("the sun is {:.1f}° below the horizon: {}", -elevation,
              elevation > -6    ? "dusk, in which the sky alone shines"
              : elevation > -18 ? "dusk, and all but dark"
                                : "night, in which airglow and stars alone shine; there is no moon");
}

}  // namespace ssphh::pipeline
