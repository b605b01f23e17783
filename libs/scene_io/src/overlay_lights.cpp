#include <cmath>

#include <fmt/format.h>

#include <ssphh/scene/area_lamp.h>

#include "overlay_entries.h"
#include "overlay_paths.h"
#include "read_emission.h"
#include "read_profile.h"

namespace ssphh::scene_io {
namespace {

// What rectangles and discs have beside others.
void read_area_lamp(scene::Light& light, const json::Cursor& entry) {
  const bool rectangle = light.type == scene::LightType::rectangle;
  if (rectangle) light.size = {positive(entry["width"]), positive(entry["height"])};
  for (const char* key : {"width", "height"})
    if (const auto member = entry.find(key); member && !rectangle) member->fail("only a rectangle has one");
  const auto power = entry.find("power");
  if (!power) return;
  const float area = scene::lamp_area(light);
  if (!(area > 0)) power->fail("only a rectangle or a disc has one");
  if (entry.find("intensity")) entry.fail("has both \"intensity\" and \"power\"");
  light.intensity = power->number(0, HUGE_VALF) / (pi * area);
  if (!std::isfinite(light.intensity)) power->fail("is too much for so small a lamp");
}

}  // namespace

void read_light(scene::Scene& scene, const json::Cursor& entry, std::size_t number,
                const std::filesystem::path& overlay) {
  entry.only({"name",
              "light_group",
              "type",
              "position",
              "look_at",
              "direction",
              "up",
              "node",
              "color",
              "intensity",
              "power",
              "radius",
              "width",
              "height",
              "angular_diameter_degrees",
              "inner_cone_degrees",
              "outer_cone_degrees",
              "range",
              "emission",
              "profile"});
  scene::Light light;
  light.name = entry.text_or("name", fmt::format("light {}", number));
  light.group = entry.text_or("light_group");
  light.type = entry["type"].named<scene::LightType>();
  if (const auto color = entry.find("color")) light.color = color->vector3();
  if (const auto intensity = entry.find("intensity")) light.intensity = intensity->number(0, HUGE_VALF);
  if (const auto range = entry.find("range")) light.range = positive(*range);
  const bool shines = light.type == scene::LightType::sphl;
  if (light.type == scene::LightType::sphere || light.type == scene::LightType::disc || shines)
    light.radius = positive(entry["radius"]);
  read_area_lamp(light, entry);
  if (shines) {
    read_emission(light, entry["emission"],
                  [&](const json::Cursor& file) { return overlay_path(file, overlay); });
  } else if (const auto emission = entry.find("emission")) {
    emission->fail("only an SPHL has one");
  }
  if (const auto profile = entry.find("profile")) {
    if (light.type != scene::LightType::point && light.type != scene::LightType::spot)
      profile->fail("only a point or spot light has one");
    light.profile =
        read_profile(*profile, [&](const json::Cursor& file) { return overlay_path(file, overlay); });
    if (!entry.find("intensity")) light.intensity = scene::greatest_candela(*light.profile.table);
  }
  light.angular_radius = degrees(entry, "angular_diameter_degrees", 0, 180, 0) / 2;
  light.inner_cone = degrees(entry, "inner_cone_degrees", 0, 90, 0);
  light.outer_cone = degrees(entry, "outer_cone_degrees", 0, 90, 45);
  if (light.inner_cone > light.outer_cone) entry.fail("the inner cone is wider than the outer one");
  const bool directed = light.type == scene::LightType::spot || light.type == scene::LightType::directional ||
                        scene::is_area_lamp(light.type);
  if ((directed || light.has_profile()) && !entry.find("look_at") && !entry.find("direction")) {
    entry.fail(fmt::format("a {} light{} needs \"direction\" or \"look_at\"", name_of(light.type),
                           light.has_profile() ? " with a profile" : ""));
  }
  light.node = add_overlay_node(scene, entry, light.name);
  scene.lights.push_back(std::move(light));
}

void read_sphl_lamp(scene::Scene& scene, const json::Cursor& entry, const scene::Sphl& sphl,
                    const std::filesystem::path& overlay) {
  const auto emission = entry.find("emission");
  const auto group = entry.find("light_group");
  if (!emission && group) group->fail("only an SPHL with \"emission\" has a light group");
  if (!emission) return;
  scene::Light light;
  light.name = sphl.name, light.node = sphl.node, light.radius = sphl.radius;
  if (group) light.group = group->text();
  read_emission(light, *emission, [&](const json::Cursor& member) { return overlay_path(member, overlay); });
  scene.lights.push_back(std::move(light));
}

}  // namespace ssphh::scene_io
