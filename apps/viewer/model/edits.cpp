#include "edits.h"

#include <algorithm>

#include <fmt/format.h>

#include <ssphh/scene/turn_surroundings.h>

namespace ssphh::viewer {
namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

int add_root_node(scene::Scene& scene, const std::string& name, const vec3& position) {
  scene::Node node;
  node.name = name;
  node.local.translation = position;
  scene.nodes.push_back(node);
  return static_cast<int>(scene.nodes.size()) - 1;
}

std::vector<scene::Sphl> edited_sphls(scene::Scene& scene, const Edits& edits) {
  std::vector<scene::Sphl> sphls;
  for (const SphlEdit& edit : edits.sphls) {
    scene::Sphl sphl = edit.source >= 0 ? scene.sphls[index(edit.source)] : scene::Sphl{};
    if (edit.position) sphl.node = add_root_node(scene, edit.name, *edit.position);
    sphl.name = edit.name;
    sphl.radius = edit.radius;
    sphl.enabled = edit.enabled;
    sphls.push_back(sphl);
  }
  return sphls;
}

}  // namespace

Edits edits_of(const scene::Scene& scene) {
  Edits edits;
  for (const scene::Light& light : scene.lights)
    edits.lights.push_back({{}, light.color, light.intensity, true});
  edits.materials = scene.materials;
  for (std::size_t i = 0; i < scene.sphls.size(); ++i) {
    const scene::Sphl& sphl = scene.sphls[i];
    edits.sphls.push_back({static_cast<int>(i), {}, sphl.name, sphl.radius, sphl.enabled});
  }
  return edits;
}

bool same_surface(const scene::Material& a, const scene::Material& b) {
  return a.base_color == b.base_color && a.alpha == b.alpha && a.metallic == b.metallic &&
         a.diffuse_roughness == b.diffuse_roughness && a.specular_roughness == b.specular_roughness &&
         a.specular == b.specular && a.ior == b.ior && a.transmission == b.transmission &&
         a.thickness == b.thickness && a.attenuation_color == b.attenuation_color &&
         a.attenuation_distance == b.attenuation_distance && a.emission == b.emission;
}

scene::LightingState edited_lighting(const scene::Scene& scene, const Edits& edits, float time) {
  scene::LightingState state = scene::lighting_at(scene, time);
  if (edits.sky) scene::set_sun_sky(state, scene, *edits.sky);
  const int sun = edits.sky ? scene::sun_light(scene) : -1;
  scene::turn_surroundings(state, scene, edits.environment_rotation);
  for (std::size_t i = 0; i < state.lights.size(); ++i) {
    const LightEdit& edit = edits.lights[i];
    const scene::Light& own = scene.lights[i];
    if (edit.world) state.lights[i].world = *edit.world;
    // The sky knows how bright its sun is, until somebody says otherwise
    if (index(sun) != i || edit.color != own.color || edit.intensity != own.intensity) {
      state.lights[i].color = edit.color;
      state.lights[i].intensity = edit.intensity;
    }
    if (!edit.on) state.lights[i].intensity = 0;
  }
  const std::vector<std::string> groups = scene::light_groups(scene);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto found = edits.groups.find(groups[g]);
    if (found != edits.groups.end()) state.group_scales[g] = found->second;
  }
  return state;
}

scene::Scene with_materials(scene::Scene scene, const Edits& edits) {
  scene.materials = edits.materials;
  return scene;
}

scene::Scene edited_scene(scene::Scene scene, const Edits& edits, float time) {
  scene = with_materials(std::move(scene), edits);
  const scene::LightingState lighting = edited_lighting(scene, edits, time);
  scene = scene::with_lighting(std::move(scene), lighting);
  scene.sphls = edited_sphls(scene, edits);
  return scene;
}

bool same_places(const std::vector<SphlEdit>& a, const std::vector<SphlEdit>& b) {
  return std::ranges::equal(a, b, [](const SphlEdit& x, const SphlEdit& y) {
    return x.source == y.source && x.position == y.position && x.enabled == y.enabled;
  });
}

vec3 sphl_position(const scene::Scene& scene, const std::vector<mat4>& world, const SphlEdit& sphl) {
  if (sphl.position) return *sphl.position;
  return vec3(world[index(scene.sphls[index(sphl.source)].node)][3]);
}

int same_sphl(const std::vector<SphlEdit>& before, int index, const std::vector<SphlEdit>& after) {
  if (before.size() == after.size()) return index;
  const SphlEdit& sphl = before[static_cast<std::size_t>(index)];
  const auto found = std::ranges::find_if(
      after, [&](const SphlEdit& s) { return s.source == sphl.source && s.name == sphl.name; });
  return found == after.end() ? -1 : static_cast<int>(found - after.begin());
}

std::string new_sphl_name(const Edits& edits) {
  for (std::size_t n = edits.sphls.size() + 1;; ++n) {
    std::string name = fmt::format("SPHL {}", n);
    if (std::ranges::none_of(edits.sphls, [&](const SphlEdit& sphl) { return sphl.name == name; }))
      return name;
  }
}

vec3 light_position(const mat4& world) {
  return vec3(world[3]);
}

vec3 light_direction(const mat4& world) {
  return -glm::normalize(vec3(world[2]));
}

mat4 with_position(const mat4& world, const vec3& position) {
  mat4 out = world;
  out[3] = vec4(position, 1);
  return out;
}

mat4 with_direction(const mat4& world, const vec3& direction) {
  const Frame frame = Frame::around(-glm::normalize(direction));
  return {vec4(frame.x, 0), vec4(frame.y, 0), vec4(frame.z, 0), world[3]};
}

}  // namespace ssphh::viewer
