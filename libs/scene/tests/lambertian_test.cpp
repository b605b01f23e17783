#include <gtest/gtest.h>

#include <ssphh/scene/lambertian.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {
namespace {

TEST(Lambertian, KeepsColourCoverageAndEmissionAlone) {
  Scene scene;
  scene.textures.resize(1);
  Material& m = scene.materials.emplace_back();
  m.base_color = vec3(0.9f, 0.7f, 0.2f), m.metallic = 0.6f, m.diffuse_roughness = -0.5f;
  m.alpha_mode = AlphaMode::mask, m.alpha = 0.4f, m.emission = vec3(3);
  m.base_color_texture.texture = m.metallic_roughness_texture.texture = m.normal_texture.texture = 0;
  scene.meshes.resize(3);
  scene.meshes[0].material = 0;

  const Scene plain = lambertian(scene);
  EXPECT_EQ(plain.meshes[0].material, 0);
  const Material& n = plain.materials[0];
  EXPECT_EQ(n.metallic, 0);
  EXPECT_EQ(n.specular, 0);
  EXPECT_EQ(n.diffuse_roughness, 0);
  EXPECT_EQ(n.metallic_roughness_texture.texture, -1);
  EXPECT_EQ(n.normal_texture.texture, -1);
  EXPECT_EQ(n.base_color, m.base_color);
  EXPECT_EQ(n.base_color_texture.texture, 0);
  EXPECT_EQ(n.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(n.alpha, 0.4f);
  EXPECT_EQ(n.emission, m.emission);
}

// Index −1 means a material with a specular lobe.
TEST(Lambertian, GivesMeshesWithoutMaterialOne) {
  Scene scene;
  scene.meshes.resize(2);
  const Scene plain = lambertian(scene);
  ASSERT_EQ(plain.materials.size(), 1u);
  EXPECT_EQ(plain.meshes[0].material, 0);
  EXPECT_EQ(plain.meshes[1].material, 0);
  EXPECT_EQ(plain.materials[0].specular, 0);
  EXPECT_EQ(plain.materials[0].base_color, Material{}.base_color);
}

}  // namespace
}  // namespace ssphh::scene
