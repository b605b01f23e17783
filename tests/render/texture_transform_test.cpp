// KHR_texture_transform from the file to the texel, for every slot of a material.

#include <cmath>
#include <complex>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/shading/surface.h>

#include "temp_dir.h"

namespace ssphh {
namespace {

constexpr int texels_across = 64;

struct Slot {
  const char* name;
  scene::TextureUse scene::Material::*use;
  glm::dvec2 offset, scale;
  double rotation;
  int uv_set;
};

// No two of their numbers are equal, and no scale is even.
const Slot slots[] = {
    {"base colour", &scene::Material::base_color_texture, {0.13, -0.27}, {1.7, 0.6}, 0.4, 0},
    {"metallic and roughness",
     &scene::Material::metallic_roughness_texture,
     {-0.31, 0.22},
     {0.7, 2.3},
     1.1,
     1},
    {"emission", &scene::Material::emission_texture, {0.41, 0.36}, {-1.3, 0.9}, -0.7, 1},
    {"normal", &scene::Material::normal_texture, {-0.19, -0.44}, {2.1, -0.8}, 2.5, 0},
};

/// Where the extension sends a coordinate: scaled, then turned counter-clockwise as seen on the image, whose
/// v points down, then moved.
glm::dvec2 place(const Slot& slot, const glm::dvec2& uv) {
  const std::complex<double> scaled(slot.scale.x * uv.x, -slot.scale.y * uv.y);
  const std::complex<double> turned = scaled * std::polar(1.0, slot.rotation);
  return {slot.offset.x + turned.real(), slot.offset.y - turned.imag()};
}

std::string texture_info(const Slot& slot) {
  // The extension's set replaces the texture's own.
  return fmt::format(
      "{{\"index\":0,\"texCoord\":{},\"extensions\":{{\"KHR_texture_transform\":{{\"offset\":[{},{}],"
      "\"scale\":[{},{}],\"rotation\":{},\"texCoord\":{}}}}}}}",
      1 - slot.uv_set, slot.offset.x, slot.offset.y, slot.scale.x, slot.scale.y, slot.rotation, slot.uv_set);
}

/// One material with all slots; red of its texture is the column, green the row.
scene::Scene scene_with_transforms(const test::TempDir& folder) {
  image::Rgba8 texels{texels_across, texels_across, {}};
  for (int y = 0; y < texels_across; ++y) {
    for (int x = 0; x < texels_across; ++x) {
      for (const int v : {x, y, 0, 255}) texels.rgba.push_back(static_cast<std::uint8_t>(v));
    }
  }
  write_file(folder / "places.png", image::encode_png(texels));
  write_file(
      folder / "scene.gltf",
      fmt::format("{{\"asset\":{{\"version\":\"2.0\"}},\"images\":[{{\"uri\":\"places.png\"}}],"
                  "\"samplers\":[{{\"magFilter\":9728}}],\"textures\":[{{\"source\":0,\"sampler\":0}}],"
                  "\"materials\":[{{\"pbrMetallicRoughness\":{{\"baseColorTexture\":{},"
                  "\"metallicRoughnessTexture\":{}}},\"emissiveTexture\":{},\"normalTexture\":{}}}]}}",
                  texture_info(slots[0]), texture_info(slots[1]), texture_info(slots[2]),
                  texture_info(slots[3])));
  return scene_io::load_scene((folder / "scene.gltf").string());
}

TEST(TextureTransform, EverySlotIsScaledThenTurnedThenMoved) {
  const test::TempDir folder;
  const scene::Scene scene = scene_with_transforms(folder);
  for (const Slot& slot : slots) {
    const scene::TextureUse& use = scene.materials.at(0).*slot.use;
    for (int i = 0; i < 60; ++i) {
      // Places of a Kronecker sequence in [−1, 2]², none within float rounding of a texel's edge
      const glm::dvec2 uv(3 * std::fmod(0.754878 * i, 1.0) - 1, 3 * std::fmod(0.569840 * i, 1.0) - 1);
      const vec2 other(0.3f, 0.7f);
      const vec2 sets[] = {slot.uv_set == 0 ? vec2(uv) : other, slot.uv_set == 1 ? vec2(uv) : other};
      const vec4 texel = shading::sample_texture(scene, use, {sets[0], sets[1]}, false);
      const glm::dvec2 expected = glm::floor(glm::fract(place(slot, uv)) * double{texels_across});
      EXPECT_EQ(glm::dvec2(std::round(texel.x * 255), std::round(texel.y * 255)), expected)
          << slot.name << " at " << uv.x << " " << uv.y;
      if (HasFailure()) break;
    }
  }
}

}  // namespace
}  // namespace ssphh
