// Each convention is tested by evaluating the stored values with the target's own formula, written out here
// as that program has it, against this project's radiance or irradiance in the same direction.

#include <gtest/gtest.h>

#include <ssphh/sh/convert.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/rotate.h>

#include "known_vectors.h"
#include "random_sh.h"

namespace ssphh::sh {
namespace {

using test::largest_difference;
using Stored = std::vector<vec3>;

// Unreal's SHBasisFunction3 (also D3DXSHEvalDirection).
vec3 unreal_radiance(const Stored& sh, const vec3& d) {
  const float v[9] = {0.282095f,
                      -0.488603f * d.y,
                      0.488603f * d.z,
                      -0.488603f * d.x,
                      1.092548f * d.x * d.y,
                      -1.092548f * d.y * d.z,
                      0.315392f * (3 * d.z * d.z - 1),
                      -1.092548f * d.x * d.z,
                      0.546274f * (d.x * d.x - d.y * d.y)};
  vec3 sum(0);
  for (std::size_t k = 0; k < 9; ++k) sum += v[k] * sh[k];
  return sum;
}

// Unity's ShadeSH9 from the packed vectors unity_SHA*, unity_SHB*, unity_SHC: returns E/π.
vec3 unity_shade_sh9(const Stored& sh, const vec3& n) {
  vec3 result;
  for (int i = 0; i < 3; ++i) {
    const auto at = [&](std::size_t k) { return sh[k][i]; };
    const vec4 a(at(3), at(1), at(2), at(0) - at(6)), b(at(4), at(5), 3 * at(6), at(7));
    const float c = at(8);
    result[i] = glm::dot(a, vec4(n, 1)) + glm::dot(b, vec4(n.x * n.y, n.y * n.z, n.z * n.z, n.z * n.x)) +
                c * (n.x * n.x - n.y * n.y);
  }
  return result;
}

// three.js shGetIrradianceAt (Ramamoorthi & Hanrahan's polynomial): returns E.
vec3 three_irradiance(const Stored& sh, const vec3& n) {
  vec3 result = sh[0] * 0.886227f;
  result += sh[1] * 2.0f * 0.511664f * n.y + sh[2] * 2.0f * 0.511664f * n.z + sh[3] * 2.0f * 0.511664f * n.x;
  result += sh[4] * 2.0f * 0.429043f * n.x * n.y + sh[5] * 2.0f * 0.429043f * n.y * n.z;
  result += sh[6] * (0.743125f * n.z * n.z - 0.247708f);
  result += sh[7] * 2.0f * 0.429043f * n.x * n.z + sh[8] * 0.429043f * (n.x * n.x - n.y * n.y);
  return result;
}

// Godot's LightmapGI capture, exposure normalisation 1: returns E.
vec3 godot_irradiance(const Stored& sh, const vec3& n) {
  const float c[5] = {0.886227f, 1.023327f, 0.858086f, 0.247708f, 0.429043f};
  return c[0] * sh[0] + c[1] * (sh[1] * n.y + sh[2] * n.z + sh[3] * n.x) +
         c[2] * (sh[4] * (n.x * n.y) + sh[5] * (n.y * n.z) + sh[7] * (n.x * n.z)) +
         c[3] * sh[6] * (3 * n.z * n.z - 1) + c[4] * sh[8] * (n.x * n.x - n.y * n.y);
}

// Filament's Irradiance_SphericalHarmonics: returns E/π.
vec3 filament_diffuse(const Stored& sh, const vec3& n) {
  return sh[0] + sh[1] * n.y + sh[2] * n.z + sh[3] * n.x + sh[4] * (n.y * n.x) + sh[5] * (n.y * n.z) +
         sh[6] * (3.0f * n.z * n.z - 1.0f) + sh[7] * (n.z * n.x) + sh[8] * (n.x * n.x - n.y * n.y);
}

template <class Check>
void for_each_case(const Check& check) {
  for (const RadianceSh& probe : {test::grace_cathedral(), test::random_sh(2, 1), test::random_sh(2, 2)}) {
    for (int i = 0; i < 100; ++i) check(probe, spherical_fibonacci(i, 100));
  }
}

// The targets' constants have six digits.
constexpr float six_digits = 1e-5f;

TEST(Convert, UnrealReadsOurRadiance) {
  for_each_case([](const RadianceSh& probe, const vec3& d) {
    ASSERT_LT(largest_difference(unreal_radiance(to_convention(probe, Convention::d3dx), d), eval(probe, d)),
              six_digits);
  });
}

TEST(Convert, UnityReadsOurIrradianceOverPi) {
  for_each_case([](const RadianceSh& probe, const vec3& d) {
    ASSERT_LT(largest_difference(unity_shade_sh9(to_convention(probe, Convention::unity), d),
                                 irradiance(probe, d) / pi),
              six_digits);
  });
}

TEST(Convert, UnityScalesAreItsPublishedOnes) {
  const double scales[9] = {.282095, .325735, .325735, .325735, .273137, .273137, .0788479, .273137, .136569};
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(convention_factor(Convention::unity, k), scales[k], 1e-6);
}

TEST(Convert, ThreeAndGodotReadOurIrradiance) {
  for_each_case([](const RadianceSh& probe, const vec3& d) {
    const Stored stored = to_convention(probe, Convention::three);
    ASSERT_LT(largest_difference(three_irradiance(stored, d), irradiance(probe, d)), six_digits);
    ASSERT_LT(largest_difference(godot_irradiance(stored, d), irradiance(probe, d)), six_digits);
  });
}

TEST(Convert, FilamentReadsOurIrradianceOverPi) {
  for_each_case([](const RadianceSh& probe, const vec3& d) {
    const vec3 truth = irradiance(probe, d) / pi;
    ASSERT_LT(largest_difference(filament_diffuse(to_convention(probe, Convention::filament), d), truth),
              six_digits);
    const Stored mirrored = to_convention(probe, Convention::filament_mirrored);
    ASSERT_LT(largest_difference(filament_diffuse(mirrored, vec3(-d.x, d.y, d.z)), truth), six_digits);
  });
}

TEST(Convert, BackAndForthGivesTheSameRadiance) {
  for (const auto& [convention, name] : enum_names<Convention>) {
    const RadianceSh probe = test::random_sh(convention_max_degree(convention), 3);
    const RadianceSh back = from_convention(to_convention(probe, convention), convention);
    // Two roundings.
    EXPECT_LT(largest_difference(back, probe), 3e-7f) << name_of(convention);
  }
}

TEST(Convert, D3dxSignFollowsCondonAndShortleyInAllBands) {
  for (int l = 0; l <= max_degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      EXPECT_EQ(convention_factor(Convention::d3dx, coefficient_index(l, m)), m % 2 == 0 ? 1 : -1);
    }
  }
}

// The mirroring that the header advises for left-handed targets, by the rotation matrices.
TEST(Convert, MirroringFirstServesALeftHandedTarget) {
  glm::dmat3 mirror(1);
  mirror[2][2] = -1;
  const RadianceSh probe = test::random_sh(2, 5);
  const Stored stored = to_convention(Rotation(2, mirror).apply(probe), Convention::unity);
  const vec3 n = glm::normalize(vec3(1, 2, 3));
  EXPECT_LT(largest_difference(unity_shade_sh9(stored, vec3(n.x, n.y, -n.z)), irradiance(probe, n) / pi),
            six_digits);
}

TEST(Convert, DropsBandsThatTheTargetLacks) {
  EXPECT_EQ(to_convention(test::random_sh(10, 1), Convention::unity).size(), 9u);
  EXPECT_EQ(to_convention(test::random_sh(10, 1), Convention::d3dx).size(), 121u);
  EXPECT_EQ(to_convention(test::random_sh(1, 1), Convention::unity).size(), 4u);
  EXPECT_TRUE(to_convention(RadianceSh(), Convention::unity).empty());
}

TEST(Convert, RefusesOddCountsAndBadNumbers) {
  for (const std::size_t count : {0u, 2u, 8u, 10u, 16u, 1000000u}) {
    EXPECT_THROW(from_convention(Stored(count, vec3(1)), Convention::unity), Error) << count;
  }
  EXPECT_THROW(from_convention(Stored(144, vec3(1)), Convention::ssphh), Error);
  EXPECT_NO_THROW(from_convention(Stored(121, vec3(1)), Convention::ssphh));
  Stored bad(9, vec3(1));
  bad[4].y = NAN;
  EXPECT_THROW(from_convention(bad, Convention::three), Error);
}

TEST(Convert, NamesFindTheirConvention) {
  for (const auto& [convention, name] : enum_names<Convention>) {
    EXPECT_EQ(parse_enum<Convention>(name), convention);
  }
  EXPECT_EQ(parse_enum<Convention>("unreal"), Convention::d3dx);
  EXPECT_EQ(parse_enum<Convention>("godot"), Convention::three);
  EXPECT_EQ(parse_enum<Convention>("three.js"), Convention::three);
  EXPECT_EQ(parse_enum<Convention>("blender"), std::nullopt);
}

}  // namespace
}  // namespace ssphh::sh
