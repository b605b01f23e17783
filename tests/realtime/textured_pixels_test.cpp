/// Textured surfaces under a lamp and between probes: what OpenGL draws against the path tracer, whole chains
/// of textures, normal maps, masks and light at once. tests/realtime/surface_pixels_test.cpp holds the parts.

#include <gmock/gmock.h>

#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

constexpr PictureSize texture_size{48, 32};

/// Texels of few, strong colours, none beside one of its own.
scene::Texture strong_colours(std::uint8_t (*alpha)(int x, int y)) {
  constexpr std::uint8_t colours[6][3] = {{250, 40, 30},  {30, 220, 50},  {40, 60, 240},
                                          {240, 230, 40}, {220, 40, 230}, {40, 230, 220}};
  scene::Texture texture;
  texture.name = "colours", texture.width = 4, texture.height = 3;
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      for (const std::uint8_t v : colours[(x + 2 * y) % 6]) texture.rgba.push_back(v);
      texture.rgba.push_back(alpha(x, y));
    }
  }
  return texture;
}

/// Normals that lean by up to half a right angle, to one side more than to the other.
scene::Texture waves() {
  scene::Texture texture;
  texture.name = "waves", texture.width = 3, texture.height = 5;
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      const int right = 128 + 50 * (x - 1), up = 128 + 35 * (y % 3 - 1) + 10 * (y / 3);
      for (const int v : {right, up, 215, 255}) texture.rgba.push_back(static_cast<std::uint8_t>(v));
    }
  }
  return texture;
}

/// A slanted sheet, larger than the picture, under a lamp beside the eye. Its coordinates are sheared.
scene::Scene textured_sheet() {
  scene::Scene s;
  s.materials = {matte(vec3(1))};
  scene::Mesh mesh = scene::make_quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
  mesh.uvs[0] = {{-1.1f, 1.7f}, {1.9f, 2.1f}, {2.2f, -0.9f}, {-0.8f, -1.3f}};
  add_mesh(s, mesh, 0);
  s.nodes[0].local.rotation = glm::angleAxis(0.5f, glm::normalize(vec3(1, 2, 0.5f)));
  s.nodes.emplace_back().local.translation = {0.1f, -0.2f, 3};
  s.cameras.emplace_back().node = 1;
  s.nodes.emplace_back().local.translation = {-1.2f, 1.4f, 2.5f};
  scene::Light& lamp = s.lights.emplace_back();
  lamp.node = 2, lamp.intensity = 25, lamp.color = {1, 0.8f, 0.6f};
  return s;
}

class TexturedPixels : public WithGl {
 protected:
  /// Pictures whose lamp gives radiances up to about 1, and whose probes, if any, about 0.3. Where the traced
  /// picture changes by more than `edge` from pixel to pixel, its samples and the drawn ones may mix
  /// otherwise: anything between a pixel and those around it will do. At most `edges` of the picture are
  /// such. `filtered`: what 8 bits of a filter's weight may change a radiance by.
  void expect_traced(scene::Scene scene, const probes::ProbeSet* probes, float edge, double edges,
                     float filtered = 0.011f) {
    scene::validate(scene);
    const trace::PathTracer tracer(scene);
    probes::LookupParams params;
    params.weights.method = probes::WeightMethod::distance;
    const auto lookup =
        probes ? probes::make_lookup(probes::LookupMethod::irradiance, *probes, tracer, params) : nullptr;
    PictureSamples samples;
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
      samples.add(traced(scene, lookup.get(), texture_size, 8, seed, tracer));
    const image::Image truth = samples.mean();
    // Weights of filters have 8 bits along each axis: 2 / 256 of the texels' differences, of colours up to 1,
    // of normals up to 0.4, which a cosine may have in full: 0.011 of a radiance of 1. Tiles of probes, and
    // colours of 10 bits: 1 % (lookup_pixels_test.cpp)
    PictureBounds bounds = PictureBounds::around(truth, 0.01f, filtered);
    bounds.variance = samples.variance(), bounds.degrees = samples.degrees();
    const auto jumps = [&](int x, int y) {
      vec3 low(INFINITY), high(0);
      for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, texture_size.height - 1); ++ny) {
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, texture_size.width - 1); ++nx)
          low = glm::min(low, truth.rgb(nx, ny)), high = glm::max(high, truth.rgb(nx, ny));
      }
      return max_component(high - low) > edge;
    };
    EXPECT_LE(bounds.widen(jumps), edges);
    realtime::Renderer renderer(gl(), scene);
    if (probes) renderer.set_probes(*probes);
    realtime::FrameSettings settings;
    settings.weights = probes::WeightMethod::distance;
    const image::Image picture = drawn(renderer, scene, texture_size, settings);
    EXPECT_TRUE(picture_is(picture, bounds));
    EXPECT_GT(mean_luminance(truth), 0.1);
    EXPECT_LT(*std::ranges::max_element(truth.pixels), 1.5f);
  }
};

TEST_F(TexturedPixels, OfColoursAndNormalsTurnedAndUnevenlyScaledAreTheTracers) {
  scene::Scene s = textured_sheet();
  s.textures = {strong_colours([](int, int) -> std::uint8_t { return 255; }), waves()};
  s.materials[0].base_color_texture = {
      .texture = 0, .offset = {0.13f, -0.27f}, .scale = {0.9f, 0.5f}, .rotation = 0.6f};
  s.materials[0].normal_texture = {
      .texture = 1, .offset = {-0.2f, 0.1f}, .scale = {0.4f, 0.7f}, .rotation = -0.9f};
  s.materials[0].normal_scale = 0.8f;
  const probes::ProbeSet probes = smooth_probes({{-1.5f, 0.5f, 2}, {1.5f, -0.5f, 2.5f}, {0.2f, 1.5f, 1.8f}});
  expect_traced(std::move(s), &probes, INFINITY, 0);
}

// Texels that are all alike leave filters nothing to round: what the map's strength and the turn of its
// coordinates do is seen to 1 %. A tenth of the strength is up to 5 % of the light here.
TEST_F(TexturedPixels, OfAnEvenNormalMapAreTheTracersToAPercent) {
  scene::Scene s = textured_sheet();
  scene::Texture& lean = s.textures.emplace_back();
  lean.name = "lean", lean.width = lean.height = 2;
  for (int i = 0; i < 4; ++i) lean.rgba.insert(lean.rgba.end(), {80, 170, 215, 255});
  s.materials[0].base_color = {0.8f, 0.6f, 0.4f};
  for (const float scale : {0.8f, 0.3f, -0.5f}) {
    SCOPED_TRACE(testing::Message() << "scale " << scale);
    s.materials[0].normal_texture = {.texture = 0, .scale = {0.4f, 0.7f}, .rotation = -0.9f};
    s.materials[0].normal_scale = scale;
    expect_traced(s, nullptr, INFINITY, 0, 0.001f);
  }
}

TEST_F(TexturedPixels, OfAMaskAndOfWhatIsLitThroughItsHolesAreTheTracers) {
  scene::Scene s = textured_sheet();
  s.textures = {strong_colours([](int x, int y) -> std::uint8_t { return (x + y) % 3 == 0 ? 120 : 170; })};
  scene::Material& m = s.materials[0];
  m.alpha_mode = scene::AlphaMode::mask, m.alpha = 0.9f, m.alpha_cutoff = 0.5f;
  m.base_color_texture = {
      .texture = 0, .offset = {0.13f, -0.27f}, .scale = {0.4f, 0.25f}, .rotation = 0.6f, .nearest = true};
  s.materials.push_back(matte({0.9f, 0.5f, 0.2f}));
  add_mesh(s, scene::make_quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), 1, {0, 0, -1});
  expect_traced(std::move(s), nullptr, 0.05f, 0.6);
}

TEST_F(TexturedPixels, OfLeavesFromAfarHaveNothingOfTheWhiteAroundThem) {
  // Stripes of green, cut out of white that nobody sees, finer than pixels.
  scene::Scene s = textured_sheet();
  scene::Texture& leaf = s.textures.emplace_back();
  leaf.name = "leaf", leaf.width = leaf.height = 32;
  for (int i = 0; i < 32 * 32; ++i) {
    const std::array<int, 4> texel = i % 4 == 0 ? std::array{255, 255, 255, 0} : std::array{20, 160, 30, 255};
    for (const int v : texel) leaf.rgba.push_back(static_cast<std::uint8_t>(v));
  }
  scene::Material& m = s.materials[0];
  m.alpha_mode = scene::AlphaMode::mask, m.alpha_cutoff = 0.5f;
  m.base_color_texture = {.texture = 0, .scale = vec2(9)};
  realtime::Renderer renderer(gl(), s);
  const image::Image picture = drawn(renderer, s, texture_size, {});
  int leaves = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const vec3 c = picture.rgb(x, y);
      if (c.g < 0.01f) continue;
      ++leaves;
      EXPECT_LT(std::max(c.r, c.b), 0.1f * c.g) << x << ' ' << y;
    }
  }
  EXPECT_GT(leaves, texture_size.width * texture_size.height / 2);
}

}  // namespace
}  // namespace ssphh::test
