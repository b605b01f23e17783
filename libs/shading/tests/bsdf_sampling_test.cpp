#include <cmath>

#include <gtest/gtest.h>

#include "bsdf_models.h"
#include "chi2.h"

namespace ssphh::shading::test {
namespace {

constexpr float view_cosines[] = {0.95f, 0.5f, 0.15f};

TEST(BsdfSampling, DirectionsFollowTheirDensity) {
  const auto models = bsdf_models();
  const ssphh::test::Significance significance{0.01,
                                               static_cast<int>(models.size() * std::size(view_cosines))};
  std::uint64_t seed = 0;
  for (const NamedBsdf& model : models) {
    for (const float cos_o : view_cosines) {
      const vec3 wo = direction(cos_o, 0.3f);
      const auto draw = [&](Pcg32& random) -> std::optional<vec3> {
        const float u_lobe = random.uniform();
        const auto s = sample_bsdf(model.params, wo, u_lobe, random.uniform2());
        return s ? std::optional(s->wi) : std::nullopt;
      };
      ssphh::test::DirectionCells cells;
      cells.cos_min = 0;
      EXPECT_TRUE(ssphh::test::directions_follow(
          draw, [&](const vec3& wi) { return pdf_bsdf(model.params, wo, wi); }, cells, ++seed, significance))
          << model.name << ", cos " << cos_o;
    }
  }
}

TEST(BsdfSampling, WeightIsValueOverDensity) {
  for (const NamedBsdf& model : bsdf_models()) {
    Pcg32 random(3);
    int drawn = 0;
    for (int n = 0; n < 500; ++n) {
      const vec3 wo = direction(0.01f + 0.99f * random.uniform(), 6 * random.uniform());
      const float u_lobe = random.uniform();
      const auto s = sample_bsdf(model.params, wo, u_lobe, random.uniform2());
      if (!s) continue;
      ++drawn;
      const vec3 f = eval_bsdf(model.params, wo, s->wi);
      EXPECT_NEAR(s->pdf, pdf_bsdf(model.params, wo, s->wi), 1e-5f * s->pdf) << model.name;
      for (int c = 0; c < 3; ++c) {
        // Two ways to the same product: a few roundings
        EXPECT_NEAR(s->weight[c] * s->pdf, f[c], 1e-5f * (f[c] + s->pdf)) << model.name;
      }
    }
    EXPECT_GT(drawn, 200) << model.name;  // enough to have tested something
  }
}

// Smith's height-correlated masking with α = 1 seen face-on: ∫ D G / (4 cos_o) dω = 1 − ln 2, by hand.
TEST(BsdfSampling, RoughestWhiteGgxSeenFaceOnReflectsOneMinusLogTwo) {
  BsdfParams params;
  params.diffuse = vec3(0);
  params.f0 = vec3(1);
  params.specular_roughness = 1;
  constexpr int count = 20000;
  Pcg32 random(17);
  double sum = 0, squares = 0;
  for (int n = 0; n < count; ++n) {
    const float u_lobe = random.uniform();
    const auto s = sample_bsdf(params, {0, 0, 1}, u_lobe, random.uniform2());
    const double weight = s ? static_cast<double>(s->weight.x) : 0.0;
    sum += weight;
    squares += weight * weight;
  }
  const double mean = sum / count;
  const double deviation = std::sqrt((squares / count - mean * mean) / count);
  EXPECT_NEAR(mean, 1 - std::log(2.0), 3.9 * deviation);  // 3.9 σ: 1e-4 two-sided
}

TEST(BsdfSampling, EstimatesTheAlbedoThatQuadratureFinds) {
  const auto models = bsdf_models();
  const ssphh::test::Significance significance{0.01,
                                               static_cast<int>(models.size() * std::size(view_cosines))};
  Pcg32 random(11);
  for (const NamedBsdf& model : models) {
    for (const float cos_o : view_cosines) {
      const vec3 wo = direction(cos_o);
      const vec3 albedo =
          integrate_hemisphere([&](const vec3& wi) { return eval_bsdf(model.params, wo, wi); });
      ssphh::test::Samples samples;
      for (int n = 0; n < 20000; ++n) {
        const float u_lobe = random.uniform();
        const auto s = sample_bsdf(model.params, wo, u_lobe, random.uniform2());
        samples.add(s ? static_cast<double>(s->weight.x) : 0.0);
      }
      // 1e-4: error of the quadrature
      EXPECT_TRUE(ssphh::test::mean_is(samples, static_cast<double>(albedo.x), significance, 1e-4))
          << model.name << ", cos " << cos_o;
    }
  }
}

// Far from the mirror direction the specular lobe has no density: what is left is the chance of the diffuse
// one times its own, to 1e-5.
TEST(BsdfSampling, LobesAreChosenByTheLightTheyReflectAndNoneIsStarved) {
  const vec3 wo = direction(0.9f), wi = direction(0.5f);
  const auto chance = [&](const vec3& diffuse, float f0) {
    const float pdf = pdf_bsdf({diffuse, vec3(f0), 0, 0.02f}, wo, wi);
    return 1 - pdf / (wi.z / pi);
  };
  const vec3 grey(0.9f, 0.5f, 0.2f);
  for (const float f0 : {0.2f, 0.5f}) {
    const vec3 specular = directional_albedo({vec3(0), vec3(f0), 0, 0.02f}, wo.z);
    const float s = 3 * specular.x, d = glm::dot(grey, vec3(1) - specular);
    EXPECT_NEAR(chance(grey, f0), s / (s + d), 1e-5f) << f0;
  }
  EXPECT_NEAR(chance(grey, 1e-3f), 0.1f, 1e-5f);
  EXPECT_NEAR(chance(vec3(1e-3f), 0.9f), 0.9f, 1e-5f);
  EXPECT_NEAR(chance(vec3(0), 0.9f), 1, 1e-5f) << "there is no diffuse lobe";
}

}  // namespace
}  // namespace ssphh::shading::test
