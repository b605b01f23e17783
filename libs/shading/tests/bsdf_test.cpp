#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/shading/bsdf.h>

#include "bsdf/blinn_phong.h"
#include "bsdf/disney_diffuse.h"
#include "bsdf/ggx.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/specular.h"
#include "bsdf_models.h"

namespace ssphh::shading::test {
namespace {

TEST(Bsdf, LambertIsAlbedoOverPiTimesCosine) {
  const BsdfParams params{vec3(0.2f, 0.5f, 0.9f), vec3(0), 0, 1};
  EXPECT_TRUE(is_lambertian(params));
  const vec3 wi = direction(0.6f, 1);
  const vec3 f = eval_bsdf(params, direction(0.3f), wi);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(f[c], params.diffuse[c] * 0.6f / pi);
  const auto sample = sample_bsdf(params, direction(0.3f), 0.5f, vec2(0.3f, 0.7f));
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->weight, params.diffuse) << "cosine sampling leaves exactly the albedo";
}

TEST(Bsdf, ItsDiffuseLobeIsWhatIsLeftWithoutTheSpecularOne) {
  for (const NamedBsdf& model : bsdf_models()) {
    BsdfParams specular = model.params;
    specular.diffuse = vec3(0);
    Pcg32 random(2);
    for (int n = 0; n < 100; ++n) {
      const vec3 wo = direction(0.02f + 0.97f * random.uniform(), 6 * random.uniform());
      const vec3 wi = direction(0.02f + 0.97f * random.uniform(), 6 * random.uniform());
      const BsdfFrom diffuse(model.params, wo, Lobes::diffuse);
      const vec3 whole = eval_bsdf(model.params, wo, wi), mirrored = eval_bsdf(specular, wo, wi);
      const BsdfValue f = diffuse.eval(wi);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(f.value[c], whole[c] - mirrored[c], 1e-6f * (1 + whole[c])) << model.name;
      EXPECT_NEAR(f.pdf, wi.z / pi, 1e-6f) << model.name;
      const auto sample = diffuse.sample(random.uniform(), random.uniform2());
      ASSERT_TRUE(sample) << model.name;
      const BsdfValue there = diffuse.eval(sample->wi);
      EXPECT_NEAR(sample->pdf, there.pdf, 1e-6f) << model.name;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sample->weight[c], there.value[c] / there.pdf, 1e-4f) << model.name;
    }
  }
}

TEST(Bsdf, IsReciprocal) {
  for (const NamedBsdf& model : bsdf_models()) {
    Pcg32 random(1);
    for (int n = 0; n < 200; ++n) {
      const vec3 a = direction(0.02f + 0.97f * random.uniform(), 6 * random.uniform());
      const vec3 b = direction(0.02f + 0.97f * random.uniform(), 6 * random.uniform());
      const vec3 forth = eval_bsdf(model.params, a, b) / b.z, back = eval_bsdf(model.params, b, a) / a.z;
      // Rounding of single precision in D, where the half vector is a difference of digits
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(forth[c], back[c], 2e-4f * (forth[c] + 1e-3f)) << model.name;
    }
  }
}

TEST(Bsdf, ReflectsNothingBelowTheHorizon) {
  const vec3 up = direction(0.5f), down = -direction(0.5f, 1);
  for (const NamedBsdf& model : bsdf_models()) {
    EXPECT_EQ(eval_bsdf(model.params, up, down), vec3(0)) << model.name;
    EXPECT_EQ(eval_bsdf(model.params, down, up), vec3(0)) << model.name;
    EXPECT_EQ(pdf_bsdf(model.params, up, down), 0) << model.name;
    EXPECT_FALSE(sample_bsdf(model.params, down, 0.5f, vec2(0.5f))) << model.name;
  }
}

/// Albedo by the material's own sampling with low-discrepancy numbers: resolves lobes of any width.
vec3 sampled_albedo(const BsdfParams& params, float cos_o) {
  constexpr std::uint32_t count = 4096;
  vec3 sum(0);
  for (std::uint32_t n = 0; n < count; ++n) {
    SampleSequence sequence(17, n);
    const float u_lobe = sequence.next();
    const auto s = sample_bsdf(params, direction(cos_o), u_lobe, sequence.next2());
    if (s) sum += s->weight;
  }
  return sum / static_cast<float>(count);
}

TEST(Bsdf, DirectionalAlbedoOfALobeIsWhatItsSamplesReflect) {
  for (int r = -38; r <= 38; ++r) {
    const BsdfParams metal{vec3(0), vec3(0.9f), 0, static_cast<float>(r) / 38};
    for (const float cos_o : {1.0f, 0.95f, 0.85f, 0.7f, 0.5f, 0.3f, 0.1f}) {
      const float sampled = sampled_albedo(metal, cos_o).x;
      // The table's steps: 2e-3; samples of Blinn–Phong by GGX's normals have noise
      EXPECT_NEAR(directional_albedo(metal, cos_o).x, sampled, (r > 0 ? 3e-3f : 5e-3f) * sampled)
          << "roughness " << r << "/38, cos " << cos_o;
    }
  }
}

TEST(Bsdf, WhiteFurnaceNeverGainsEnergy) {
  // Everything a material of white base colour can be: dielectric, metal and between (surface.h)
  for (const float diffuse_roughness : {-1.0f, -0.4f, 0.0f, 0.45f, 1.0f}) {
    for (const float specular_roughness : {-1.0f, -0.7f, -0.4f, -0.1f, 0.0f, 0.1f, 0.4f, 0.7f, 1.0f}) {
      for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        const BsdfParams params{vec3(1 - metallic), vec3(glm::mix(0.04f, 1.0f, metallic)), diffuse_roughness,
                                specular_roughness};
        for (const float cos_o : {1.0f, 0.7f, 0.4f, 0.15f, 0.03f}) {
          // 1 %: noise of 4096 samples, interpolation of the table
          EXPECT_LE(sampled_albedo(params, cos_o).x, 1.01f)
              << "diffuse " << diffuse_roughness << ", specular " << specular_roughness << ", metallic "
              << metallic << ", cos " << cos_o;
        }
      }
    }
  }
}

TEST(Bsdf, DiffuseModelsAloneNeverExceedTheirAlbedo) {
  for (int r = -20; r <= 20; ++r) {
    const BsdfParams params{vec3(1), vec3(0), static_cast<float>(r) / 20, 1};
    for (const float cos_o : {1.0f, 0.8f, 0.6f, 0.4f, 0.2f, 0.1f, 0.01f}) {
      const vec3 wo = direction(cos_o);
      const vec3 albedo =
          integrate_hemisphere([&](const vec3& wi) { return eval_bsdf(params, wo, wi); }, 60, 60);
      EXPECT_LE(albedo.x, 1.002f) << "roughness " << r << "/20, cos " << cos_o;  // quadrature: 1e-3
      EXPECT_GE(albedo.x, 0.5f);
    }
  }
}

TEST(Bsdf, LambertUnderSpecularLeavesWhatTheLobeTransmits) {
  for (const float roughness : {-0.8f, -0.5f, 0.4f, 0.7f, 1.0f}) {
    for (const float cos_o : {1.0f, 0.6f, 0.3f, 0.1f}) {
      const BsdfParams both{vec3(1, 0.5f, 0), vec3(0.04f), 0, roughness};
      const vec3 wo = direction(cos_o);
      const vec3 albedo = integrate_hemisphere([&](const vec3& wi) { return eval_bsdf(both, wo, wi); });
      // The table's nodes are 1/31 apart: a few 1e-3 at grazing angles, where Schlick's term bends most
      EXPECT_NEAR(albedo.x, 1, 4e-3f) << roughness << " " << cos_o;
      const vec3 estimate = directional_albedo(both, cos_o);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(albedo[c], estimate[c], 4e-3f) << roughness << " " << cos_o;
    }
  }
}

TEST(Bsdf, MirrorReflectsItsFresnelTermAtTheMirrorDirection) {
  for (const float roughness : {0.0f, -1e-9f}) {
    const BsdfParams params{vec3(0), vec3(0.9f, 0.6f, 0.3f), 0, roughness};
    for (const float cos_o : {1.0f, 0.5f, 0.2f}) {
      const vec3 wo = direction(cos_o, 0.4f), mirror(-wo.x, -wo.y, wo.z);
      vec3 sum(0);
      constexpr int count = 256;
      for (int n = 0; n < count; ++n) {
        const vec2 u((static_cast<float>(n) + 0.5f) / count,
                     std::fmod(0.618034f * static_cast<float>(n), 1.0f));
        const auto s = sample_bsdf(params, wo, 0.5f, u);
        ASSERT_TRUE(s);
        sum += s->weight;
        // α = 1e-3: 99.6 % of the half vectors lie within 16 α, directions within twice that
        EXPECT_GT(glm::dot(s->wi, mirror), std::cos(0.06f));
      }
      for (int c = 0; c < 3; ++c) {
        const float f = params.f0[c] + (1 - params.f0[c]) * schlick_weight(cos_o);
        EXPECT_NEAR(sum[c] / count, f, 3e-3f) << roughness << " " << cos_o;
      }
    }
  }
}

TEST(Bsdf, NeverReturnsNonFiniteNumbers) {
  Pcg32 random(5);
  for (int n = 0; n < 20000; ++n) {
    const auto grazing = [&] { return std::pow(10.0f, -7 * random.uniform()); };
    const float edge[] = {0, 1, random.uniform()};
    const BsdfParams params{vec3(edge[random.next() % 3]), vec3(edge[random.next() % 3]),
                            2 * random.uniform() - 1,
                            (random.next() & 1 ? 1.0f : -1.0f) * edge[random.next() % 3]};
    const vec3 wo = direction(grazing(), 6 * random.uniform()),
               wi = direction(grazing(), 6 * random.uniform());
    const BsdfValue f = eval_bsdf_and_pdf(params, wo, wi);
    ASSERT_TRUE(is_finite(f.value) && std::isfinite(f.pdf) && f.pdf >= 0);
    const auto s = sample_bsdf(params, wo, random.uniform(), random.uniform2());
    if (!s) continue;
    ASSERT_TRUE(is_finite(s->weight) && std::isfinite(s->pdf) && is_finite(s->wi));
    ASSERT_NEAR(glm::length(s->wi), 1, 1e-5f);
  }
}

TEST(DiffuseModels, OrenNayarWithoutRoughnessIsLambert) {
  EXPECT_FLOAT_EQ(oren_nayar(0, direction(0.4f), direction(0.7f, 2)), 0.7f / pi);
}

TEST(DiffuseModels, DisneyPeakIsTheLargestAlbedoOfThePublishedModel) {
  // Undo the scaling and integrate: at normal and at grazing view the peak's closed forms must come out
  const auto albedo = [](float roughness, float cos_o) {
    const vec3 wo = direction(cos_o);
    return integrate_hemisphere([&](const vec3& wi) { return disney_diffuse(roughness, wo, wi); }) *
           disney_diffuse_peak(roughness);
  };
  EXPECT_NEAR(albedo(1, 1e-4f), disney_diffuse_peak(1), 1e-3f);  // quadrature
  EXPECT_NEAR(albedo(0.8f, 1e-4f), disney_diffuse_peak(0.8f), 1e-3f);
  EXPECT_NEAR(albedo(0.41f, 1), disney_diffuse_peak(0.41f), 1e-4f);
}

TEST(DiffuseModels, OrenNayarIsFujiisFormula) {
  // The qualitative model in angles, A + B s/t with A = 1/(π + (π/2 − 2/3) σ), B = σ A.
  for (const float sigma : {0.3f, 1.0f}) {
    for (const float phi : {0.0f, 0.7f, 2.5f, 3.14159f}) {
      for (const auto& [ti, to] : {std::pair{0.3, 1.2}, {1.1, 0.5}, {0.8, 0.8}}) {
        const double s = std::sin(ti) * std::sin(to) * std::cos(double{phi});
        const double t = s <= 0 ? 1 : std::max(std::cos(ti), std::cos(to));
        const double a = 1 / (pi_d + (pi_d / 2 - 2.0 / 3) * double{sigma});
        const vec3 wo = direction(static_cast<float>(std::cos(to)), 0.4f),
                   wi = direction(static_cast<float>(std::cos(ti)), 0.4f + phi);
        EXPECT_NEAR(oren_nayar(sigma, wo, wi), std::cos(ti) * (a + double{sigma} * a * s / t), 1e-6)
            << sigma << " " << phi << " " << ti;
      }
    }
  }
}

TEST(DiffuseModels, DisneyIsBurleysFormulaOverItsPeak) {
  for (const float roughness : {0.0f, 0.35f, 1.0f}) {
    for (const float phi : {0.0f, 1.0f, 3.0f}) {
      const vec3 wo = direction(0.3f, 0.2f), wi = direction(0.6f, 0.2f + phi);
      const double cos_d = double{glm::dot(wi, glm::normalize(wo + wi))};
      const double fd90 = 0.5 + 2 * double{roughness} * cos_d * cos_d;
      const double expected = 0.6 / pi_d * (1 + (fd90 - 1) * std::pow(1 - 0.3, 5)) *
                              (1 + (fd90 - 1) * std::pow(1 - 0.6, 5)) /
                              double{disney_diffuse_peak(roughness)};
      EXPECT_NEAR(disney_diffuse(roughness, wo, wi), expected, 1e-6) << roughness << " " << phi;
    }
  }
}

TEST(SpecularModels, GrazingReflectanceIsOneButFadesWithADarkF0) {
  const auto lobe = [](const vec3& f0) { return SpecularLobe({vec3(0), f0, 0, 0.5f}); };
  EXPECT_EQ(lobe(vec3(0.04f)).f90, 1);
  EXPECT_EQ(lobe(vec3(0.02f, 0, 0)).f90, 1);
  EXPECT_FLOAT_EQ(lobe(vec3(0, 0.01f, 0.002f)).f90, 0.5f);
  // Schlick's approximation with f90 = ½.
  const double s = std::pow(1 - 0.3, 5);
  EXPECT_NEAR(lobe(vec3(0, 0.01f, 0.002f)).fresnel(0.3f).y, 0.01 + (0.5 - 0.01) * s, 1e-6);
  EXPECT_NEAR(lobe(vec3(0, 0.01f, 0.002f)).fresnel(0.3f).z, 0.002 + (0.5 - 0.002) * s, 1e-6);
}

TEST(SpecularModels, DistributionsProjectToUnitArea) {
  for (const float alpha : {0.1f, 0.3f, 0.7f, 1.0f}) {
    const float ggx_area =
        integrate_hemisphere([&](const vec3& h) { return ggx_distribution(alpha, h) * h.z; }, 4000, 4);
    const float phong_area = integrate_hemisphere(
        [&](const vec3& h) { return blinn_phong_distribution(alpha, h) * h.z; }, 4000, 4);
    EXPECT_NEAR(ggx_area, 1, 1e-3f) << alpha;  // quadrature of the narrowest peak
    EXPECT_NEAR(phong_area, 1, 1e-3f) << alpha;
  }
}

TEST(SpecularModels, BlinnPhongMaskingLeavesTheProjectedAreaItSees) {
  // 1 + Λ(v) = ∫ D max(v·h, 0) dω_h / cos θ_v (Heitz 2014, eq. 11 and 30)
  for (const float alpha : {0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
    for (const float slope : {0.5f, 1.0f, 3.0f, 10.0f}) {
      const float c = 1 / std::sqrt(1 + slope * slope / (alpha * alpha));
      const vec3 v = direction(c);
      const float area = integrate_hemisphere(
          [&](const vec3& h) { return blinn_phong_distribution(alpha, h) * glm::max(glm::dot(v, h), 0.0f); });
      // The fit is within 2 % of 1 + Λ
      EXPECT_NEAR((1 + blinn_phong_lambda(alpha, c)) * c / area, 1, 0.02f) << alpha << " " << slope;
    }
  }
}

TEST(SpecularModels, SeenFaceOnTheyAreDistributionTimesFresnelOverFour) {
  const vec3 n(0, 0, 1);
  const float alpha = 0.25f;  // roughness 0.5
  const vec3 f0(0.5f);
  EXPECT_NEAR(eval_bsdf({vec3(0), f0, 0, 0.5f}, n, n).x, 0.5f / (4 * pi * alpha * alpha), 1e-4f);
  // (n + 2)/2π with n = 2/α² − 2 is the same 1/πα²
  EXPECT_NEAR(eval_bsdf({vec3(0), f0, 0, -0.5f}, n, n).x, 0.5f / (4 * pi * alpha * alpha), 1e-4f);
}

}  // namespace
}  // namespace ssphh::shading::test
