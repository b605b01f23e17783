/// Lamps with photometric profiles: EXT_lights_ies, and what it has no place for in extras.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/scene_io/ies.h>

#include "gltf_export_parts.h"
#include "gltf_parts.h"
#include "uri.h"

namespace ssphh::scene_io {
namespace {

constexpr const char* extension_name = "EXT_lights_ies";
constexpr const char* mime_type = "application/x-ies-lm-63";

const scene::LampProfile& import_profile(GltfImport& import, const json::Cursor& entry, int index) {
  const auto known = import.profiles.find(index);
  if (known != import.profiles.end()) return known->second;
  GltfDocument& document = import.document;
  const std::string where = entry.place();
  scene::LampProfile profile;
  std::vector<std::byte> storage;
  std::span<const std::byte> bytes;
  std::string from;
  if (const auto view = document.reference(entry, "bufferView", "bufferViews")) {
    bytes = document.buffer_view(*view).bytes;
  } else {
    const json::Cursor uri = entry["uri"];
    if (auto decoded = decode_data_uri(uri.text(), uri.place())) {
      storage = *std::move(decoded);
    } else {
      const auto path = resolve_uri(uri.text(), document.path(), uri.place());
      storage = read_file(path, max_ies_bytes);
      from = path.filename().string();
    }
    bytes = storage;
  }
  auto table = ies_from_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, where);
  document.charge(table.candela.size() * sizeof(float), entry);
  profile.name = entry.text_or("name", from.empty() ? fmt::format("profile {}", index) : from);
  profile.table = std::make_shared<const scene::PhotometricTable>(std::move(table));
  return import.profiles[index] = std::move(profile);
}

}  // namespace

std::optional<scene::Light> import_profile_light(GltfImport& import, const json::Cursor& file_node,
                                                 const std::string& name) {
  const auto instance = extension(file_node, extension_name);
  if (!instance) return std::nullopt;
  const auto root = extension(import.document.root(), extension_name);
  const int index = (*instance)["light"].index(root ? root->size_of("lights") : 0, "lights");
  scene::Light light;
  light.profile = import_profile(import, (*root)["lights"][index], index);
  if (const auto color = instance->find("color")) light.color = color->vector3();
  const auto multiplier = instance->find("multiplier");
  light.intensity =
      scene::greatest_candela(*light.profile.table) * (multiplier ? multiplier->number(0, HUGE_VALF) : 1);
  if (!std::isfinite(light.intensity)) multiplier->fail("makes the lamp infinitely bright");
  light.name = name;
  light.group = light_group_extra(*instance);
  if (light.group.empty()) light.group = light_group_extra(file_node);
  const auto more = extra(*instance, "ssphh");
  if (!more) return light;
  light.name = more->text_or("name", name);
  if (const auto intensity = more->find("intensity")) light.intensity = intensity->number(0, HUGE_VALF);
  if (const auto color = more->find("color")) light.color = color->vector3();
  if (const auto range = more->find("range")) {
    light.range = range->number();
    if (!(light.range > 0)) range->fail("must be greater than 0");
  }
  if (const auto spot = more->find("spot")) {
    light.type = scene::LightType::spot;
    light.outer_cone = (*spot)["outerConeAngle"].number(0, pi);
    light.inner_cone = (*spot)["innerConeAngle"].number(0, light.outer_cone);
  }
  return light;
}

json::Value export_profile_light(GltfExport& out, const scene::Light& light, const std::string& node_name) {
  auto known = std::ranges::find(out.profiles_written, light.profile);
  if (known == out.profiles_written.end()) {
    const std::string text = ies_to_text(light.profile);
    const int view = add_buffer_view(out, std::as_bytes(std::span(text)), 0);
    json::Value entry = {{"bufferView", view}, {"mimeType", mime_type}};
    if (!light.profile.name.empty()) entry["name"] = light.profile.name;
    push(out.profiles, std::move(entry));
    out.profiles_written.push_back(light.profile);
    known = out.profiles_written.end() - 1;
  }
  // Its colours end at 1.
  const float bright = std::max(1.0f, max_component(light.color));
  json::Value json = {{"light", static_cast<int>(known - out.profiles_written.begin())}};
  json["multiplier"] = number(light.intensity * bright / scene::greatest_candela(*light.profile.table));
  json["color"] = numbers(light.color / bright);
  if (!light.group.empty()) json["extras"]["light_group"] = light.group;
  json::Value more = {{"intensity", number(light.intensity)}};
  if (bright > 1) more["color"] = numbers(light.color);
  if (light.name != node_name && !light.name.empty()) more["name"] = light.name;
  if (light.range > 0) more["range"] = number(light.range);
  if (light.type == scene::LightType::spot)
    more["spot"] = {{"innerConeAngle", number(light.inner_cone)},
                    {"outerConeAngle", number(light.outer_cone)}};
  json["extras"]["ssphh"] = std::move(more);
  return json;
}

}  // namespace ssphh::scene_io
