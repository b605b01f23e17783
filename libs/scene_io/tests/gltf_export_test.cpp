#include <cstring>
#include <functional>
#include <limits>
#include <ostream>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/gltf_export.h>

#include "error_message.h"
#include "json_text.h"
#include "temp_dir.h"

namespace ssphh::scene {

void PrintTo(const BuiltinScene& scene, std::ostream* out) {
  *out << scene.name;
}

}  // namespace ssphh::scene

namespace ssphh::scene_io {
namespace {

using namespace scene;

const json::Value json_chunk(const std::vector<std::byte>& glb) {
  std::uint32_t header[5];
  std::memcpy(header, glb.data(), sizeof header);
  EXPECT_EQ(header[0], 0x46546c67u);
  EXPECT_EQ(header[1], 2u);
  EXPECT_EQ(header[2], glb.size());
  EXPECT_EQ(header[3] % 4, 0u);
  EXPECT_EQ(header[4], 0x4e4f534au);
  const auto* text = reinterpret_cast<const char*>(glb.data()) + sizeof header;
  return test::parse_json({text, header[3]});
}

Scene round_trip(const Scene& scene) {
  Scene again = load_gltf(export_glb(scene), "memory.glb");
  EXPECT_TRUE(validate(again).empty());
  EXPECT_TRUE(again.ignored.empty());
  return again;
}

/// Everything a scene can hold, with numbers that are no short decimals.
Scene full_scene() {
  Scene s;
  s.name = "full";
  for (int t = 0; t < 2; ++t) {
    Texture texture{"texture", 3, 2, {}};
    for (int i = 0; i < 24; ++i) texture.rgba.push_back(static_cast<std::uint8_t>(7 * i + 100 * t));
    s.textures.push_back(texture);
  }
  Material m;
  m.name = "all";
  m.base_color = vec3(1 / 3.0f, 0.1f, 0.7f);
  m.alpha = 0.9f;
  m.metallic = 0.2f;
  m.diffuse_roughness = -0.37f;
  m.specular_roughness = -0.61f;
  m.specular = 0.3f;
  m.ior = 1.37f;
  m.emission = vec3(17.1f, 12.3f, 1 / 7.0f);
  m.double_sided = true;
  m.alpha_mode = AlphaMode::mask;
  m.alpha_cutoff = 0.41f;
  m.normal_scale = 0.8f;
  m.base_color_texture = {0, 1, {0.1f, 0.2f}, {2, 3}, 0.4f, Wrap::mirror, Wrap::clamp, true};
  m.metallic_roughness_texture.texture = 1;
  m.emission_texture = {1, 0, {0, 0}, {1, 1}, 0, Wrap::clamp, Wrap::repeat, false};
  m.normal_texture.texture = 0;
  s.materials.push_back(m);
  Material unlit;
  unlit.unlit = true;
  unlit.alpha_mode = AlphaMode::blend;
  unlit.specular_roughness = 0.25f;
  unlit.diffuse_roughness = 0.75f;
  unlit.emission = vec3(0.5f);
  s.materials.push_back(unlit);

  Mesh box = make_box(vec3(-0.1f), vec3(1 / 3.0f));
  box.name = "box";
  box.uvs[1] = box.uvs[0];
  box.tangents.assign(24, vec4(1, 0, 0, -1));
  box.colors.assign(24, vec4(0.1f, 0.2f, 0.3f, 0.4f));
  box.material = 0;
  s.meshes.push_back(box);
  Mesh bare;
  bare.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1 / 7.0f, 0}};
  bare.triangles = {{0, 1, 2}};
  s.meshes.push_back(bare);
  s.meshes.push_back(make_sphere(1, 300, 250));  // more vertices than 16 bits count

  const auto node = [&](const char* name, int parent) {
    s.nodes.emplace_back();
    s.nodes.back().name = name;
    s.nodes.back().parent = parent;
    return static_cast<int>(s.nodes.size()) - 1;
  };
  const int root = node("root", -1), child = node("child", root), moving = node("moving", child);
  s.nodes[0].local = {{0.1f, 0.2f, 0.3f}, glm::normalize(quat(0.1f, 0.2f, 0.3f, 0.4f)), {1, 2, 3}};
  s.nodes[1].matrix = s.nodes[0].local.matrix();
  s.instances = {{0, root, -1, "glow"}, {1, root, 1, "glow"}, {1, child, 0, ""}, {2, moving, -1, ""}};

  s.cameras.resize(2);
  s.cameras[0].name = "perspective", s.cameras[0].node = node("c0", -1), s.cameras[0].yfov = 0.7f;
  s.cameras[1].name = "orthographic", s.cameras[1].node = node("c1", -1), s.cameras[1].orthographic = true;
  s.cameras[1].yheight = 3, s.cameras[1].aspect = 1.5f;

  for (int i = 0; i < 5; ++i) {
    Light light;
    light.name = "light " + std::to_string(i);
    light.node = node(light.name.c_str(), -1);
    light.type = static_cast<LightType>(i);
    light.color = {1, 0.9f, 0.7f};
    light.intensity = 12.34f;
    s.lights.push_back(light);
  }
  s.lights[0].group = "ceiling", s.lights[0].range = 5.5f;
  s.lights[1].inner_cone = 0.2f, s.lights[1].outer_cone = 0.6f;
  s.lights[2].angular_radius = 0.00465f;
  s.lights[3].radius = 0.15f;
  s.lights[4].radius = 0.4f;
  s.lights[4].emission = {{sh::IntensitySh(2), sh::IntensitySh(2)}, 12.5f, -0.3f, true};
  s.lights[4].emission.frames[0][0] = {1, 0.123456789f, 1e-7f};
  s.lights[4].emission.frames[1][7] = {-0.1f, 3, 2 / 3.0f};

  s.sphls.push_back({"west", node("SPHL 1", -1), 0.07f, true});
  s.sphls.push_back({"SPHL 2", node("SPHL 2", -1), 0.1f, false});
  node("SPHL that is none", -1);

  s.animations.resize(1);
  s.animations[0].name = "swing";
  s.animations[0].channels = {
      {moving, AnimationPath::translation, Interpolation::linear, {0, 0.3f}, {vec4(0), vec4(1, 2, 3, 0)}},
      {moving, AnimationPath::rotation, Interpolation::step, {0.1f, 1}, {{0, 0, 0, 1}, {0, 1, 0, 0}}},
      {moving,
       AnimationPath::scale,
       Interpolation::cubic_spline,
       {0, 1},
       {vec4(0), {1, 1, 1, 0}, vec4(0), vec4(0), {2, 2, 2, 0}, vec4(0)}}};

  s.environment.emplace();
  s.environment->name = "dawn", s.environment->group = "outside";
  s.environment->color = {0.3f, 0.2f, 0.1f}, s.environment->rotation = 1.1f;
  s.environment->equirect = image::Image(4, 2);
  for (std::size_t i = 0; i < 24; ++i) s.environment->equirect.pixels[i] = 1 / (1 + static_cast<float>(i));
  return s;
}

TEST(GltfExport, FullSceneComesBackAsTheSameScene) {
  Scene scene = full_scene();
  ASSERT_TRUE(validate(scene).empty());
  const Scene again = round_trip(scene);
  EXPECT_EQ(scene_hash(again), scene_hash(scene));
  // What the hash leaves out.
  EXPECT_EQ(again.name, "full");
  EXPECT_EQ(again.materials[0].name, "all");
  EXPECT_EQ(again.textures[0].name, "texture");
  EXPECT_EQ(again.environment->name, "dawn");
  EXPECT_EQ(again.animations[0].name, "swing");
  ASSERT_EQ(again.nodes.size(), scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    EXPECT_EQ(again.nodes[i].name, scene.nodes[i].name);
    EXPECT_EQ(again.nodes[i].movable, scene.nodes[i].movable);
  }
  EXPECT_EQ(again.sphls.size(), 2u);
}

class BuiltinExport : public ::testing::TestWithParam<BuiltinScene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, BuiltinExport, ::testing::ValuesIn(builtin_scenes()), [](const auto& scene) {
  std::string name = scene.param.name;
  std::erase(name, '-');
  return name;
});

TEST_P(BuiltinExport, ComesBackAsTheSameScene) {
  const Scene scene = GetParam().make();
  const Scene again = round_trip(scene);
  EXPECT_EQ(scene_hash(again), scene_hash(scene));
  EXPECT_EQ(light_groups(again), light_groups(scene));
  EXPECT_EQ(triangle_count(again), triangle_count(scene));
}

TEST(GltfExport, SunAndSkyComeBackExactly) {
  Scene scene = make_builtin("cornell");
  add_sun_sky(scene, {.width = 32});
  EXPECT_EQ(scene_hash(round_trip(scene)), scene_hash(scene));
}

TEST(GltfExport, SameSceneGivesTheSameBytes) {
  EXPECT_EQ(export_glb(full_scene()), export_glb(full_scene()));
}

TEST(GltfExport, SharesMeshesAndTheirArrays) {
  Scene scene;
  scene.materials.resize(2);
  scene.meshes.push_back(make_box(vec3(0), vec3(1)));
  scene.nodes.resize(3);
  scene.instances = {{0, 0, 0, ""}, {0, 1, 0, ""}, {0, 2, 1, ""}};
  const json::Value json = json_chunk(export_glb(scene));
  EXPECT_EQ(json["meshes"].size(), 2u);     // one per material
  EXPECT_EQ(json["accessors"].size(), 4u);  // positions, normals, texture coordinates, indices: once
  EXPECT_EQ(json["nodes"][0]["mesh"], json["nodes"][1]["mesh"]);
}

TEST(GltfExport, MoreThanOneOfAKindAtANodeGoToNodesOfTheirOwn) {
  Scene scene;
  scene.nodes.resize(1);
  scene.nodes[0].name = "n";
  scene.nodes[0].local.translation = {1, 2, 3};
  scene.sphls = {{"a", 0, 0.1f, true}, {"b", 0, 0.2f, true}, {"c", -1, 0.3f, true}};
  scene.lights.resize(2);
  scene.lights[0].name = "l", scene.lights[1].name = "m";
  scene.lights[0].node = scene.lights[1].node = 0;
  const Scene again = round_trip(scene);
  ASSERT_EQ(again.sphls.size(), 3u);
  EXPECT_EQ(again.lights.size(), 2u);
  for (const ProbePlace& place : sphl_places(again)) {
    EXPECT_EQ(place.position, place.name == "c" ? vec3(0) : vec3(1, 2, 3)) << place.name;
  }
}

TEST(GltfExport, LeavesOutWhatGltfForbids) {
  // No empty arrays, and nothing for a mesh without triangles.
  Scene scene;
  scene.nodes.resize(1);
  scene.meshes.resize(1);
  scene.instances = {{0, 0, -1, ""}};
  const json::Value json = json_chunk(export_glb(scene));
  for (const char* key : {"meshes", "accessors", "buffers", "bufferViews", "images", "extensionsUsed"}) {
    EXPECT_FALSE(json.contains(key)) << key;
  }
  EXPECT_NO_THROW(load_gltf(export_glb(Scene{}), "empty.glb"));
}

TEST(GltfExport, ConesStayInTheRangeOfGltf) {
  Scene scene;
  scene.nodes.resize(1);
  scene.lights.resize(1);
  scene.lights[0].node = 0, scene.lights[0].type = LightType::spot;
  scene.lights[0].inner_cone = scene.lights[0].outer_cone = 3;
  const Scene again = round_trip(scene);
  EXPECT_FLOAT_EQ(again.lights[0].outer_cone, pi / 2);
  EXPECT_LT(again.lights[0].inner_cone, again.lights[0].outer_cone);
}

TEST(GltfExport, NumbersThatAreNotFiniteAreAnError) {
  Scene scene = full_scene();
  scene.lights[0].intensity = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(export_glb(scene), Error);
}

TEST(GltfExport, MaterialsThatNothingCanBeAreAnError) {
  const auto said = [](const std::function<void(scene::Material&)>& change) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].name = "clay";
    change(scene.materials[1]);
    return test::message_of([&] { export_glb(scene); });
  };
  EXPECT_EQ(said([](auto&) {}), "no error");
  EXPECT_EQ(said([](auto& m) { m.base_color = vec3(0, 1, 0), m.alpha = 0, m.diffuse_roughness = -1; }),
            "no error");
  EXPECT_EQ(said([](auto& m) { m.base_color = vec3(1, -1, 1); }),
            "material \"clay\": its base colour is -1, not from 0 to 1");
  EXPECT_EQ(said([](auto& m) { m.base_color = vec3(1, 1, 1.5f); }),
            "material \"clay\": its base colour is 1.5, not from 0 to 1");
  EXPECT_EQ(said([](auto& m) { m.emission = vec3(0, 0, -2); }),
            "material \"clay\": its emission is -2, not from 0 on");
  for (const auto member : {&scene::Material::alpha, &scene::Material::metallic, &scene::Material::specular,
                            &scene::Material::transmission, &scene::Material::specular_roughness}) {
    for (const float wrong : {-1.5f, 2.0f})
      EXPECT_TRUE(said([&](auto& m) { m.*member = wrong; }).starts_with("material \"clay\": its ")) << wrong;
  }
}

TEST(GltfExport, NamesThatAreNotUtf8DoNotStopIt) {
  Scene scene = full_scene();
  scene.nodes[0].name = "\xff\xfe";
  EXPECT_NO_THROW(load_gltf(export_glb(scene), "memory.glb"));
}

TEST(GltfExport, WritesTheFileOrSaysWhyNot) {
  const test::TempDir dir;
  write_glb(dir.path() / "scene.glb", full_scene());
  EXPECT_EQ(read_file(dir.path() / "scene.glb"), export_glb(full_scene()));
  EXPECT_THROW(write_glb(dir.path() / "none" / "scene.glb", full_scene()), Error);
}

}  // namespace
}  // namespace ssphh::scene_io
