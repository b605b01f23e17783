/// Cameras, lights, the environment and animations.

#include <algorithm>
#include <cmath>

#include <ssphh/scene/area_lamp.h>

#include "gltf_export_parts.h"
#include "gltf_names.h"
#include "read_emission.h"

namespace ssphh::scene_io {

using scene::AnimationChannel;
using scene::AnimationPath;
using scene::LightType;

json::Value export_camera(const scene::Camera& camera) {
  json::Value out;
  if (!camera.name.empty()) out["name"] = camera.name;
  // glTF asks for clip planes; nothing here uses them.
  if (camera.orthographic) {
    const float ymag = camera.yheight / 2;
    out["type"] = "orthographic";
    const double xmag = static_cast<double>(ymag) * static_cast<double>(camera.aspect.value_or(1.0f));
    out["orthographic"] = {{"xmag", xmag}, {"ymag", number(ymag)}, {"zfar", 1000}, {"znear", 0.01}};
    return out;
  }
  out["type"] = "perspective";
  json::Value perspective = {{"yfov", number(camera.yfov)}, {"znear", 0.01}};
  if (camera.aspect) perspective["aspectRatio"] = number(*camera.aspect);
  out["perspective"] = std::move(perspective);
  return out;
}

json::Value export_light(const scene::Light& light) {
  json::Value out;
  if (!light.name.empty()) out["name"] = light.name;
  out["color"] = numbers(light.color);
  out["intensity"] = number(light.intensity);
  if (light.range > 0 && light.type != LightType::directional) out["range"] = number(light.range);
  if (!light.group.empty()) out["extras"]["light_group"] = light.group;
  const bool with_extras = light.type == LightType::sphere || light.type == LightType::sphl;
  const LightType known = with_extras                       ? LightType::point
                          : scene::is_area_lamp(light.type) ? LightType::spot
                                                            : light.type;
  out["type"] = name_in(gltf_light_types, known);
  switch (light.type) {
    case LightType::point:
      break;
    case LightType::directional:
      if (light.angular_radius > 0) out["extras"]["ssphh"]["angular_radius"] = number(light.angular_radius);
      break;
    case LightType::spot: {
      // glTF's cones end at a right angle, and the inner one is smaller than the outer.
      const float outer = std::clamp(light.outer_cone, 1e-6f, pi / 2);
      const float inner = std::min(light.inner_cone, std::nextafter(outer, 0.0f));
      out["spot"] = {{"innerConeAngle", number(inner)}, {"outerConeAngle", number(outer)}};
      break;
    }
    case LightType::sphere:
      out["intensity"] = number(light.intensity * pi * light.radius * light.radius);
      out["extras"]["ssphh"] = {{"type", name_of(light.type)},
                                {"radius", number(light.radius)},
                                {"radiance", number(light.intensity)}};
      break;
    case LightType::rectangle:
    case LightType::disc: {
      // As bright straight ahead from afar; the square of the ramp of a spot's cone is near the cosine's.
      out["intensity"] = number(light.intensity * scene::lamp_area(light));
      out["spot"] = {{"innerConeAngle", 0}, {"outerConeAngle", number(pi / 2)}};
      json::Value& more = out["extras"]["ssphh"];
      more = {{"type", name_of(light.type)}, {"radiance", number(light.intensity)}};
      if (light.type == LightType::disc) more["radius"] = number(light.radius);
      if (light.type == LightType::rectangle) more["size"] = {number(light.size.x), number(light.size.y)};
      break;
    }
    case LightType::sphl:
      out["intensity"] = number(light.intensity * luminance(scene::mean_intensity(light.emission.frames[0])));
      out["extras"]["ssphh"] = {{"type", name_of(light.type)}, {"radius", number(light.radius)}};
      out["extras"]["ssphh"]["emission"] = frames_to_json(light.emission);
      out["extras"]["ssphh"]["emission"]["intensity"] = number(light.intensity);
      break;
  }
  return out;
}

json::Value export_light_modes(const GltfExport& out) {
  json::Value modes;
  for (const scene::GroupMode& asked : out.scene.light_modes) modes[asked.group] = name_of(asked.mode);
  return modes;
}

json::Value export_environment(GltfExport& out) {
  if (!out.scene.environment) return nullptr;
  const scene::Environment& e = *out.scene.environment;
  json::Value environment = {{"name", e.name}};
  if (!e.group.empty()) environment["light_group"] = e.group;
  environment["color"] = numbers(e.color);
  environment["rotation"] = number(e.rotation);
  if (!e.equirect.empty()) {
    std::vector<float> rgb;
    for (int y = 0; y < e.equirect.height; ++y) {
      for (int x = 0; x < e.equirect.width; ++x) {
        const vec3 c = e.equirect.rgb(x, y);
        rgb.insert(rgb.end(), {c.x, c.y, c.z});
      }
    }
    const int view = add_buffer_view(out, std::as_bytes(std::span<const float>(rgb)), 0);
    environment["image"] = {{"bufferView", view}, {"width", e.equirect.width}, {"height", e.equirect.height}};
  }
  return environment;
}

void export_animations(GltfExport& out) {
  for (const scene::Animation& a : out.scene.animations) {
    if (a.channels.empty()) continue;  // glTF has no empty animations
    json::Value animation, samplers = json::Value::array(), channels = json::Value::array();
    if (!a.name.empty()) animation["name"] = a.name;
    for (const AnimationChannel& c : a.channels) {
      const int components = c.path == AnimationPath::rotation ? 4 : 3;
      std::vector<float> values;
      for (const vec4& v : c.values) values.insert(values.end(), &v.x, &v.x + components);
      const int input = add_float_accessor(out, c.times, 1, true, 0);
      const int output = add_float_accessor(out, values, components, false, 0);
      const int sampler = push(samplers, {{"input", input},
                                          {"interpolation", name_in(gltf_interpolations, c.interpolation)},
                                          {"output", output}});
      json::Value target = {{"node", c.node}, {"path", name_in(gltf_animation_paths, c.path)}};
      channels.push_back({{"sampler", sampler}, {"target", std::move(target)}});
    }
    animation["samplers"] = std::move(samplers);
    animation["channels"] = std::move(channels);
    out.animations.push_back(std::move(animation));
  }
}

}  // namespace ssphh::scene_io
