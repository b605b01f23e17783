#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {
namespace {

/// A little of everything.
Scene full_scene() {
  Scene s;
  s.textures.push_back({"t", 1, 2, std::vector<std::uint8_t>(8, 7)});
  s.textures.push_back({"u", 1, 2, std::vector<std::uint8_t>(8, 9)});
  s.materials.resize(3);
  s.materials[2].metallic = 1;
  s.materials[0].base_color_texture.texture = 0;
  s.materials[0].normal_texture.texture = 0;
  s.materials[0].alpha_mode = AlphaMode::mask;
  s.materials[0].emission = vec3(1);
  s.materials[0].transmission = 0.5f;
  s.meshes.push_back(make_box(vec3(0), vec3(1)));
  s.meshes[0].uvs[1] = s.meshes[0].uvs[0];
  s.meshes[0].tangents.assign(24, vec4(1, 0, 0, 1));
  s.meshes[0].colors.assign(24, vec4(1));
  s.meshes[0].material = 0;
  s.nodes.resize(3);
  s.nodes[0].name = "n";
  s.nodes[1].matrix = mat4(1);
  s.instances.resize(1);
  s.instances[0].mesh = s.instances[0].node = 0;
  s.cameras.resize(2);
  s.cameras[0].node = s.cameras[1].node = 0;
  s.cameras[1].orthographic = true;
  s.lights.resize(7);
  for (Light& l : s.lights) l.node = 0;
  s.lights[1].type = LightType::spot;
  s.lights[2].type = LightType::directional;
  s.lights[3].type = LightType::sphere;
  s.lights[3].radius = 1;
  s.lights[4].type = LightType::sphl;
  s.lights[4].radius = 1;
  s.lights[4].emission.frames = {sh::IntensitySh(1)};
  s.lights[5].type = LightType::rectangle;
  s.lights[5].size = vec2(1);
  s.lights[6].type = LightType::disc;
  s.lights[6].radius = 1;
  s.sphls.push_back({"s", 0, 0.1f, true});
  s.animations.resize(1);
  s.animations[0].channels.push_back(
      {2, AnimationPath::translation, Interpolation::linear, {0, 1}, {vec4(0), vec4(1)}});
  s.environment.emplace();
  s.environment->equirect = image::Image(2, 1);
  return s;
}

struct Change {
  const char* what;
  std::function<void(Scene&)> apply;
};

std::vector<Change> visible_changes() {
  const auto texture = [](auto change) {
    return [change](Scene& s) { change(s.materials[0].base_color_texture); };
  };
  const auto channel = [](auto change) {
    return [change](Scene& s) { change(s.animations[0].channels[0]); };
  };
  return {
      {"texel", [](Scene& s) { s.textures[0].rgba[3] = 8; }},
      {"texture shape", [](Scene& s) { std::swap(s.textures[0].width, s.textures[0].height); }},
      {"texture", texture([](TextureUse& t) { t.texture = 1; })},
      {"no texture", texture([](TextureUse& t) { t.texture = -1; })},
      {"uv set", texture([](TextureUse& t) { t.uv_set = 1; })},
      {"offset", texture([](TextureUse& t) { t.offset.y = 0.5f; })},
      {"scale", texture([](TextureUse& t) { t.scale.x = 0.5f; })},
      {"uv rotation", texture([](TextureUse& t) { t.rotation = 0.5f; })},
      {"wrap u", texture([](TextureUse& t) { t.wrap_u = Wrap::clamp; })},
      {"wrap v", texture([](TextureUse& t) { t.wrap_v = Wrap::mirror; })},
      {"nearest", texture([](TextureUse& t) { t.nearest = true; })},
      {"roughness texture", [](Scene& s) { s.materials[0].metallic_roughness_texture.texture = 0; }},
      {"emission texture", [](Scene& s) { s.materials[0].emission_texture.texture = 0; }},
      {"base colour", [](Scene& s) { s.materials[0].base_color.y = 0.5f; }},
      {"alpha", [](Scene& s) { s.materials[0].alpha = 0.5f; }},
      {"metallic", [](Scene& s) { s.materials[0].metallic = 0.5f; }},
      {"diffuse roughness", [](Scene& s) { s.materials[0].diffuse_roughness = -0.5f; }},
      {"specular roughness", [](Scene& s) { s.materials[0].specular_roughness = 0.5f; }},
      {"specular", [](Scene& s) { s.materials[0].specular = 0; }},
      {"ior", [](Scene& s) { s.materials[0].ior = 1.4f; }},
      {"transmission", [](Scene& s) { s.materials[0].transmission = 1; }},
      {"no transmission", [](Scene& s) { s.materials[0].transmission = 0; }},
      {"body", [](Scene& s) { s.materials[0].thickness = 1; }},
      {"transmission texture", [](Scene& s) { s.materials[0].transmission_texture.texture = 0; }},
      {"emission", [](Scene& s) { s.materials[0].emission.z = 2; }},
      {"unlit", [](Scene& s) { s.materials[0].unlit = true; }},
      {"double-sided", [](Scene& s) { s.materials[0].double_sided = true; }},
      {"alpha mode", [](Scene& s) { s.materials[0].alpha_mode = AlphaMode::blend; }},
      {"alpha cutoff", [](Scene& s) { s.materials[0].alpha_cutoff = 0.25f; }},
      {"normal scale", [](Scene& s) { s.materials[0].normal_scale = 0.5f; }},
      {"position", [](Scene& s) { s.meshes[0].positions[5].x += 1; }},
      {"normal", [](Scene& s) { s.meshes[0].normals[5] = vec3(0, 0, 1); }},
      {"tangent", [](Scene& s) { s.meshes[0].tangents[5].w = -1; }},
      {"uv 0", [](Scene& s) { s.meshes[0].uvs[0][5].x = 9; }},
      {"uv 1", [](Scene& s) { s.meshes[0].uvs[1][5].x = 9; }},
      {"colour", [](Scene& s) { s.meshes[0].colors[5].w = 0; }},
      {"triangle", [](Scene& s) { std::swap(s.meshes[0].triangles[0].x, s.meshes[0].triangles[0].y); }},
      {"mesh material", [](Scene& s) { s.meshes[0].material = 1; }},
      {"instance material", [](Scene& s) { s.instances[0].material = 2; }},
      {"instance node", [](Scene& s) { s.instances[0].node = 1; }},
      {"instance group", [](Scene& s) { s.instances[0].light_group = "g"; }},
      {"default group", [](Scene& s) { s.nodes[0].name = "m"; }},
      {"instance added", [](Scene& s) { s.instances.push_back(s.instances[0]); }},
      {"parent", [](Scene& s) { s.nodes[1].parent = 0; }},
      {"translation", [](Scene& s) { s.nodes[0].local.translation.z = 1; }},
      {"rotation", [](Scene& s) { s.nodes[0].local.rotation = quat(0, 1, 0, 0); }},
      {"node scale", [](Scene& s) { s.nodes[0].local.scale.z = 2; }},
      {"matrix", [](Scene& s) { (*s.nodes[1].matrix)[3][0] = 1; }},
      {"camera name", [](Scene& s) { s.cameras[0].name = "c"; }},
      {"camera node", [](Scene& s) { s.cameras[0].node = 1; }},
      {"projection", [](Scene& s) { s.cameras[0].orthographic = true; }},
      {"yfov", [](Scene& s) { s.cameras[0].yfov = 1; }},
      {"yheight", [](Scene& s) { s.cameras[1].yheight = 1; }},
      {"aspect", [](Scene& s) { s.cameras[0].aspect = 2.0f; }},
      {"light name", [](Scene& s) { s.lights[0].name = "l"; }},
      {"light group", [](Scene& s) { s.lights[0].group = "k"; }},
      {"light node", [](Scene& s) { s.lights[0].node = 1; }},
      {"light type", [](Scene& s) { s.lights[0].type = LightType::spot; }},
      {"light colour", [](Scene& s) { s.lights[0].color.x = 0; }},
      {"intensity", [](Scene& s) { s.lights[0].intensity = 2; }},
      {"range", [](Scene& s) { s.lights[0].range = 2; }},
      {"inner cone", [](Scene& s) { s.lights[1].inner_cone = 0.1f; }},
      {"outer cone", [](Scene& s) { s.lights[1].outer_cone = 0.1f; }},
      {"angular radius", [](Scene& s) { s.lights[2].angular_radius = 0.1f; }},
      {"sphere radius", [](Scene& s) { s.lights[3].radius = 0.1f; }},
      {"width of a rectangle", [](Scene& s) { s.lights[5].size.x = 0.1f; }},
      {"height of a rectangle", [](Scene& s) { s.lights[5].size.y = 0.1f; }},
      {"radius of a disc", [](Scene& s) { s.lights[6].radius = 0.1f; }},
      {"radius of an SPHL that shines", [](Scene& s) { s.lights[4].radius = 0.1f; }},
      {"emission", [](Scene& s) { s.lights[4].emission.frames[0][2].y = 1; }},
      {"emission's frames", [](Scene& s) { s.lights[4].emission.frames.emplace_back(1); }},
      {"emission's rate", [](Scene& s) { s.lights[4].emission.rate = 1; }},
      {"emission's start", [](Scene& s) { s.lights[4].emission.start = 1; }},
      {"emission repeats", [](Scene& s) { s.lights[4].emission.repeat = true; }},
      {"SPHL name", [](Scene& s) { s.sphls[0].name = "z"; }},
      {"SPHL node", [](Scene& s) { s.sphls[0].node = 1; }},
      {"SPHL radius", [](Scene& s) { s.sphls[0].radius = 1; }},
      {"SPHL enabled", [](Scene& s) { s.sphls[0].enabled = false; }},
      {"channel node", channel([](AnimationChannel& c) { c.node = 0; })},
      {"channel path", channel([](AnimationChannel& c) { c.path = AnimationPath::scale; })},
      {"interpolation", channel([](AnimationChannel& c) { c.interpolation = Interpolation::step; })},
      {"key time", channel([](AnimationChannel& c) { c.times[1] = 2; })},
      {"key value", channel([](AnimationChannel& c) { c.values[1].x = 2; })},
      {"no environment", [](Scene& s) { s.environment.reset(); }},
      {"environment colour", [](Scene& s) { s.environment->color.x = 2; }},
      {"environment rotation", [](Scene& s) { s.environment->rotation = 2; }},
      {"environment group", [](Scene& s) { s.environment->group = "e"; }},
      {"environment pixel", [](Scene& s) { s.environment->equirect.pixels[0] = 2; }},
  };
}

TEST(SceneHash, EveryVisibleChangeGivesAnotherHash) {
  const Hash128 before = scene_hash(full_scene());
  std::vector<Hash128> seen{before};
  for (const Change& change : visible_changes()) {
    Scene scene = full_scene();
    change.apply(scene);
    const Hash128 after = scene_hash(scene);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), after), 0) << change.what;
    seen.push_back(after);
  }
}

TEST(SceneHash, InvisibleChangesKeepIt) {
  const std::vector<Change> changes = {
      {"scene name", [](Scene& s) { s.name = "x"; }},
      {"ignored", [](Scene& s) { s.ignored.emplace_back("x"); }},
      {"texture name", [](Scene& s) { s.textures[0].name = "x"; }},
      {"material name", [](Scene& s) { s.materials[0].name = "x"; }},
      {"mesh name", [](Scene& s) { s.meshes[0].name = "x"; }},
      {"name of a node that is no light group", [](Scene& s) { s.nodes[1].name = "x"; }},
      {"unused material", [](Scene& s) { s.materials.emplace_back(); }},
      {"unused mesh", [](Scene& s) { s.meshes.emplace_back(); }},
      {"copied mesh", [](Scene& s) { s.meshes.push_back(s.meshes[0]), s.instances[0].mesh = 1; }},
      {"signs of zeros", [](Scene& s) { s.nodes[0].local.translation = -s.nodes[0].local.translation; }},
      {"signs of zeros of an offset",
       [](Scene& s) { s.materials[0].base_color_texture.offset = vec2(-0.0f, -0.0f); }},
      {"signs of zeros of a rotation",
       [](Scene& s) { s.nodes[0].local.rotation = quat(1, -0.0f, -0.0f, -0.0f); }},
      {"size of a point light", [](Scene& s) { s.lights[0].size.x = 0.3f; }},
      {"cone of a point light", [](Scene& s) { s.lights[0].outer_cone = 0.3f; }},
  };
  const Hash128 before = scene_hash(full_scene());
  for (const Change& change : changes) {
    Scene scene = full_scene();
    change.apply(scene);
    EXPECT_EQ(scene_hash(scene), before) << change.what;
  }
}

TEST(SceneHash, TheGroupOfWhatDoesNotGlowIsNoDifference) {
  Scene a = full_scene();
  a.instances.push_back({0, 1, 1, "lit"});  // by a material that does not glow
  a.instances.push_back({0, 1, -1, "lit"});
  Scene b = a;
  b.instances[1].light_group = "unlit";
  EXPECT_EQ(scene_hash(a), scene_hash(b));
  b.instances[2].light_group = "unlit";
  EXPECT_NE(scene_hash(a), scene_hash(b)) << "its mesh's material glows";
}

TEST(SceneHash, HalfATurnIsTheSameWhateverTheSignOfItsZeros) {
  Scene plus = full_scene(), minus = full_scene();
  plus.nodes[0].local.rotation = quat(0, 0, 1, 0),
  minus.nodes[0].local.rotation = quat(-0.0f, -0.0f, 1, -0.0f);
  EXPECT_EQ(scene_hash(plus), scene_hash(minus));
}

TEST(LightHash, TheNumberOfAParentIsNoDifference) {
  Scene a;
  a.nodes.resize(2);
  a.nodes[1].parent = 0;
  a.nodes[0].local.translation = {1, 2, 3};
  a.meshes.push_back(make_box(vec3(0), vec3(1)));
  a.instances = {{0, 1, -1, {}}};
  Scene b = a;
  b.nodes.insert(b.nodes.begin(), Node{});
  b.nodes[2].parent = 1, b.instances[0].node = 2;
  EXPECT_EQ(light_hash(a), light_hash(b));
  b.nodes[2].parent = 0;
  EXPECT_NE(light_hash(a), light_hash(b)) << "it stands elsewhere";
}

TEST(LightHash, ObserversKeepIt) {
  const std::vector<Change> changes = {
      {"no cameras", [](Scene& s) { s.cameras.clear(); }},
      {"camera", [](Scene& s) { s.cameras[0].yfov = 1; }},
      {"no SPHLs", [](Scene& s) { s.sphls.clear(); }},
      {"SPHL", [](Scene& s) { s.sphls[0].radius = 2; }},
      {"a node of a new camera, in front of all others",
       [](Scene& s) {
         s.nodes.insert(s.nodes.begin(), Node{});
         for (std::size_t i = 1; i < s.nodes.size(); ++i) s.nodes[i].parent += s.nodes[i].parent >= 0;
         for (Instance& instance : s.instances) ++instance.node;
         for (Light& light : s.lights) ++light.node;
         for (AnimationChannel& c : s.animations[0].channels) ++c.node;
         s.cameras[0].node = 0;
       }},
      {"motion of a node that carries nothing", [](Scene& s) { s.animations.clear(); }},
      {"scene name", [](Scene& s) { s.name = "x"; }},
  };
  const Hash128 before = light_hash(full_scene());
  for (const Change& change : changes) {
    Scene scene = full_scene();
    change.apply(scene);
    EXPECT_EQ(light_hash(scene), before) << change.what;
  }
}

TEST(LightHash, WhatLightDependsOnChangesIt) {
  const std::vector<Change> changes = {
      {"place", [](Scene& s) { s.nodes[0].local.translation.x = 1; }},
      {"place of a parent", [](Scene& s) { s.nodes[2].parent = 0, s.instances[0].node = 2; }},
      {"motion", [](Scene& s) { s.animations[0].channels[0].node = 0; }},
      {"mesh", [](Scene& s) { s.meshes[0].positions[0].x = 9; }},
      {"material", [](Scene& s) { s.materials[0].metallic = 0.5f; }},
      {"light", [](Scene& s) { s.lights[1].intensity = 2; }},
      {"light's group", [](Scene& s) { s.lights[0].group = "g"; }},
      {"fewer lights", [](Scene& s) { s.lights.pop_back(); }},
      {"environment", [](Scene& s) { s.environment->color.x = 2; }},
  };
  std::vector<Hash128> seen{light_hash(full_scene()), scene_hash(full_scene())};
  for (const Change& change : changes) {
    Scene scene = full_scene();
    change.apply(scene);
    const Hash128 after = light_hash(scene);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), after), 0) << change.what;
    seen.push_back(after);
  }
}

}  // namespace
}  // namespace ssphh::scene
