// What the statements of an MTL library become, each with the others at their defaults.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/scene_io/obj.h>

#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl m\nf 1 2 3\n";

scene::Scene scene_with(const std::string& statements, const test::TempDir& folder) {
  write_file(folder / "m.mtl", "newmtl m\n" + statements);
  return load_obj("mtllib m.mtl\n" + triangle, folder / "m.obj");
}

scene::Material material_of(const std::string& statements) {
  const test::TempDir folder;
  return scene_with(statements, folder).materials.at(0);
}

TEST(MtlValues, AnEmptyMaterialIsAMatteGrey) {
  const scene::Material m = material_of("");
  EXPECT_EQ(m.base_color, vec3(0.8f));
  EXPECT_EQ(m.specular, 0);
  EXPECT_EQ(m.alpha, 1);
  EXPECT_EQ(m.alpha_mode, scene::AlphaMode::opaque);
  EXPECT_EQ(m.emission, vec3(0));
}

TEST(MtlValues, TexturesAreRelativeFileNamesAsWindowsOrUnixWritesThem) {
  std::vector<std::string> warnings;
  const LogSink before = set_log_sink([&](LogLevel, const std::string& line) { warnings.push_back(line); });
  const test::TempDir folder;
  std::filesystem::create_directory(folder / "sub");
  image::write_image(folder / "sub/a.png", image::Image(1, 1));
  EXPECT_EQ(scene_with("map_Kd sub\\a.png\n", folder).materials.at(0).base_color_texture.texture, 0);
  EXPECT_TRUE(warnings.empty());
  for (const char* name : {"C:\\a.png", "d:a.png", "/a.png"}) {
    warnings.clear();
    EXPECT_EQ(
        scene_with(std::string("map_Kd ") + name + "\n", folder).materials.at(0).base_color_texture.texture,
        -1);
    ASSERT_FALSE(warnings.empty()) << name;
    EXPECT_NE(warnings[0].find("is not a relative file name; it is left out"), std::string::npos)
        << warnings[0];
  }
  set_log_sink(before);
}

TEST(MtlValues, RefractionMakesABodyOfGlassAndAFilterAtGlassASheet) {
  for (const char* model : {"6", "7"}) {
    const scene::Material m = material_of(
        std::string("Kd 0 0 0\nKs 0.3 0.3 0.3\nTf 0.25 0.64 1\nNi 1.7\nd 0.1\nillum ") + model + "\n");
    EXPECT_EQ(m.transmission, 1) << model;
    EXPECT_GT(m.thickness, 0) << model;
    EXPECT_EQ(m.ior, 1.7f) << model;
    EXPECT_EQ(m.specular_roughness, 0) << model;
    EXPECT_EQ(m.metallic, 0) << model;
    EXPECT_EQ(m.alpha_mode, scene::AlphaMode::opaque) << model;
    EXPECT_NEAR(glm::distance(m.base_color, vec3(0.5f, 0.8f, 1)), 0, 1e-6f) << "twice is Tf; illum " << model;
  }
  EXPECT_EQ(material_of("illum 7\n").base_color, vec3(1));
  for (const char* model : {"4", "9"}) {
    const scene::Material sheet = material_of(std::string("Tf 0.25 0.5 1\nillum ") + model + "\n");
    EXPECT_EQ(sheet.transmission, 1) << model;
    EXPECT_EQ(sheet.thickness, 0) << model;
    EXPECT_EQ(sheet.base_color, vec3(0.25f, 0.5f, 1)) << model;
    EXPECT_EQ(material_of(std::string("illum ") + model + "\n").transmission, 0) << "without a filter";
    const scene::Material half_there = material_of(std::string("Tf 1 1 1\nd 0.5\nillum ") + model + "\n");
    EXPECT_EQ(half_there.transmission, 0) << "covers half";
    EXPECT_EQ(half_there.alpha, 0.5f);
  }
  EXPECT_EQ(material_of("Tf 0.5 0.5 0.5\nillum 2\n").transmission, 0);
}

TEST(MtlValues, TransparencyIsWhatCoverageLeaves) {
  const scene::Material m = material_of("Tr 0.375\n");
  EXPECT_EQ(m.alpha, 0.625f);
  EXPECT_EQ(m.alpha_mode, scene::AlphaMode::blend);
  EXPECT_EQ(material_of("Tr 0\n").alpha_mode, scene::AlphaMode::opaque);
}

TEST(MtlValues, ThePhysicallyBasedExtensionReplacesPhong) {
  const scene::Material m = material_of("Kd 0.1 0.2 0.3\nKs 0.9 0.9 0.9\nNs 50\nPr 0.3\nPm 0.7\nNi 1.8\n");
  EXPECT_EQ(m.base_color, vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.specular_roughness, 0.3f);
  EXPECT_EQ(m.metallic, 0.7f);
  EXPECT_EQ(m.ior, 1.8f);
  EXPECT_EQ(m.specular, 1);
  const scene::Material rough_metal = material_of("Pm 1\n"), smooth_plastic = material_of("Pr 0.2\nNi 1\n");
  EXPECT_EQ(rough_metal.specular_roughness, 1);
  EXPECT_EQ(smooth_plastic.metallic, 0);
  EXPECT_EQ(smooth_plastic.ior, 1.5f) << "1 is no surface at all";
}

TEST(MtlValues, IlluminationModelsBelowTwoHaveNoHighlightAndFromThreeOnMirror) {
  for (const char* model : {"0", "1"})
    EXPECT_EQ(material_of(std::string("Ks 0.5 0.5 0.5\nNs 9\nillum ") + model + "\n").specular, 0) << model;
  const scene::Material phong = material_of("Ks 0.5 0.5 0.5\nNs 9\nillum 2\n");
  EXPECT_EQ(phong.specular, 1);
  EXPECT_FLOAT_EQ(phong.specular_roughness, -std::pow(2.0f / 11, 0.25f));
  EXPECT_EQ(material_of("Ks 0.5 0.5 0.5\nNs 9\nillum 3\n").specular_roughness, 0);
}

// F0 = ((ior − 1)/(ior + 1))² is the mean of Ks; where Kd is at most a twentieth of Ks, it is a metal of that
// colour.
TEST(MtlValues, SpecularColourIsTheReflectanceAtNormalIncidence) {
  const scene::Material m = material_of("Kd 0.5 0.5 0.5\nKs 0.1 0.2 0.3\n");
  EXPECT_NEAR(std::pow((m.ior - 1) / (m.ior + 1), 2), 0.2f, 1e-6f);  // float rounding
  EXPECT_EQ(m.metallic, 0);
  EXPECT_EQ(material_of("Kd 0.0151 0 0\nKs 0.1 0.2 0.3\n").metallic, 0);
  const scene::Material metal = material_of("Kd 0.0149 0 0\nKs 0.1 0.2 0.3\n");
  EXPECT_EQ(metal.metallic, 1);
  EXPECT_EQ(metal.base_color, vec3(0.1f, 0.2f, 0.3f));
}

TEST(MtlValues, TexturesGoToTheirSlotsAndGlowWithoutKe) {
  const test::TempDir folder;
  int code = 0;
  for (const char* name : {"color.png", "glow.png", "bumps.png"}) {
    const auto v = static_cast<std::uint8_t>(++code);
    write_file(folder / name, image::encode_png(image::Rgba8{1, 1, {v, v, v, 255}}));
  }
  const scene::Scene scene =
      scene_with("map_Kd color.png\nmap_Ke -o 0.25 -s 2 glow.png\nnorm -bm 0.3 bumps.png\n", folder);
  const scene::Material& m = scene.materials.at(0);
  const auto texel = [&](const scene::TextureUse& use) {
    return int{scene.textures.at(static_cast<std::size_t>(use.texture)).rgba.at(0)};
  };
  EXPECT_EQ(texel(m.base_color_texture), 1);
  EXPECT_EQ(texel(m.emission_texture), 2);
  EXPECT_EQ(texel(m.normal_texture), 3);
  EXPECT_EQ(m.metallic_roughness_texture.texture, -1);
  EXPECT_EQ(m.emission, vec3(1));
  EXPECT_EQ(m.normal_scale, 0.3f);
  EXPECT_EQ(m.emission_texture.scale, vec2(2, 1)) << "of v: 1 unless given";
  EXPECT_EQ(m.emission_texture.offset, vec2(0.25f, 0)) << "1 − 1 − 0";
  EXPECT_EQ(m.emission_texture.wrap_u, scene::Wrap::repeat);
  EXPECT_EQ(scene_with("Ke 3 2 1\nmap_Ke glow.png\n", folder).materials.at(0).emission, vec3(3, 2, 1));
}

// A mask of another size than the colour: each texel takes the mask's at its place.
TEST(MtlValues, CoverageOfAnotherSizeIsStretchedOverTheColour) {
  const test::TempDir folder;
  image::Rgba8 color{4, 2, {}};
  for (int i = 0; i < 8; ++i) {
    for (const int v : {i, 2 * i, 3 * i, 255}) color.rgba.push_back(static_cast<std::uint8_t>(v));
  }
  write_file(folder / "color.png", image::encode_png(color));
  write_file(folder / "mask.png", image::encode_png(image::Rgba8{2, 1, {0, 0, 0, 50, 0, 0, 0, 90}}));
  const scene::Scene scene = scene_with("map_Kd color.png\nmap_d mask.png\n", folder);
  const auto used = static_cast<std::size_t>(scene.materials[0].base_color_texture.texture);
  const scene::Texture& texture = scene.textures.at(used);
  ASSERT_EQ(texture.width, 4);
  ASSERT_EQ(texture.height, 2);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(texture.rgba[4 * i + 1], 2 * i);
    EXPECT_EQ(texture.rgba[4 * i + 3], i % 4 < 2 ? 50 : 90) << i;
  }
}

}  // namespace
}  // namespace ssphh::scene_io
