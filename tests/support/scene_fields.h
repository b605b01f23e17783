#pragma once
/// Every field of a scene, one by one. The structured bindings name all members of each type: whoever adds
/// one is stopped here by the compiler, and the tests that walk the fields (hashes, round trips) see it from
/// then on.

#include <string>

#include <fmt/format.h>

#include <ssphh/scene/scene.h>

namespace ssphh::test {

/// Calls visit(path, field) for every number, text, enumeration and array of plain values of a scene. The
/// colour of the second light is "lights[1].color".
template <class Visit>
class SceneFields {
 public:
  SceneFields(scene::Scene& scene, const Visit& visit) : visit_(visit) { members("", scene); }

 private:
  template <class T>
  void items(const std::string& at, std::vector<T>& all) {
    for (std::size_t i = 0; i < all.size(); ++i) members(fmt::format("{}[{}].", at, i), all[i]);
  }

  void members(const std::string& at, scene::Scene& scene) {
    auto& [name, textures, materials, meshes, nodes, instances, cameras, lights, sphls, animations,
           environment, light_modes, dark_groups, ignored] = scene;
    visit_(at + "name", name);
    items(at + "textures", textures);
    items(at + "materials", materials);
    items(at + "meshes", meshes);
    items(at + "nodes", nodes);
    items(at + "instances", instances);
    items(at + "cameras", cameras);
    items(at + "lights", lights);
    items(at + "sphls", sphls);
    items(at + "animations", animations);
    if (environment) members(at + "environment.", *environment);
    items(at + "light_modes", light_modes);
    visit_(at + "dark_groups", dark_groups);
    visit_(at + "ignored", ignored);
  }

  void members(const std::string& at, scene::GroupMode& asked) {
    auto& [group, mode] = asked;
    visit_(at + "group", group);
    visit_(at + "mode", mode);
  }

  void members(const std::string& at, scene::Texture& texture) {
    auto& [name, width, height, rgba] = texture;
    visit_(at + "name", name);
    visit_(at + "width", width);
    visit_(at + "height", height);
    visit_(at + "rgba", rgba);
  }

  void members(const std::string& at, scene::TextureUse& use) {
    auto& [texture, uv_set, offset, scale, rotation, wrap_u, wrap_v, nearest] = use;
    visit_(at + "texture", texture);
    visit_(at + "uv_set", uv_set);
    visit_(at + "offset", offset);
    visit_(at + "scale", scale);
    visit_(at + "rotation", rotation);
    visit_(at + "wrap_u", wrap_u);
    visit_(at + "wrap_v", wrap_v);
    visit_(at + "nearest", nearest);
  }

  void members(const std::string& at, scene::Material& material) {
    auto& [name, base_color, alpha, metallic, diffuse_roughness, specular_roughness, specular, ior,
           transmission, thickness, attenuation_color, attenuation_distance, emission, unlit, double_sided,
           alpha_mode, alpha_cutoff, normal_scale, base_color_texture, metallic_roughness_texture,
           emission_texture, normal_texture, transmission_texture] = material;
    visit_(at + "name", name);
    visit_(at + "base_color", base_color);
    visit_(at + "alpha", alpha);
    visit_(at + "metallic", metallic);
    visit_(at + "diffuse_roughness", diffuse_roughness);
    visit_(at + "specular_roughness", specular_roughness);
    visit_(at + "specular", specular);
    visit_(at + "ior", ior);
    visit_(at + "transmission", transmission);
    visit_(at + "thickness", thickness);
    visit_(at + "attenuation_color", attenuation_color);
    visit_(at + "attenuation_distance", attenuation_distance);
    visit_(at + "emission", emission);
    visit_(at + "unlit", unlit);
    visit_(at + "double_sided", double_sided);
    visit_(at + "alpha_mode", alpha_mode);
    visit_(at + "alpha_cutoff", alpha_cutoff);
    visit_(at + "normal_scale", normal_scale);
    members(at + "base_color_texture.", base_color_texture);
    members(at + "metallic_roughness_texture.", metallic_roughness_texture);
    members(at + "emission_texture.", emission_texture);
    members(at + "normal_texture.", normal_texture);
    members(at + "transmission_texture.", transmission_texture);
  }

  void members(const std::string& at, scene::Mesh& mesh) {
    auto& [name, positions, normals, tangents, uvs, colors, triangles, material] = mesh;
    visit_(at + "name", name);
    visit_(at + "positions", positions);
    visit_(at + "normals", normals);
    visit_(at + "tangents", tangents);
    visit_(at + "uvs[0]", uvs[0]);
    visit_(at + "uvs[1]", uvs[1]);
    visit_(at + "colors", colors);
    visit_(at + "triangles", triangles);
    visit_(at + "material", material);
  }

  void members(const std::string& at, scene::Node& node) {
    auto& [name, parent, local, matrix, movable] = node;
    auto& [translation, rotation, scale] = local;
    visit_(at + "name", name);
    visit_(at + "parent", parent);
    visit_(at + "translation", translation);
    visit_(at + "rotation", rotation);
    visit_(at + "scale", scale);
    visit_(at + "matrix", matrix);
    visit_(at + "movable", movable);
  }

  void members(const std::string& at, scene::Instance& instance) {
    auto& [mesh, node, material, light_group] = instance;
    visit_(at + "mesh", mesh);
    visit_(at + "node", node);
    visit_(at + "material", material);
    visit_(at + "light_group", light_group);
  }

  void members(const std::string& at, scene::Camera& camera) {
    auto& [name, node, orthographic, yfov, yheight, aspect] = camera;
    visit_(at + "name", name);
    visit_(at + "node", node);
    visit_(at + "orthographic", orthographic);
    visit_(at + "yfov", yfov);
    visit_(at + "yheight", yheight);
    visit_(at + "aspect", aspect);
  }

  void members(const std::string& at, scene::Light& light) {
    auto& [name, group, node, type, color, intensity, radius, size, emission, angular_radius, inner_cone,
           outer_cone, range, profile] = light;
    auto& [frames, rate, start, repeat] = emission;
    visit_(at + "name", name);
    visit_(at + "group", group);
    visit_(at + "node", node);
    visit_(at + "type", type);
    visit_(at + "color", color);
    visit_(at + "intensity", intensity);
    visit_(at + "radius", radius);
    visit_(at + "size", size);
    visit_(at + "angular_radius", angular_radius);
    visit_(at + "inner_cone", inner_cone);
    visit_(at + "outer_cone", outer_cone);
    visit_(at + "range", range);
    for (std::size_t i = 0; i < frames.size(); ++i)
      visit_(at + "emission.frames[" + std::to_string(i) + "]", frames[i].values);
    visit_(at + "emission.rate", rate);
    visit_(at + "emission.start", start);
    visit_(at + "emission.repeat", repeat);
    visit_(at + "profile.name", profile.name);
    if (profile.empty()) return;
    scene::PhotometricTable table = *profile.table;
    auto& [photometry, polar, turn, candela] = table;
    visit_(at + "profile.type", photometry);
    visit_(at + "profile.polar", polar);
    visit_(at + "profile.turn", turn);
    visit_(at + "profile.candela", candela);
    profile.table = std::make_shared<const scene::PhotometricTable>(table);
  }

  void members(const std::string& at, scene::Sphl& sphl) {
    auto& [name, node, radius, enabled] = sphl;
    visit_(at + "name", name);
    visit_(at + "node", node);
    visit_(at + "radius", radius);
    visit_(at + "enabled", enabled);
  }

  void members(const std::string& at, scene::Animation& animation) {
    auto& [name, channels] = animation;
    visit_(at + "name", name);
    items(at + "channels", channels);
  }

  void members(const std::string& at, scene::AnimationChannel& channel) {
    auto& [node, path, interpolation, times, values] = channel;
    visit_(at + "node", node);
    visit_(at + "path", path);
    visit_(at + "interpolation", interpolation);
    visit_(at + "times", times);
    visit_(at + "values", values);
  }

  void members(const std::string& at, scene::Environment& environment) {
    // Where the image is from changes no picture
    auto& [name, group, equirect, color, rotation, sun_sky] = environment;
    static_cast<void>(sun_sky);
    auto& [width, height, channels, pixels] = equirect;
    visit_(at + "name", name);
    visit_(at + "group", group);
    visit_(at + "equirect.width", width);
    visit_(at + "equirect.height", height);
    visit_(at + "equirect.channels", channels);
    visit_(at + "equirect.pixels", pixels);
    visit_(at + "color", color);
    visit_(at + "rotation", rotation);
  }

  const Visit& visit_;
};

}  // namespace ssphh::test
