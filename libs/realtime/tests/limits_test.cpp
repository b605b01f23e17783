/// Where OpenGL's memory and numbers end: what halves hold, what a pass may take, what things are counted to
/// take.

#include <numeric>
#include <set>

#include <epoxy/gl.h>
#include <glm/gtc/packing.hpp>
#include <gmock/gmock.h>

#include <ssphh/scene/primitives.h>

#include "depth_bounds.h"
#include "fitted_light.h"
#include "shader_table.h"
#include "shaders.h"
#include "straight_view.h"
#include "tile_atlas.h"
#include "virtual_light_maps.h"

namespace ssphh::realtime {
namespace {

using Limits = test::WithGl;

TEST_F(Limits, TilesAreCountedByTheBytesOfTheirHalves) {
  // 5 tiles of 10 + 2 texels: four columns and two rows, of four halves
  EXPECT_EQ(TileAtlas(10, 5).bytes(), std::size_t{4 * 2} * 12 * 12 * 8);
  EXPECT_EQ(TileAtlas().bytes(), 0u);
}

// Squares of 2, 4, 8, … texels, until one holds the map; 4096 texels are a layer.
TEST_F(Limits, DepthBoundsAreHalvedToOneSquareAMap) {
  for (const auto& [size, levels] : {std::pair(1, 1), std::pair(2, 1), std::pair(3, 2), std::pair(4, 2),
                                     std::pair(5, 3), std::pair(96, 7), std::pair(128, 7), std::pair(129, 8)})
    EXPECT_EQ(DepthBounds(size, 1).levels(), levels) << size;
  const DepthBounds four(4, 3);  // of 2 × 2 squares, 2 columns and rows
  EXPECT_EQ(four.layout().columns(), 2);
  EXPECT_EQ(four.layout().rows, 2);
  EXPECT_EQ(four.bytes(), 4u * 4 * 8 * 4 / 3);
  const DepthBounds large(2000, 9);
  EXPECT_EQ(large.layout().columns(), 2);
  EXPECT_EQ(large.layout().layers, 3);
}

TEST_F(Limits, ProbesTakeTheirMapsTilesAndLists) {
  const scene::Scene scene = coloured(scene::make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
  Renderer renderer(gl(), scene, {.probe_map_bytes = std::size_t{1} << 20});
  const auto bytes = [&](int count) {
    MadeUpProbes probes;
    for (int i = 0; i < count; ++i) probes.add({0.3f * static_cast<float>(i), 0, 1});
    renderer.set_probes(probes.set);
    return renderer.memory_bytes();
  };
  renderer.clear_probes();
  const std::size_t none = renderer.memory_bytes();
  // Without probes one tile each of irradiance and radiance, a face of a map, a texel of a list. Of three:
  // faces of 128 texels are 18 * 64 KiB, more than the megabyte; of 64, 8 columns and 3 rows; tiles 2 columns
  // and rows; 20 * 20 * 10 cells of three
  const std::size_t least = 26 * 26 * 8 + 32 * 32 * 8 + 32 * 32 * 4 + 16;
  EXPECT_EQ(bytes(3) - none + least,
            8u * 3 * 64 * 64 * 4 + 2 * 2 * 26 * 26 * 8 + 32 * 32 * 8 + std::size_t{6 * 2048} * 16);
  // Of two, 12 faces of 128 texels are 768 KiB: 4 columns and 3 rows
  EXPECT_EQ(bytes(2) - none + least,
            4u * 3 * 128 * 128 * 4 + 2 * 1 * 26 * 26 * 8 + 32 * 32 * 8 + std::size_t{4 * 2048} * 16);
}

TEST_F(Limits, FittedPointsBrighterThanHalvesShineAsBrightAsHalvesDo) {
  const scene::Scene scene = coloured(scene::make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
  probes::FittedPoints fitted;
  for (int i = 0; i < 4; ++i) {
    fitted.points.push_back(
        {{static_cast<float>(i % 2) - 0.5f, static_cast<float>(i / 2) - 0.5f, 0}, {0, 0, 1}});
    fitted.weights.emplace_back().add(0, 1);
  }
  FrameCounters counters;
  const probes::FittedSurfaces surfaces = probes::prepare_fitted(scene, 0, fitted, everything_sees);
  SurfaceLight light(surfaces.surfaces, counters);
  FittedLight points(surfaces, 1);
  const std::array<vec3, 9> irradiance = {vec3(1e6f), vec3(-1e6f)};
  points.update(std::array{0}, irradiance, irradiance.size(), light, counters);
  const std::uint64_t before = counters.bytes_uploaded;
  points.update(std::array{0}, irradiance, irradiance.size(), light, counters);
  EXPECT_EQ(counters.bytes_uploaded - before, 4u * 64) << "each point once, whenever its probe changes";
  // 7bff and fbff are the halves of 65504 and of -65504
  std::array<std::uint32_t, 2048 * 4> texels{};
  GLint texture = 0;
  const gl::ShaderFiles files(shader_table());
  Shaders shaders(files);
  light.bind(shaders.indirect(IndirectLookup::surface, false, IndirectOutput::radiance));
  glGetIntegeri_v(GL_TEXTURE_BINDING_2D, unit::fitted_light, &texture);
  glGetTextureImage(static_cast<GLuint>(texture), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, sizeof(texels),
                    texels.data());
  for (std::size_t point = 0; point < 4; ++point) {
    for (const std::size_t colour : {0u, 5u, 10u})
      EXPECT_EQ(texels[16 * point + colour], 0xfbff7bffu) << point;
  }
}

// 512 points lie in a row of the texture; those beside each other are uploaded together.
TEST_F(Limits, LightOfSomePointsLeavesThatOfTheOthers) {
  constexpr std::size_t count = 1200, rows = 3;
  FrameCounters counters;
  probes::SurfaceLists lists;
  lists.points.resize(count);
  SurfaceLight light(lists, counters);
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  const auto give = [&](const std::vector<std::uint32_t>& points, float scale) {
    const std::uint64_t before = counters.bytes_uploaded;
    light.update(
        points,
        [&](std::uint32_t point) {
          SurfaceLight::Coefficients same;
          same.fill(vec3(scale * static_cast<float>(point)));
          return same;
        },
        counters);
    EXPECT_EQ(counters.bytes_uploaded - before, points.size() * 64);
  };
  give(all, 1);
  const std::vector<std::uint32_t> some = {0, 1, 2, 7, 9, 10, 510, 511, 512, 513, 1023, 1025, 1199};
  give(some, -1);
  const gl::ShaderFiles files(shader_table());
  Shaders shaders(files);
  light.bind(shaders.indirect(IndirectLookup::surface, false, IndirectOutput::radiance));
  GLint texture = 0;
  glGetIntegeri_v(GL_TEXTURE_BINDING_2D, unit::fitted_light, &texture);
  std::vector<glm::uvec4> texels(rows * 2048);
  glGetTextureImage(static_cast<GLuint>(texture), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                    static_cast<GLsizei>(texels.size() * sizeof(texels[0])), texels.data());
  for (const std::uint32_t point : all) {
    const float sign = std::ranges::binary_search(some, point) ? -1 : 1;
    const vec2 two = glm::unpackHalf2x16(texels[std::size_t{4} * point].x);
    EXPECT_EQ(two, vec2(sign * static_cast<float>(point))) << point;
  }
}

TEST_F(Limits, EveryVariantOfAShaderIsAProgramOfItsOwn) {
  const gl::ShaderFiles files(shader_table());
  Shaders shaders(files);
  std::set<const gl::Program*> programs;
  std::size_t asked = 0;
  const auto ask = [&](const gl::Program& program) { programs.insert(&program), ++asked; };
  const auto ask_all = [&] {
    for (const bool on : {false, true}) {
      for (int textures = 0; textures < 16; ++textures) ask(shaders.geometry(textures, on));
      ask(shaders.shadow(on)), ask(shaders.depth_bounds(on)), ask(shaders.agree(on));
      ask(shaders.interpolate(on));
      for (int k = 0; k < emitter_kinds; ++k)
        for (const bool shadow_view : {false, true})
          for (const bool glass : {false, true})
            ask(shaders.direct(static_cast<EmitterKind>(k), on, shadow_view, glass));
      ask(shaders.mirrored_environment(on));
      for (int output = 0; output < indirect_outputs; ++output) {
        const auto o = static_cast<IndirectOutput>(output);
        for (int k = 0; k < indirect_lookups; ++k)
          ask(shaders.indirect(static_cast<IndirectLookup>(k), on, o));
        if (o == IndirectOutput::chosen) continue;
        for (int k = 0; k < method_kinds; ++k) ask(shaders.method(static_cast<MethodKind>(k), on, o));
      }
    }
    for (const EmitterKind kind : {EmitterKind::disc, EmitterKind::sphere, EmitterKind::environment})
      ask(shaders.seen(kind));
    ask(shaders.mark()), ask(shaders.occlusion()), ask(shaders.view()), ask(shaders.resolve());
    ask(shaders.display()), ask(shaders.glass_shadow());
  };
  ask_all();
  EXPECT_EQ(programs.size(), asked);
  asked = 0;
  ask_all();
  EXPECT_EQ(programs.size(), asked) << "each is compiled once";
}

TEST_F(Limits, APassTakes256VirtualLights) {
  std::vector<methods::vpl::Vpl> all;
  FrameCounters counters;
  for (const auto& [lights, passes] : {std::pair(0, 0), std::pair(1, 1), std::pair(256, 1), std::pair(257, 2),
                                       std::pair(512, 2), std::pair(513, 3)}) {
    all.assign(static_cast<std::size_t>(lights), {vec3(0), vec3(0, 1, 0), vec3(1), 0});
    const VirtualLightMaps maps({all, {}}, std::size_t{64} << 20, {vec3(-1), vec3(1)}, counters);
    EXPECT_EQ(maps.passes(), passes) << lights;
  }
}

TEST(CubeNear, IsATwoThousandthOfTheScenesRadiusAndACentimetreInWideOnes) {
  const scene::Bounds bounds{vec3(-2, -1, -2), vec3(2, 1, 2)};  // 3 to a corner
  EXPECT_FLOAT_EQ(cube_near(bounds), 0.0015f);
  EXPECT_EQ(cube_near({vec3(-200), vec3(200)}), 0.01f) << "what hangs a hand below a lamp of a street";
  EXPECT_FLOAT_EQ(cube_near({vec3(-1e4f), vec3(1e4f)}), 1e-5f * std::sqrt(3e8f));
  EXPECT_EQ(cube_near({vec3(1), vec3(1)}), 1e-6f) << "of a point";
}

}  // namespace
}  // namespace ssphh::realtime
