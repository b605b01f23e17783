#include <cmath>
#include <limits>
#include <span>

#include <gmock/gmock.h>

#include <ssphh/core/random.h>
#include <ssphh/lightmap/encode.h>
#include <ssphh/lightmap/lit_scene.h>

#include "error_message.h"
#include "rooms.h"

namespace ssphh::lightmap {
namespace {

TEST(LitScene, EachInstanceHasAMeshOfItsOwnWithEveryTriangleAtItsPlace) {
  scene::Scene scene = scene_of({scene::make_sphere(1, 12, 6)});
  scene.nodes.emplace_back();
  scene.instances.push_back({0, 1, -1, "group"});
  scene.nodes.emplace_back().movable = true;
  scene.instances.push_back({0, 2, -1, ""});
  scene.meshes[0].uvs[1] = scene.meshes[0].uvs[0];  // overlapping at the poles or not, not used
  const Unwrapped u(scene, {.size = 128}, {.uvs = UvChoice::own});
  const scene::Scene lit = with_lightmap(scene, u.charts.charts, u.layout);
  scene::check_indices(lit);
  ASSERT_EQ(lit.meshes.size(), 3u);
  EXPECT_NE(lit.instances[0].mesh, lit.instances[1].mesh);
  EXPECT_EQ(lit.instances[1].light_group, "group");
  EXPECT_TRUE(lit.meshes[lit.instances[2].mesh].uvs[1].empty());

  for (int i = 0; i < 2; ++i) {
    const scene::Mesh& mesh = lit.meshes[lit.instances[i].mesh];
    ASSERT_EQ(mesh.triangles.size(), scene.meshes[0].triangles.size());
    ASSERT_EQ(mesh.uvs[1].size(), mesh.positions.size());
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uvs[0].size(), mesh.positions.size());
    // Texture coordinates lead to texels whose place is the vertex.
    const image::Image atlas = u.atlas([](const rays::SurfacePoint& at) { return at.position + 10.0f; });
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const vec3 found = sample(atlas, mesh.uvs[1][v]);
      EXPECT_LT(glm::length(found - mesh.positions[v] - 10.0f), 1.5f / u.layout.density);
    }
  }
}

TEST(LitScene, TexturesThatTookTheSecondCoordinatesTakeTheFirst) {
  scene::Mesh mesh = scene::make_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.uvs[1] = {{0, 0}, {2, 0}, {2, 3}, {0, 3}};
  scene::Scene scene = scene_of({mesh});
  scene.textures.push_back({"t", 1, 1, {1, 2, 3, 4}});
  scene.materials.resize(1);
  scene.materials[0].base_color_texture = {.texture = 0, .uv_set = 1};
  scene.instances[0].material = 0;
  const Unwrapped u(scene, {.size = 64});
  const scene::Scene lit = with_lightmap(scene, u.charts.charts, u.layout);
  const scene::Instance& instance = lit.instances[0];
  EXPECT_EQ(lit.materials[instance.material].base_color_texture.uv_set, 0);
  EXPECT_EQ(scene.materials[0].base_color_texture.uv_set, 1);
  const scene::Mesh& made = lit.meshes[instance.mesh];
  for (std::size_t v = 0; v < made.positions.size(); ++v) {
    EXPECT_EQ(made.uvs[0][v], vec2(made.positions[v]) * vec2(2, 3));
    EXPECT_TRUE(glm::all(glm::lessThan(made.uvs[1][v], vec2(1))));
  }
}

TEST(LitScene, WhatDoesNotBelongTogetherIsRefused) {
  const Unwrapped u(scene_of({scene::make_box(vec3(0), vec3(1))}), {.size = 64});
  const std::span<const Chart> fewer = std::span(u.charts.charts).first(3);
  const scene::Scene empty;
  using test::message_of;
  EXPECT_EQ(message_of([&] { with_lightmap(u.scene, fewer, u.layout); }),
            "lightmap scene: the layout is of other charts");
  EXPECT_EQ(message_of([&] { with_lightmap(empty, u.charts.charts, u.layout); }),
            "lightmap scene: the charts are of another scene");
  EXPECT_EQ(message_of([&] { make_texels(u.scene, 0, fewer, u.layout); }),
            "lightmap texels: the layout is of other charts");
  EXPECT_EQ(message_of([&] { make_texels(empty, 0, u.charts.charts, u.layout); }),
            "lightmap texels: the charts are of another scene");
  EXPECT_EQ(
      message_of([&] { light_texels(u.texels, {}, [](const rays::SurfacePoint&) { return vec3(1); }); }),
      "lightmap: the places are of other texels");
  Texels outside = u.texels;
  outside.places[0].first.x = gutter - 1;
  const Places places = find_places(u.texels, rays::PosedWorld(open_space, 0));
  EXPECT_EQ(
      message_of([&] { light_texels(outside, places, [](const rays::SurfacePoint&) { return vec3(1); }); }),
      "lightmap texels: a chart lies outside of the atlas");
}

TEST(Rgbm, ValuesComeBackWithin) {
  image::Image picture(64, 64);
  Pcg32 random(3);
  for (float& value : picture.pixels) value = std::exp(12 * random.uniform() - 8);
  picture.pixels[0] = -1, picture.pixels[1] = 0, picture.pixels[2] = 64;
  const Rgbm rgbm = encode_rgbm(picture);
  EXPECT_EQ(rgbm.scale, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const vec3 truth = glm::max(picture.rgb(x, y), vec3(0)), found = decode_rgbm(rgbm, x, y);
      const float within = std::max(max_component(truth), 0.001f) / 127;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], truth[c], within);
    }
  }
}

TEST(Rgbm, BrightLightIsScaled) {
  image::Image picture(2, 1);
  picture.set_rgb(0, 0, {6400, 64, 0}), picture.set_rgb(1, 0, {1, 1, 1});
  const Rgbm rgbm = encode_rgbm(picture);
  EXPECT_EQ(rgbm.scale, 100);
  EXPECT_NEAR(decode_rgbm(rgbm, 0, 0).x, 6400, 51);
  EXPECT_NEAR(decode_rgbm(rgbm, 1, 0).x, 1, 0.008f);
  picture.pixels[0] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(test::message_of([&] { encode_rgbm(picture); }), "RGBM: a value is not finite");
  EXPECT_EQ(test::message_of([&] { encode_rgbm(image::Image(1, 1, 4)); }),
            "RGBM: an image of three channels is needed");
}

}  // namespace
}  // namespace ssphh::lightmap
