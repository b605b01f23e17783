#include "options/scene_options.h"

#include <ssphh/core/error.h>
#include <ssphh/scene_io/unit.h>

namespace ssphh::app {
namespace {

std::string light_mode_problem(const std::string& text) {
  try {
    pipeline::read_light_mode(text);
    return {};
  } catch (const Error& e) {
    return e.problem();
  }
}

void add_sky_options(const Command& sky, pipeline::SkyOptions& options, const Option& environment) {
  sky.choice(
         "--sky", options.model,
         "Computed sky and sun in place of the environment: physical (air, haze and ozone around the earth; "
         "dusk and night, too) or preetham (an analytic fit for days)")
      .excludes(environment);
  sky.flag("--sun-sky", options.preetham, "As --sky preetham").excludes(environment);
  const Option elevation =
      sky.option("--sun-elevation", options.elevation, "Degrees above the horizon; below it negative")
          .range(-90.0f, 90.0f);
  const Option azimuth =
      sky.option("--sun-azimuth", options.azimuth, "Degrees by compass: 0 is −z, 90 is +x");
  sky.option("--turbidity", options.turbidity, "Haze: 2 very clear, 10 hazy").range(1.7f, 10.0f);
  sky.option("--date", options.date,
             "The sun by the calendar: YEAR-MONTH-DAY, with --time-of-day and --place")
      .excludes(environment)
      .excludes(elevation)
      .excludes(azimuth);
  sky.option(
      "--time-of-day", options.time_of_day,
      "By the clock: HOUR:MINUTE, 00:00 to 24:00; where light moves, as in relight and respond, also a way: "
      "06:00..20:00");
  sky.option("--place", options.place, "LATITUDE,LONGITUDE in degrees, north and east positive");
  sky.option("--utc-offset", options.utc_offset,
             "Hours by which clocks are ahead of UTC, summer time included; default: longitude / 15, rounded")
      .range(-14.0, 14.0);
  sky.option("--north", options.north, "Where north lies: degrees from −z, clockwise seen from above")
      .range(-360.0, 360.0);
}

}  // namespace

void add_scene_options(Command command, SceneOptions& options, bool posed, const std::string& source) {
  command.option(source, options.source, "File (.glb .gltf .obj, or an overlay .ssphh.json) or builtin:NAME")
      .required();
  const Command scene = command.under("Scene");
  if (posed) {
    scene.option("--time", options.time, "Pose the scene's animations at this time [s]");
  }
  scene.option("--overlay", options.overlay,
               "Side file that adds lights, cameras, SPHLs (docs/scenes.md); default: SCENE.ssphh.json if "
               "there is one");
  scene
      .option("--unit", options.unit,
              "Unit of the file's lengths: mm, cm, m, inch, metres per unit, or auto to guess it; default: "
              "metres")
      .check(scene_io::unit_problem, "UNIT");
  scene.flag("--lambert", options.lambert,
             "All surfaces Lambertian of their base colour: what every renderer computes alike");
  const Option environment =
      scene.option("--environment", options.environment,
                   "Equirectangular .hdr or .exr around the scene, in place of its own");
  scene
      .option("--environment-intensity", options.environment_intensity,
              "Factor on the environment's radiance")
      .non_negative();
  scene.option("--environment-rotation", options.environment_rotation,
               "Degrees about +y, counter-clockwise seen from above; also turns a scene's own");
  scene
      .option("--light-mode", options.light_modes,
              "How a light group's light reaches pictures with probes: realtime, mixed (indirect light as "
              "baked), baked (direct light, too) or diffuse (as baked, with sharp reflections of the "
              "environment); default: what the scene says, else diffuse for an environment without a sharp "
              "sun and realtime for lamps")
      .check(light_mode_problem, "GROUP=MODE")
      .repeatable();
  add_sky_options(command.under("Sky"), options.sky, environment);
}

}  // namespace ssphh::app
