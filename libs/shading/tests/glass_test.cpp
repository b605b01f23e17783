// Glass against Fresnel's formulas by hand, sums of reflections one by one, and the laws that every surface
// obeys.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/shading/glass.h>
#include <ssphh/shading/scattering.h>

#include "bsdf_models.h"
#include "chi2.h"

namespace ssphh::shading::test {
namespace {

constexpr float glass_cosines[] = {0.95f, 0.5f, 0.15f};

GlassParams sheet(float roughness = 0, const vec3& tint = vec3(1), float ior = 1.5f) {
  GlassParams glass;
  glass.share = 1, glass.ior = ior, glass.roughness = roughness, glass.tint = tint;
  return glass;
}

GlassParams body(bool inside, float roughness = 0, const vec3& tint = vec3(1), float ior = 1.5f) {
  GlassParams glass = sheet(roughness, tint, ior);
  glass.sheet = false, glass.inside = inside;
  return glass;
}

struct NamedGlass {
  std::string name;
  GlassParams params;
};

std::vector<NamedGlass> rough_glass() {
  const vec3 green(0.5f, 0.9f, 0.6f);
  return {{"sheet 0.35", sheet(0.35f)},
          {"green sheet 0.7", sheet(0.7f, green)},
          {"body 0.4 from outside", body(false, 0.4f)},
          {"body 0.4 from inside", body(true, 0.4f)},
          {"green body 0.8 of 2.4 from outside", body(false, 0.8f, green, 2.4f)},
          {"green body 0.8 of 2.4 from inside", body(true, 0.8f, green, 2.4f)}};
}

/// ∫ f(ω) dω over the whole sphere.
template <class F>
auto integrate_sphere(const F& f) {
  return integrate_hemisphere(f) + integrate_hemisphere([&](const vec3& w) { return f({w.x, w.y, -w.z}); });
}

/// Mean of s and p reflectance from Snell's law with angles, in double.
double fresnel_by_angles(double cosine, double eta) {
  const double in = std::acos(cosine), sine = std::sin(in) / eta;
  if (sine >= 1) return 1;
  const double out = std::asin(sine);
  if (in < 1e-9) return std::pow((eta - 1) / (eta + 1), 2);
  const double s = std::sin(in - out) / std::sin(in + out), p = std::tan(in - out) / std::tan(in + out);
  return 0.5 * (s * s + p * p);
}

TEST(Glass, BoundaryReflectsByFresnelsFormulas) {
  for (const float ior : {1.1f, 1.5f, 2.4f}) {
    for (const bool inside : {false, true}) {
      for (const float c : {1.0f, 0.9f, 0.75f, 0.6f, 0.3f, 0.05f}) {
        const GlassShares shares = glass_shares(body(inside, 0, vec3(1), ior), c);
        const double expected = fresnel_by_angles(double{c}, inside ? 1 / double{ior} : double{ior});
        // 2e-6: float roundings, of which total reflection's edge makes the most
        EXPECT_NEAR(shares.reflected.x, expected, 2e-6) << ior << ' ' << inside << ' ' << c;
        EXPECT_NEAR(shares.reflected.x + shares.transmitted.x, 1, 1e-6);
      }
    }
  }
  EXPECT_NEAR(glass_shares(body(false), 1).reflected.x, 0.04f, 1e-7f);
  EXPECT_EQ(glass_shares(body(true), 0.7f).reflected.x, 1) << "beyond the critical angle, cosine 0.745";
  EXPECT_LT(glass_shares(body(true), 0.76f).reflected.x, 1);
}

TEST(Glass, SheetSumsTheReflectionsBetweenItsSurfaces) {
  // Facing, clear: 2n/(n² + 1) passes.
  for (const float n : {1.1f, 1.5f, 2.4f})
    EXPECT_NEAR(glass_shares(sheet(0, vec3(1), n), 1).transmitted.x, 2 * n / (n * n + 1), 1e-6f) << n;
  // Each polarisation by itself, one reflection after the other.
  const vec3 tint(0.3f, 0.8f, 1);
  for (const float c : {0.99f, 0.7f, 0.4f, 0.1f}) {
    const double out = std::sqrt(1 - (1 - double{c} * c) / 2.25);
    const double rs = std::pow((c - 1.5 * out) / (c + 1.5 * out), 2),
                 rp = std::pow((1.5 * c - out) / (1.5 * c + out), 2);
    const GlassShares shares = glass_shares(sheet(0, tint), c);
    for (int k = 0; k < 3; ++k) {
      double reflected = 0, transmitted = 0;
      for (const double r : {rs, rp}) {
        reflected += r / 2;
        double inside = (1 - r) / 2;
        for (int n = 0; n < 400; ++n) {
          inside *= double{tint[k]};
          (n % 2 == 0 ? transmitted : reflected) += (1 - r) * inside;
          inside *= r;
        }
      }
      EXPECT_NEAR(shares.reflected[k], reflected, 2e-6) << c << ' ' << k;
      EXPECT_NEAR(shares.transmitted[k], transmitted, 2e-6) << c << ' ' << k;
    }
  }
  for (const float c : {1.0f, 0.5f, 0.01f, 1e-5f, 0.0f}) {
    const GlassShares shares = glass_shares(sheet(), c);
    EXPECT_NEAR(shares.reflected.x + shares.transmitted.x, 1, 1e-5f) << c;
    EXPECT_GE(shares.transmitted.x, 0) << c;
  }
}

TEST(Glass, SpecularWeighsWhatIsReflectedButForTotalReflection) {
  GlassParams glass = body(false);
  glass.specular = 0;
  EXPECT_EQ(glass_shares(glass, 0.5f).reflected, vec3(0));
  EXPECT_EQ(glass_shares(glass, 0.5f).transmitted, vec3(1));
  glass.inside = true;
  EXPECT_EQ(glass_shares(glass, 0.5f).reflected, vec3(1));
  glass = sheet(0, vec3(0.25f));
  glass.specular = 0;
  EXPECT_NEAR(glass_shares(glass, 0.3f).transmitted.x, 0.25f, 1e-6f);
}

TEST(Glass, StraightThroughABodyIsTheSameFromEitherSide) {
  for (const float c : {1.0f, 0.6f, 0.2f}) {
    EXPECT_EQ(straight_transmittance(body(true), c), straight_transmittance(body(false), c));
    EXPECT_NEAR(straight_transmittance(body(true), c).x, 1 - fresnel_by_angles(double{c}, 1.5), 2e-6);
  }
}

TEST(Glass, StraightThroughRoughGlassKeepsThePowerOfItsLobe) {
  for (const float roughness : {0.35f, 0.7f, 1.0f}) {
    for (const float c : {0.95f, 0.6f}) {
      GlassParams glass = sheet(roughness, vec3(0.6f));
      glass.specular = 0;  // the same share at every angle
      const GlassFrom from(glass, direction(c));
      const float power = integrate_hemisphere([&](const vec3& w) {
        return from.eval({w.x, w.y, -w.z}).value.x;
      });
      EXPECT_NEAR(straight_transmittance(glass, c).x, power, 0.01f * power)
          << roughness << ' ' << c;  // of the table
    }
  }
}

// Smooth glass: what is drawn sums to all that is there, less what goes straight through a sheet.
TEST(Glass, SmoothSamplesKeepThePowerOfLight) {
  const vec3 tint(0.5f, 0.8f, 1);
  for (const GlassParams& glass : {sheet(0, tint), body(false, 0, tint), body(true, 0, tint)}) {
    for (const float c : glass_cosines) {
      const vec3 wo = direction(c, 0.4f);
      const GlassFrom from(glass, wo);
      EXPECT_EQ(from.eval(direction(0.5f)).pdf, 0);
      vec3 sum(0);
      constexpr int count = 4096;
      for (int i = 0; i < count; ++i) {
        const auto s = from.sample((static_cast<float>(i) + 0.5f) / count, vec2(0.5f));
        if (!s) continue;
        EXPECT_EQ(s->pdf, 0);
        EXPECT_NEAR(glm::length(s->wi), 1, 1e-5f);
        sum += s->weight / s->spread;
        if (s->wi.z < 0) {  // Snell
          const float eta = glass.inside ? 1 / 1.5f : 1.5f;
          EXPECT_NEAR(std::hypot(s->wi.x, s->wi.y) * eta, std::hypot(wo.x, wo.y), 1e-5f);
          EXPECT_NEAR(s->spread, 1 / (eta * eta), 1e-6f);
        }
      }
      sum /= static_cast<float>(count);
      if (glass.sheet) sum += straight_transmittance(glass, c);
      const GlassShares all = glass_shares(glass, c);
      // The lobe is chosen in steps of 1/4096.
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(sum[k], all.reflected[k] + all.transmitted[k], 1e-3f) << c << ' ' << k;
    }
  }
}

TEST(Glass, RoughGlassIsReciprocalUpToTheSquareOfTheIndex) {
  Pcg32 random(5);
  int compared = 0;
  for (const NamedGlass& model : rough_glass()) {
    for (int n = 0; n < 300; ++n) {
      const vec3 o = direction(0.05f + 0.95f * random.uniform(), 6 * random.uniform());
      vec3 i = direction(0.05f + 0.95f * random.uniform(), 6 * random.uniform());
      if (n % 2 == 0) i.z = -i.z;
      const vec3 there = GlassFrom(model.params, o).eval(i).value / std::abs(i.z);
      GlassParams other = model.params;
      const bool through = i.z < 0;
      if (through && !other.sheet) other.inside = !other.inside;
      // Seen from i its own side is above.
      const vec3 from = through ? vec3(i.x, i.y, -i.z) : i, to = through ? vec3(o.x, o.y, -o.z) : o;
      const vec3 back = GlassFrom(other, from).eval(to).value / o.z;
      const float ior = model.params.ior;
      const float n_o = !model.params.sheet && model.params.inside ? ior : 1;
      const float n_i = model.params.sheet ? 1 : through ? ior / n_o : n_o;
      for (int k = 0; k < 3; ++k) {
        const float a = there[k] / (n_o * n_o), b = back[k] / (n_i * n_i);
        // 2e-3: where o + η i nearly vanishes its direction is that of rounding errors.
        EXPECT_NEAR(a, b, 2e-3f * std::max(a, b) + 1e-9f) << model.name;
        compared += a > 1e-4f;
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

// One scattering between facets only: rough glass loses light, and never gains any.
TEST(Glass, RoughGlassLosesLittleLightAndGainsNone) {
  for (const NamedGlass& model : rough_glass()) {
    GlassParams clear = model.params;
    clear.tint = vec3(1);
    const float eta = clear.sheet ? 1 : clear.inside ? 1 / clear.ior : clear.ior;
    for (const float c : {0.95f, 0.5f}) {
      const GlassFrom from(clear, direction(c));
      const float power = integrate_sphere(
          [&](const vec3& wi) { return from.eval(wi).value.x * (wi.z < 0 ? eta * eta : 1); });
      EXPECT_LT(power, 1.002f) << model.name << ' ' << c;  // 2e-3: of the quadrature
      EXPECT_GT(power, clear.roughness < 0.5f ? 0.9f : 0.5f) << model.name << ' ' << c;
    }
  }
}

TEST(Glass, DirectionsFollowTheirDensity) {
  const auto models = rough_glass();
  const ssphh::test::Significance significance{0.01,
                                               static_cast<int>(models.size() * std::size(glass_cosines))};
  std::uint64_t seed = 100;
  for (const NamedGlass& model : models) {
    for (const float cos_o : glass_cosines) {
      const GlassFrom from(model.params, direction(cos_o, 0.3f));
      const auto draw = [&](Pcg32& random) -> std::optional<vec3> {
        const float u_lobe = random.uniform();
        const auto s = from.sample(u_lobe, random.uniform2());
        return s ? std::optional(s->wi) : std::nullopt;
      };
      ssphh::test::DirectionCells cells;
      cells.polar = 32, cells.quadrature = 16;
      EXPECT_TRUE(ssphh::test::directions_follow(
          draw, [&](const vec3& wi) { return from.eval(wi).pdf; }, cells, ++seed, significance))
          << model.name << ", cos " << cos_o;
    }
  }
}

TEST(Glass, WeightIsValueOverDensity) {
  for (const NamedGlass& model : rough_glass()) {
    Pcg32 random(3);
    int drawn = 0;
    for (int n = 0; n < 500; ++n) {
      const GlassFrom from(model.params, direction(0.05f + 0.95f * random.uniform(), 6 * random.uniform()));
      const float u_lobe = random.uniform();
      const auto s = from.sample(u_lobe, random.uniform2());
      if (!s) continue;
      ++drawn;
      const BsdfValue f = from.eval(s->wi);
      EXPECT_EQ(s->pdf, f.pdf) << model.name;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(s->weight[c] * s->pdf, f.value[c], 1e-5f * (f.value[c] + s->pdf));
    }
    EXPECT_GT(drawn, 200) << model.name;  // enough to have tested something
  }
}

// The mixture with what is opaque: value, density and samples belong together, and nothing is lost.
TEST(Scattering, PartlyGlassIsTheMeanOfBoth) {
  Surface surface;
  surface.bsdf = {vec3(0.7f, 0.5f, 0.2f), vec3(0.04f), 0, 0.5f};
  for (const GlassParams& glass : {sheet(), sheet(0.4f), body(false), body(true, 0.5f)}) {
    surface.glass = glass;
    surface.glass.share = 0.3f;
    const vec3 wo = direction(0.8f, 0.2f);
    const ScatteringFrom from(surface, wo);
    const BsdfFrom opaque(surface.bsdf, wo);
    const GlassFrom all(glass, wo);
    Pcg32 random(7);
    ssphh::test::Samples power;
    for (int n = 0; n < 20000; ++n) {
      const float u_lobe = random.uniform();
      const auto s = from.sample(u_lobe, random.uniform2());
      power.add(s ? double{s->weight.y / s->spread} : 0.0);
      if (!s || !(s->pdf > 0)) continue;
      const vec3 expected = 0.3f * all.eval(s->wi).value + 0.7f * opaque.eval(s->wi).value;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(s->weight[c] * s->pdf, expected[c], 1e-4f * (expected[c] + s->pdf));
      EXPECT_EQ(s->pdf, from.eval(s->wi).pdf);
    }
    const float eta = glass.sheet ? 1 : glass.inside ? 1 / glass.ior : glass.ior;
    double expected =
        integrate_sphere([&](const vec3& wi) { return from.eval(wi).value.y * (wi.z < 0 ? eta * eta : 1); });
    if (is_smooth(glass)) {
      const GlassShares shares = glass_shares(glass, wo.z);
      expected += 0.3 * double{shares.reflected.y + (glass.sheet ? 0 : shares.transmitted.y)};
    }
    EXPECT_TRUE(ssphh::test::mean_is(power, expected, {0.01, 4}, 2e-3));  // 2e-3: of the quadrature
  }
}

TEST(Glass, SmoothMirrorsTurnLightAboutTheirNormal) {
  const vec3 wo = glm::normalize(vec3(0.3f, 0.5f, 0.8f));
  for (const GlassParams& glass : {sheet(), body(false), body(true)}) {
    const auto sample = GlassFrom(glass, wo).sample_mirrored({0.4f, 0.7f});
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->wi, vec3(-wo.x, -wo.y, wo.z));
    EXPECT_EQ(sample->weight, glass_shares(glass, wo.z).reflected);
    EXPECT_EQ(sample->pdf, 0);
  }
}

}  // namespace
}  // namespace ssphh::shading::test
