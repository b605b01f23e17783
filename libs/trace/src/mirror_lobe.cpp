#include "mirror_lobe.h"

#include <algorithm>
#include <cmath>

namespace ssphh::trace {

shading::BsdfParams specular_lobe(const shading::Surface& surface) {
  shading::BsdfParams lobe = surface.bsdf;
  lobe.diffuse = vec3(0);
  return lobe;
}

float roughness_of(const shading::Surface& surface) {
  return std::min(std::abs(surface.bsdf.specular_roughness), 1.0f);
}

float followed_share(const shading::Surface& surface) {
  constexpr float all = 0.4f, none = 0.6f;  // roughness
  if (!(max_component(surface.bsdf.f0) > 0)) return 0;
  return std::clamp((none - roughness_of(surface)) / (none - all), 0.0f, 1.0f);
}

MirrorLobe::MirrorLobe(const shading::Surface& surface, const vec3& wo)
    : frame_(Frame::around(surface.normal)),
      geometric_normal_(surface.geometric_normal),
      lobe_(specular_lobe(surface), frame_.to_local(wo)) {
  constexpr float brightest = 8;  // a lobe of an eighth of what is reflected is always followed
  const float cos_wo = std::max(glm::dot(surface.normal, wo), 0.0f);
  const float e = max_component(shading::directional_albedo(specular_lobe(surface), cos_wo));
  const float all = e + max_component(surface.bsdf.diffuse);
  rays_ = e > 0 ? std::min(brightest * e / all, static_cast<float>(most_rays)) : 0;
}

std::optional<shading::BsdfSample> MirrorLobe::sample(float u_lobe, const vec2& u) const {
  auto sample = lobe_.sample(u_lobe, u);
  if (!sample || !(sample->pdf > 0)) return std::nullopt;
  sample->wi = frame_.to_world(sample->wi);
  return above(sample->wi) ? sample : std::nullopt;
}

shading::BsdfValue MirrorLobe::eval(const vec3& wi) const {
  return above(wi) ? lobe_.eval(frame_.to_local(wi)) : shading::BsdfValue{};
}

vec3 specular_share(const shading::Surface& surface, const vec3& wo, const vec3& wi) {
  const vec3 all = shading::BsdfFrom(surface.bsdf, wo).eval(wi).value;
  const vec3 lobe = shading::BsdfFrom(specular_lobe(surface), wo).eval(wi).value;
  vec3 share(0);
  for (glm::length_t c = 0; c < 3; ++c) share[c] = all[c] > 0 ? std::min(lobe[c] / all[c], 1.0f) : 0;
  return share;
}

}  // namespace ssphh::trace
