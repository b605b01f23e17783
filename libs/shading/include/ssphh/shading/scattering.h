#pragma once
/// All that a surface point does to light, opaque and glass together, but for light that goes on straight.

#include <ssphh/shading/surface.h>

namespace ssphh::shading {

struct ScatteringSample {
  vec3 wi;
  vec3 weight;       ///< f · |cos θ_i| / pdf
  float pdf;         ///< 0: of one direction only, which no density tells
  float spread = 1;  ///< as GlassSample
  bool glass = false;
};

/// A surface seen from one direction, in the frame of its shading normal. What goes straight through a smooth
/// sheet is left to straight_transmittance().
class ScatteringFrom {
 public:
  ScatteringFrom(const Surface& surface, const vec3& wo, Lobes lobes = Lobes::all)
      : opaque_(surface.bsdf, wo, lobes), share_(surface.glass.share) {
    if (share_ > 0) add_glass(surface.glass, wo);
  }

  /// f · |cos θ_i| and the density of sample().
  BsdfValue eval(const vec3& wi) const { return share_ > 0 ? eval_mixed(wi) : opaque_.eval(wi); }
  /// `u_lobe` in [0, 1) chooses the lobe, `u` in [0, 1)² the direction. Empty where the direction drawn lies
  /// on the wrong side of the surface.
  std::optional<ScatteringSample> sample(float u_lobe, const vec2& u) const {
    if (share_ > 0) return sample_mixed(u_lobe, u);
    const auto s = opaque_.sample(u_lobe, u);
    return s ? std::optional(ScatteringSample{s->wi, s->weight, s->pdf}) : std::nullopt;
  }
  /// Mean share of the light that comes from wo and does not go on straight.
  float power() const;
  /// With which sample() chooses the glass.
  float glass_chance() const { return chance_; }

 private:
  void add_glass(const GlassParams& glass, const vec3& wo);
  BsdfValue eval_mixed(const vec3& wi) const;
  std::optional<ScatteringSample> sample_mixed(float u_lobe, const vec2& u) const;

  BsdfFrom opaque_;
  std::optional<GlassFrom> glass_;
  float share_;
  float chance_ = 0;  ///< of sampling the glass
};

}  // namespace ssphh::shading
