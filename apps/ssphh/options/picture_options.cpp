#include "options/picture_options.h"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include <ssphh/core/parse_number.h>

#include "results/tev.h"

namespace ssphh::app {

void add_camera_option(Command command, std::string& camera) {
  command.option(
      "--camera", camera,
      "Camera by name, or X,Y,Z:TO_X,TO_Y,TO_Z[:DEGREES], an eye, what it looks at and the vertical field "
      "of view [m, world]; default: the scene's first, or a view of what matters");
}

void add_size_options(Command command, int& width, int& height, int most) {
  command.option("--width", width, "Pixels").range(1, most);
  command.option("--height", height, "Pixels").range(1, most);
}

void add_at_option(Command command, std::string& at) {
  command.option(
      "--at", at,
      "Place of the sphere, its axes the world's: a SPHL by name, or X,Y,Z; default: the camera's");
}

Option add_max_depth_option(Command command, int& max_depth) {
  return command
      .option("--max-depth", max_depth, "Scattering events: 0 emitters only, 1 direct light, 2 one bounce …")
      .range(0, 1000);
}

void add_exposure_option(Command command, std::optional<float>& exposure, const std::string& help) {
  const auto take = [&exposure](const std::string& text) -> std::string {
    if (text == "auto") return exposure.reset(), "";
    const auto value = parse_number<float>(std::string_view(text).substr(text.starts_with('+') ? 1 : 0));
    if (!value || std::abs(*value) > 60)
      return fmt::format("{} is neither auto nor a number from -60 to 60", text);
    exposure = value;
    return "";
  };
  command.value("--exposure", "auto", help, take).kind("auto|EV");
}

Option add_tev_option(Command command, std::string& address, const std::string& help) {
  const auto problem = [](const std::string& text) {
    return tev_address(text) ? std::string()
                             : fmt::format("{} is no HOST:PORT; tev itself listens at {}", text, usual_tev);
  };
  return command.option("--tev", address, help).check(problem, "HOST:PORT");
}

void add_picture_options(Command command, PictureOptions& o) {
  add_scene_options(command, o.scene);
  add_camera_option(command, o.camera);
  add_size_options(command, o.width, o.height, 65536);
  add_max_depth_option(command, o.max_depth);
  command.option("--spp", o.spp, "Samples per pixel").range(2, 1 << 20);
}

vec3 place_of(const scene::Scene& scene, const std::string& text, float time) {
  std::string names;
  for (const scene::ProbePlace& sphl : scene::sphl_places(scene, time)) {
    if (sphl.name == text) return sphl.position;
    names += (names.empty() ? "" : ", ") + sphl.name;
  }
  vec3 place;
  int end = 0;
  const int read = std::sscanf(text.c_str(), "%f,%f,%f%n", &place.x, &place.y, &place.z, &end);
  if (read == 3 && end == static_cast<int>(text.size()) && std::isfinite(place.x + place.y + place.z))
    return place;
  throw Error("--at " + text, "is neither a SPHL of the scene nor X,Y,Z",
              names.empty() ? "the scene has no SPHLs" : "its SPHLs: " + names);
}

scene_io::ExportSettings export_settings(const PictureOptions& o, const scene::Scene& scene) {
  return {camera_of(scene, o.camera, o.scene.time), o.scene.time, o.width, o.height, o.max_depth, o.spp};
}

}  // namespace ssphh::app
