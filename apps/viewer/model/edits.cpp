#include "edits.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include <ssphh/image/io.h>
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

std::vector<scene::Camera> edited_cameras(scene::Scene& scene, const Edits& edits) {
  std::vector<scene::Camera> cameras;
  for (const CameraEdit& edit : edits.cameras) {
    scene::Camera camera = edit.source >= 0 ? scene.cameras[index(edit.source)] : scene::Camera{};
    if (edit.view) {
      const scene::CameraPose pose = pose_of(*edit.view);
      const std::optional<float> aspect = camera.aspect;
      camera = pose.camera;
      camera.aspect = aspect;
      camera.node = add_root_node(scene, edit.name, edit.view->eye);
      scene.nodes.back().local.rotation = edit.view->orientation;
    }
    camera.name = edit.name;
    cameras.push_back(camera);
  }
  return cameras;
}

/// Throws Error for an empty name and one that another of the list has.
template <class List, class Name>
void check_name(const char* what, const List& list, std::size_t own, const std::string& name,
                const Name& name_of) {
  if (name.empty()) throw Error(what, fmt::format("a {} needs a name", what));
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i != own && name_of(list[i]) == name)
      throw Error(what, fmt::format("there is a {} \"{}\" already", what, name), "choose another name");
  }
}

template <class List, class Same>
int same_in(const List& before, int index, const List& after, const Same& same) {
  if (before.size() == after.size()) return index;
  const auto found =
      std::ranges::find_if(after, [&](const auto& other) { return same(other, before[index]); });
  return found == after.end() ? -1 : static_cast<int>(found - after.begin());
}

/// By some thousand pixels: every frame asks, and pictures of skies are large.
bool same_image(const image::Image& a, const image::Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels) return false;
  const std::size_t step = std::max<std::size_t>(a.pixels.size() / 4099, 1);
  for (std::size_t i = 0; i < a.pixels.size(); i += step) {
    if (a.pixels[i] != b.pixels[i]) return false;
  }
  return true;
}

bool has_surroundings(const scene::Scene& scene, const scene::Scene& opened, const Edits& edits) {
  if (&scene == &opened) return !edits.surroundings;
  if (edits.surroundings)
    return scene.environment && !scene.environment->sun_sky &&
           same_image(scene.environment->equirect, *edits.surroundings->image);
  if (!scene.environment || !opened.environment)
    return scene.environment.has_value() == opened.environment.has_value();
  return same_image(scene.environment->equirect, opened.environment->equirect);
}

}  // namespace

Surroundings read_surroundings(const std::string& file) {
  const image::Image read = image::read_image(file);
  if (read.width != 2 * read.height)
    throw Error(file, fmt::format("{} by {} pixels are no picture of the whole sky", read.width, read.height),
                "take an equirectangular one, twice as wide as high");
  auto picture = std::make_shared<image::Image>(read.width, read.height);
  for (int y = 0; y < read.height; ++y) {
    for (int x = 0; x < read.width; ++x) picture->set_rgb(x, y, glm::max(read.rgb(x, y), vec3(0)));
  }
  if (!std::ranges::all_of(read.pixels, [](float v) { return std::isfinite(v); }))
    throw Error(file, "holds radiance that is not finite");
  return {std::filesystem::absolute(file).lexically_normal().string(), std::move(picture)};
}

Edits edits_of(const scene::Scene& scene) {
  Edits edits;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const scene::Light& light = scene.lights[i];
    edits.lights.push_back({{}, light.color, light.intensity, true, static_cast<int>(i), lamp_of(light)});
  }
  for (const std::string& group : scene.dark_groups) edits.groups[group] = vec3(0);
  edits.materials = scene.materials;
  for (std::size_t i = 0; i < scene.sphls.size(); ++i) {
    const scene::Sphl& sphl = scene.sphls[i];
    edits.sphls.push_back({static_cast<int>(i), {}, sphl.name, sphl.radius, sphl.enabled});
  }
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    edits.cameras.push_back({static_cast<int>(i), scene.cameras[i].name, {}});
  return edits;
}

bool same_surface(const scene::Material& a, const scene::Material& b) {
  return a.base_color == b.base_color && a.alpha == b.alpha && a.metallic == b.metallic &&
         a.diffuse_roughness == b.diffuse_roughness && a.specular_roughness == b.specular_roughness &&
         a.specular == b.specular && a.ior == b.ior && a.transmission == b.transmission &&
         a.thickness == b.thickness && a.attenuation_color == b.attenuation_color &&
         a.attenuation_distance == b.attenuation_distance && a.emission == b.emission;
}

scene::Scene with_lamps(scene::Scene scene, const Edits& edits) {
  std::vector<scene::Light> lights;
  for (const LightEdit& edit : edits.lights) {
    scene::Light light = light_of(edit.lamp, edit.color, edit.intensity);
    // Acceleration structures are built for these nodes; a new lamp says itself where it stands.
    light.node = 0;
    if (edit.source >= 0) {
      const scene::Light& own = scene.lights[index(edit.source)];
      light.color = own.color, light.intensity = own.intensity, light.node = own.node;
    }
    lights.push_back(std::move(light));
  }
  scene.lights = std::move(lights);
  if (edits.surroundings) {
    scene::Environment environment;
    // Factors on its group go on to hold.
    if (scene.environment)
      environment.name = scene.environment->name, environment.group = scene.environment->group;
    environment.equirect = *edits.surroundings->image;
    scene.environment = std::move(environment);
  }
  return scene;
}

bool has_lamps(const scene::Scene& scene, const scene::Scene& opened, const Edits& edits) {
  return has_surroundings(scene, opened, edits) &&
         std::ranges::equal(scene.lights, edits.lights,
                            [](const scene::Light& a, const LightEdit& b) { return lamp_of(a) == b.lamp; });
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

scene::Scene edited_scene(scene::Scene scene, const Edits& edits, float time, DarkLight dark) {
  scene = with_lamps(with_materials(std::move(scene), edits), edits);
  const scene::LightingState lighting = edited_lighting(scene, edits, time);
  scene = dark == DarkLight::kept ? scene::keeping_dark_light(std::move(scene), lighting)
                                  : scene::with_lighting(std::move(scene), lighting);
  scene.sphls = edited_sphls(scene, edits);
  scene.cameras = edited_cameras(scene, edits);
  return scene;
}

bool same_places(const std::vector<SphlEdit>& a, const std::vector<SphlEdit>& b) {
  return std::ranges::equal(a, b, [](const SphlEdit& x, const SphlEdit& y) {
    return x.source == y.source && x.position == y.position && x.enabled == y.enabled;
  });
}

bool same_light(const Edits& a, const Edits& b) {
  const auto sky = [](const Edits& e) { return e.sky ? e.sky->image : nullptr; };
  const auto around = [](const Edits& e) { return e.surroundings ? e.surroundings->image : nullptr; };
  return around(a) == around(b) && a.lights == b.lights && a.environment_rotation == b.environment_rotation &&
         sky(a) == sky(b) && std::ranges::equal(a.materials, b.materials, same_surface);
}

vec3 sphl_position(const scene::Scene& scene, const std::vector<mat4>& world, const SphlEdit& sphl) {
  if (sphl.position) return *sphl.position;
  return vec3(world[index(scene.sphls[index(sphl.source)].node)][3]);
}

int same_sphl(const std::vector<SphlEdit>& before, int index, const std::vector<SphlEdit>& after) {
  return same_in(before, index, after, [](const SphlEdit& a, const SphlEdit& b) {
    return a.source == b.source && a.name == b.name;
  });
}

int same_lamp(const std::vector<LightEdit>& before, int index, const std::vector<LightEdit>& after) {
  return same_in(before, index, after, [](const LightEdit& a, const LightEdit& b) {
    return a.source == b.source && a.lamp.name == b.lamp.name;
  });
}

std::string new_sphl_name(const Edits& edits) {
  for (std::size_t n = edits.sphls.size() + 1;; ++n) {
    std::string name = fmt::format("SPHL {}", n);
    if (std::ranges::none_of(edits.sphls, [&](const SphlEdit& sphl) { return sphl.name == name; }))
      return name;
  }
}

std::string new_lamp_name(const Edits& edits, const std::string& like) {
  // "spot 2" goes on as "spot 3".
  const std::size_t digits = like.find_last_not_of("0123456789");
  const bool numbered = digits != like.npos && like[digits] == ' ' && digits + 1 < like.size();
  const std::string stem = numbered ? like.substr(0, digits) : like;
  for (std::size_t n = 1;; ++n) {
    std::string name = fmt::format("{} {}", stem, n);
    if (std::ranges::none_of(edits.lights, [&](const LightEdit& light) { return light.lamp.name == name; }))
      return name;
  }
}

void rename_lamp(Edits& edits, std::size_t lamp, const std::string& name) {
  check_name("lamp", edits.lights, lamp, name, [](const LightEdit& l) { return l.lamp.name; });
  Lamp& renamed = edits.lights[lamp].lamp;
  if (renamed.group.empty()) renamed.group = renamed.name;
  renamed.name = name;
}

void rename_camera(Edits& edits, std::size_t camera, const std::string& name) {
  check_name("camera", edits.cameras, camera, name, [](const CameraEdit& c) { return c.name; });
  edits.cameras[camera].name = name;
}

void add_camera(Edits& edits, const std::string& name, const View& view) {
  check_name("camera", edits.cameras, edits.cameras.size(), name, [](const CameraEdit& c) { return c.name; });
  edits.cameras.push_back({-1, name, view});
}

}  // namespace ssphh::viewer
