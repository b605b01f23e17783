/// What tiles of probes hold, at every texel, against functions written down otherwise; without OpenGL.

#include "probe_tiles.h"

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/core/octahedral.h>
#include <ssphh/core/sphere.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/zonal.h>

#include "expect_near.h"

namespace ssphh::realtime {
namespace {

/// Calls visit(direction, texel) for every texel of a tile, its border too.
template <class Visit>
void for_texels(int size, std::span<const vec4> tile, const Visit& visit) {
  for (int row = 0; row < size + 2; ++row) {
    for (int column = 0; column < size + 2; ++column) {
      const vec2 place = (2.0f * vec2(column, row) - 1.0f) / static_cast<float>(size) - 1.0f;
      visit(octahedral_direction(place), vec3(tile[row * (size + 2) + column]));
    }
  }
}

/// L(ω) = a + b·ω, each colour along an axis of its own.
sh::RadianceSh ramp(int degree, const vec3& a, const vec3& b) {
  sh::RadianceSh light(degree);
  light[0] = a * std::sqrt(4 * pi);
  const float linear = std::sqrt(4 * pi / 3);
  light[3].x = b.x * linear;  // x
  light[1].y = b.y * linear;  // y
  light[2].z = b.z * linear;  // z
  return light;
}

TEST(ProbeTiles, OfARampHoldItsIrradiance) {
  const vec3 a(2, 3, 4), b(1, -2, 3);
  const IrradianceTiles tiles(2, true);
  std::vector<vec4> tile(tiles.texels());
  const sh::IrradianceSh e = tiles.make(ramp(3, a, b), tile);
  EXPECT_EQ(e.values.size(), 9u);
  for_texels(irradiance_tile, tile, [&](const vec3& n, const vec3& texel) {
    test::expect_near(texel, pi * a + 2 * pi / 3 * b * n, 1e-4f);
    test::expect_near(sh::eval(e, n), texel, 1e-4f);
  });
}

TEST(ProbeTiles, OfIrradianceKeepTheBandsOfTheirDegree) {
  const vec3 a(2, 3, 4);
  const IrradianceTiles tiles(0, false);
  ASSERT_EQ(tiles.count(), 1u);
  std::vector<vec4> tile(tiles.texels());
  tiles.make(ramp(3, a, vec3(1)), tile);
  for_texels(irradiance_tile, tile,
             [&](const vec3&, const vec3& texel) { test::expect_near(texel, pi * a, 1e-4f); });
}

// A function whose lower half takes light away: with a window it is nowhere negative, without it the tile is
// cut.
TEST(ProbeTiles, OfIrradianceAreWindowedOrCut) {
  const sh::RadianceSh light = ramp(2, vec3(1), vec3(3));
  for (const bool dering : {true, false}) {
    const IrradianceTiles tiles(2, dering);
    std::vector<vec4> tile(tiles.texels());
    const sh::IrradianceSh e = tiles.make(light, tile);
    float least = 1;
    for_texels(irradiance_tile, tile, [&](const vec3& n, const vec3& texel) {
      const vec3 value = sh::eval(e, n);
      least = std::min(least, std::min({value.x, value.y, value.z}));
      test::expect_near(texel, glm::max(value, vec3(0)), 1e-4f);
    });
    if (dering) {
      EXPECT_GT(least, -1e-3f);
    } else {
      EXPECT_LT(least, pi - 2 * pi + 0.1f);  // π a − 2 π/3 b, along an axis
    }
  }
}

TEST(ProbeTiles, OfRadianceAreItsBandsBlurredByEachRoughness) {
  constexpr auto levels = static_cast<int>(radiance_roughness.size());
  const vec3 a(2, 3, 4), b(1, -2, 3);
  const RadianceTiles tiles(3, levels);
  ASSERT_EQ(tiles.levels(), levels);
  std::vector<vec4> tile(tiles.texels());
  float narrower = 2;
  for (int level = 0; level < levels; ++level) {
    tiles.make(ramp(3, a, b), level, tile);
    const float share = sh::glossy_band_scale(radiance_roughness[level], 1);
    EXPECT_LT(share, narrower);
    narrower = share;
    for_texels(radiance_tile, tile, [&](const vec3& d, const vec3& texel) {
      test::expect_near(texel, glm::max(a + share * b * d, vec3(0)), 1e-4f);
    });
  }
}

}  // namespace
}  // namespace ssphh::realtime
