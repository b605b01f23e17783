// Numbers that the exporters compute themselves: of surfaces, and of the texels they write.

#include <gtest/gtest.h>

#include <ssphh/image/io.h>
#include <ssphh/image/transfer.h>

#include "export/surface_model.h"
#include "export_fixture.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

using scene_io::TextureFiles;

/// One texel (R, G, B, A) = (200, 100, 50, 102).
scene::Scene scene_of_a_texel() {
  scene::Scene scene;
  scene.textures.push_back({"t", 1, 1, {200, 100, 50, 102}});
  return scene;
}

TEST(ExportSurfaces, LobesHaveTheWidthAndReflectanceThatTheyHaveHere) {
  EXPECT_FLOAT_EQ(scene_io::roughness_alpha(0.5f), 0.25f);
  EXPECT_FLOAT_EQ(scene_io::roughness_alpha(-0.7f), 0.49f);
  EXPECT_FLOAT_EQ(scene_io::roughness_alpha(0.01f), 1e-3f);
  scene::Material m;
  m.ior = 1.8f, m.specular = 0.5f;
  EXPECT_FLOAT_EQ(scene_io::normal_reflectance(m), 0.5f * (0.8f * 0.8f) / (2.8f * 2.8f));
  EXPECT_FLOAT_EQ(scene_io::ior_of(0.04f), 1.5f);
  EXPECT_FLOAT_EQ(scene_io::ior_of(0.25f), 3);
}

TEST(ExportSurfaces, ColoursOfTexelsAreDecodedAndTimesTheirFactor) {
  const TempDir dir;
  const scene::Scene scene = scene_of_a_texel();
  TextureFiles files(scene, dir.path());
  const vec3 factor(0.5f, 2, 3), color = image::read_image(dir / files.linear_color(0, factor)).rgb(0, 0);
  const int codes[] = {200, 100, 50};
  for (int c = 0; c < 3; ++c)
    EXPECT_FLOAT_EQ(color[c], factor[c] * image::srgb8_to_linear(static_cast<std::uint8_t>(codes[c])));
  const std::string plain = files.color(0, vec3(1)), scaled = files.color(0, factor);
  EXPECT_NE(plain, scaled);
  EXPECT_EQ(files.color(0, vec3(1)), plain) << "written once";
}

TEST(ExportSurfaces, CoverageIsTheTexelsTimesAlphaAndMasksCutAtTheCutoff) {
  const auto value = [](scene::AlphaMode mode, float alpha, float cutoff, bool textured) {
    const TempDir dir;
    const scene::Scene scene = scene_of_a_texel();
    TextureFiles files(scene, dir.path());
    scene::Material m;
    m.alpha_mode = mode, m.alpha = alpha, m.alpha_cutoff = cutoff;
    if (textured) m.base_color_texture.texture = 0;
    const scene_io::Coverage cover = scene_io::coverage(scene, m, files);
    return cover.file.empty() ? cover.value : image::read_image(dir / cover.file).rgb(0, 0).x;
  };
  using scene::AlphaMode;
  EXPECT_EQ(value(AlphaMode::opaque, 0.3f, 0.5f, true), 1);
  EXPECT_EQ(value(AlphaMode::blend, 0.3f, 0.5f, false), 0.3f);
  EXPECT_FLOAT_EQ(value(AlphaMode::blend, 0.5f, 0.5f, true), 0.2f) << "102 / 255 / 2";
  EXPECT_EQ(value(AlphaMode::mask, 0.5f, 0.5f, false), 1) << "the cutoff itself is there";
  EXPECT_EQ(value(AlphaMode::mask, 0.49f, 0.5f, false), 0);
  EXPECT_EQ(value(AlphaMode::mask, 0.5f, 0.19f, true), 1);
  EXPECT_EQ(value(AlphaMode::mask, 0.5f, 0.21f, true), 0);
}

/// First texels of the float textures that a renderer gets of a surface with metallic 0.8, roughness 0.6 and
/// a texture whose green is 100 and blue is 50.
std::vector<float> written_channels(scene_io::ExportReport (*write)(const scene::Scene&,
                                                                    const scene_io::ExportSettings&,
                                                                    const std::filesystem::path&)) {
  const TempDir dir;
  scene::Scene scene = scene_of_a_texel();
  scene.materials.resize(1);
  scene.materials[0].metallic = 0.8f, scene.materials[0].specular_roughness = 0.6f;
  scene.materials[0].metallic_roughness_texture.texture = 0;
  scene.meshes.resize(1);
  scene.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.meshes[0].triangles = {{0, 1, 2}};
  scene.meshes[0].material = 0;
  scene.nodes.resize(1);
  scene.instances = {{0, 0, -1, ""}};
  std::vector<float> values;
  for (const auto& file : write(scene, export_settings(), dir.path()).files) {
    if (file.extension() == ".exr") values.push_back(image::read_image(file).rgb(0, 0).x);
  }
  std::sort(values.begin(), values.end());
  return values;
}

TEST(ExportSurfaces, RoughnessAndMetalOfTexelsAreTimesTheirFactors) {
  const float green = 100 / 255.0f, metal = 0.8f * 50 / 255, rough = 0.6f * green;
  const std::vector<float> mitsuba = written_channels(scene_io::export_mitsuba);
  ASSERT_EQ(mitsuba.size(), 2u);
  EXPECT_FLOAT_EQ(mitsuba[0], metal);
  EXPECT_FLOAT_EQ(mitsuba[1], rough);
  const std::vector<float> pbrt = written_channels(scene_io::export_pbrt);
  ASSERT_EQ(pbrt.size(), 2u);
  EXPECT_FLOAT_EQ(pbrt[0], rough * rough) << "alpha";
  EXPECT_FLOAT_EQ(pbrt[1], metal);
}

}  // namespace
}  // namespace ssphh::test
