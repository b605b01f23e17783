#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/json_cursor.h>
#include <ssphh/image/io.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/scene_io/overlay.h>
#include <ssphh/scene_io/unit.h>

#include "overlay_entries.h"
#include "overlay_paths.h"
#include "read_light_groups.h"
#include "read_tone_curves.h"

namespace ssphh::scene_io {
namespace {

using scene::Scene;

constexpr std::size_t max_entries = 100'000;
constexpr int max_overlays_below = 8;  // one below the other

void read_camera(Scene& scene, const json::Cursor& entry, std::size_t number) {
  entry.only({"name", "position", "look_at", "direction", "up", "node", "yfov_degrees", "xfov_degrees",
              "aspect", "yheight"});
  scene::Camera camera;
  camera.name = entry.text_or("name", fmt::format("camera {}", number));
  if (const auto aspect = entry.find("aspect")) camera.aspect = positive(*aspect);
  const auto xfov = entry.find("xfov_degrees");
  if (xfov && entry.find("yfov_degrees")) entry.fail("has both \"xfov_degrees\" and \"yfov_degrees\"");
  if (xfov) {
    if (!camera.aspect) entry.fail("\"xfov_degrees\" needs \"aspect\"", "16:9 is 1.7778");
    camera.yfov = 2 * std::atan(std::tan(glm::radians(xfov->number(0.01f, 179)) / 2) / *camera.aspect);
  } else {
    camera.yfov = degrees(entry, "yfov_degrees", 0.01f, 179, 45);
  }
  if (const auto height = entry.find("yheight")) {
    camera.orthographic = true;
    camera.yheight = positive(*height);
  }
  camera.node = add_overlay_node(scene, entry, camera.name);
  scene.cameras.push_back(std::move(camera));
}

void read_sphl(Scene& scene, const json::Cursor& entry, std::size_t number,
               const std::filesystem::path& overlay) {
  entry.only({"name", "position", "node", "look_at", "direction", "up", "radius", "enabled", "emission",
              "light_group"});
  scene::Sphl sphl;
  sphl.name = entry.text_or("name", fmt::format("SPHL-{}", number));
  if (const auto radius = entry.find("radius")) sphl.radius = positive(*radius);
  sphl.enabled = entry.boolean_or("enabled", true);
  entry["position"];
  sphl.node = add_overlay_node(scene, entry, sphl.name);
  read_sphl_lamp(scene, entry, sphl, overlay);
  scene.sphls.push_back(std::move(sphl));
}

vec3 color_up_to(const json::Cursor& member, double most) {
  member.size(3, 3);
  return {member[0].number(0, most), member[1].number(0, most), member[2].number(0, most)};
}

void override_material(Scene& scene, const json::Cursor& entry, std::size_t) {
  entry.only({"name", "base_color", "alpha", "metallic", "diffuse_roughness", "specular_roughness",
              "specular", "ior", "transmission", "thickness", "attenuation_color", "attenuation_distance",
              "emission", "double_sided", "unlit"});
  const std::string& name = entry["name"].text();
  bool found = false;
  for (auto& m : scene.materials) {
    if (m.name != name) continue;
    found = true;
    const auto number = [&](const char* key, float low, float high, float& value) {
      if (const auto member = entry.find(key)) value = member->number(low, high);
    };
    if (const auto color = entry.find("base_color")) m.base_color = color_up_to(*color, 1);
    if (const auto emission = entry.find("emission")) m.emission = color_up_to(*emission, HUGE_VAL);
    number("alpha", 0, 1, m.alpha);
    number("metallic", 0, 1, m.metallic);
    number("diffuse_roughness", -1, 1, m.diffuse_roughness);
    number("specular_roughness", -1, 1, m.specular_roughness);
    number("specular", 0, 1, m.specular);
    number("ior", 1, HUGE_VALF, m.ior);
    number("transmission", 0, 1, m.transmission);
    number("thickness", 0, HUGE_VALF, m.thickness);
    if (const auto color = entry.find("attenuation_color")) m.attenuation_color = color_up_to(*color, 1);
    if (const auto distance = entry.find("attenuation_distance"))
      m.attenuation_distance = positive(*distance);
    m.double_sided = entry.boolean_or("double_sided", m.double_sided);
    m.unlit = entry.boolean_or("unlit", m.unlit);
  }
  if (found) return;
  std::vector<std::string> names;
  for (const auto& m : scene.materials) names.push_back(m.name);
  if (names.size() > 20) names.resize(20);
  entry["name"].fail(fmt::format("the scene has no material \"{}\"", name),
                     names.empty() ? "it has none" : fmt::format("it has: {}", fmt::join(names, ", ")));
}

void set_environment(Scene& scene, const json::Cursor& entry, const std::filesystem::path& overlay) {
  entry.only({"name", "light_group", "image", "color", "intensity", "rotation_degrees"});
  scene::Environment environment;
  environment.name = entry.text_or("name", environment.name);
  environment.group = entry.text_or("light_group");
  if (const auto color = entry.find("color")) environment.color = color->vector3();
  if (const auto intensity = entry.find("intensity")) environment.color *= intensity->number(0, HUGE_VALF);
  environment.rotation = degrees(entry, "rotation_degrees", -3600, 3600, 0);
  if (const auto image = entry.find("image"))
    environment.equirect = image::read_image(overlay_path(*image, overlay));
  scene.environment = std::move(environment);
}

// "date", "time_of_day" and "place", in place of the sun's angles.
scene::SunTime sun_time(const json::Cursor& entry) {
  scene::SunTime time;
  const auto read = [&](const char* key, const auto& take) {
    const json::Cursor member = entry[key];
    try {
      take(member.text());
    } catch (const Error& e) {
      member.fail(e.problem(), e.hint());
    }
  };
  read("date", [&](const std::string& text) { scene::read_date(time, text, "date"); });
  read("time_of_day", [&](const std::string& text) { time.hour = scene::read_hour(text, "time_of_day"); });
  read("place", [&](const std::string& text) { scene::read_place(time, text, "place"); });
  const auto number = [&](const char* key, float most, double fallback) {
    const auto member = entry.find(key);
    return member ? static_cast<double>(member->number(-most, most)) : fallback;
  };
  time.utc_offset = number("utc_offset_hours", 14, scene::nautical_utc_offset(time.longitude));
  time.north = number("north_degrees", 360, 0);
  if (entry.find("elevation_degrees") || entry.find("azimuth_degrees"))
    entry.fail("has the sun's angles and its date, which give others");
  return time;
}

void set_sun_sky(Scene& scene, const json::Cursor& entry) {
  entry.only({"model", "elevation_degrees", "azimuth_degrees", "date", "time_of_day", "place",
              "utc_offset_hours", "north_degrees", "turbidity", "ground_albedo", "sun", "lamp", "width"});
  scene::SunSkyParams params;
  const bool by_time = entry.find("date") || entry.find("time_of_day") || entry.find("place");
  if (by_time) params.model = scene::SkyModel::physical;
  if (const auto model = entry.find("model")) params.model = model->named<scene::SkyModel>();
  const float least = params.model == scene::SkyModel::physical ? -90 : 0;
  params.elevation = degrees(entry, "elevation_degrees", least, 90, glm::degrees(params.elevation));
  // By compass: 0 is −z, 90 is +x
  const float azimuth = degrees(entry, "azimuth_degrees", -360, 360, glm::degrees(params.azimuth) + 90);
  params.azimuth = azimuth - pi / 2;
  params.turbidity = entry.number_or("turbidity", params.turbidity);
  if (const auto albedo = entry.find("ground_albedo")) params.ground_albedo = albedo->vector3();
  params.sun = entry.boolean_or("sun", params.sun);
  if (const auto width = entry.find("width")) params.width = static_cast<int>(width->unsigned_integer(4096));
  if (by_time) params = scene::at_time(params, sun_time(entry));
  try {
    scene::add_sun_sky(scene, params);
    const int lamp = scene::sun_light(scene);
    if (!entry.boolean_or("lamp", true) && lamp >= 0) scene.lights.erase(scene.lights.begin() + lamp);
  } catch (const Error& e) {
    entry.fail(e.problem(), e.hint());
  }
}

// "without": what is below loses those of these names, if it has them.
void leave_out(Scene& scene, const json::Cursor& without) {
  without.only({"cameras", "lights", "sphls"});
  const auto erase = [&](const char* key, auto& list) {
    if (!without.find(key)) return;
    for (const json::Cursor& name : json::elements(without[key], 0, max_entries))
      std::erase_if(list, [&](const auto& item) { return item.name == name.text(); });
  };
  erase("cameras", scene.cameras);
  erase("lights", scene.lights);
  erase("sphls", scene.sphls);
}

// "light_factors": a factor on all that a light group emits; 0 makes it dark.
void scale_groups(Scene& scene, const json::Cursor& factors) {
  const std::vector<std::string> groups = scene::light_groups(scene);
  scene::LightingState state = scene::lighting_at(scene);
  for (const auto& [group, unused] : factors.entries()) {
    const json::Cursor factor = factors[group.c_str()];
    const auto found = std::ranges::find(groups, group);
    if (found == groups.end())
      factor.fail(fmt::format("the scene has no light group \"{}\"", group),
                  fmt::format("it has: {}", fmt::join(groups, ", ")));
    const vec3 value = factor.vector3();
    if (!glm::all(glm::greaterThanEqual(value, vec3(0)))) factor.fail("must not be below 0");
    state.group_scales[found - groups.begin()] = value;
  }
  scene = scene::keeping_dark_light(std::move(scene), std::move(state));
}

// A number, or a word that unit.h knows.
std::string read_unit(const json::Cursor& member) {
  if (member.is_number()) return fmt::format("{}", positive(member));
  if (const auto problem = unit_problem(member.text()); !problem.empty()) member.fail(problem);
  return member.text();
}

template <class Function>
void for_each_entry(Scene& scene, const json::Cursor& root, const char* key, const Function& function) {
  const auto list = root.find(key);
  if (!list) return;
  if (list->size() > max_entries) list->fail(fmt::format("has more than {} entries", max_entries));
  for (std::size_t i = 0; i < list->size(); ++i) function(scene, (*list)[i], i + 1);
}

void apply(Scene& scene, std::string_view text, const std::filesystem::path& path, std::string unit_in_place,
           int below) {
  const std::string file = path.string();
  const json::Value json = json::parse(text, file);
  const json::Cursor root(json, file);
  root.only({"$schema", "comment", "scene", "name", "unit", "origin", "overlays", "without", "cameras",
             "lights", "sphls", "environment", "environment_turn_degrees", "sun_sky", "materials", "textures",
             "light_factors", "light_modes"});
  if (const auto overlays = root.find("overlays")) {
    if (below == max_overlays_below)
      overlays->fail(fmt::format("more than {} overlays lie on each other", below));
    for (const json::Cursor& named : json::elements(*overlays, 0, max_entries)) {
      const std::filesystem::path other = overlay_path(named, path);
      apply(scene, read_text_file(other, max_overlay_bytes), other, unit_in_place, below + 1);
      if (!unit_in_place.empty()) unit_in_place = "m";
    }
  }
  scene.name = root.text_or("name", scene.name);
  const auto unit = root.find("unit"), origin = root.find("origin");
  const std::string own_unit = unit ? read_unit(*unit) : "m";
  if (unit || origin || !unit_in_place.empty()) {
    set_unit(scene, metres_per_unit(unit_in_place.empty() ? own_unit : unit_in_place, scene, file),
             origin ? origin->vector3() : vec3(0));
  }
  if (const auto without = root.find("without")) leave_out(scene, *without);
  const auto environment = root.find("environment"), sun_sky = root.find("sun_sky");
  if (environment && sun_sky) root.fail("has both \"environment\" and \"sun_sky\"");
  // The sun of a sky below goes, not one that stands among the lights here.
  const bool sunless = sun_sky && !(sun_sky->boolean_or("sun", true) && sun_sky->boolean_or("lamp", true));
  if (sunless) set_sun_sky(scene, *sun_sky);
  for_each_entry(scene, root, "textures",
                 [](Scene& s, const json::Cursor& entry, std::size_t) { read_tone_curve(s, entry); });
  for_each_entry(scene, root, "materials", override_material);
  for_each_entry(scene, root, "cameras", read_camera);
  for_each_entry(scene, root, "lights", [&](Scene& s, const json::Cursor& entry, std::size_t number) {
    read_light(s, entry, number, path);
  });
  for_each_entry(scene, root, "sphls", [&](Scene& s, const json::Cursor& entry, std::size_t number) {
    read_sphl(s, entry, number, path);
  });
  if (environment) set_environment(scene, *environment, path);
  if (sun_sky && !sunless) set_sun_sky(scene, *sun_sky);
  if (const auto turn = root.find("environment_turn_degrees")) {
    if (!scene.environment) turn->fail("the scene has no environment");
    scene.environment->rotation += glm::radians(turn->number(-3600, 3600));
  }
  if (const auto modes = root.find("light_modes")) read_light_modes(scene, *modes);
  if (const auto factors = root.find("light_factors")) scale_groups(scene, *factors);
}

}  // namespace

void apply_overlay(Scene& scene, std::string_view text, const std::filesystem::path& path,
                   const std::string& unit) {
  apply(scene, text, path, unit, 0);
}

}  // namespace ssphh::scene_io
