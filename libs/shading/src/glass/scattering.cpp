#include <ssphh/shading/scattering.h>

namespace ssphh::shading {

void ScatteringFrom::add_glass(const GlassParams& glass, const vec3& wo) {
  glass_.emplace(glass, wo);
  const float all = power();
  chance_ = all > 0 ? share_ * glass_->power() / all : 0;
}

float ScatteringFrom::power() const {
  return share_ > 0 ? share_ * glass_->power() + (1 - share_) : 1;
}

BsdfValue ScatteringFrom::eval_mixed(const vec3& wi) const {
  const BsdfValue glass = glass_->eval(wi), opaque = opaque_.eval(wi);
  return {share_ * glass.value + (1 - share_) * opaque.value,
          chance_ * glass.pdf + (1 - chance_) * opaque.pdf};
}

std::optional<ScatteringSample> ScatteringFrom::sample_mixed(float u_lobe, const vec2& u) const {
  ScatteringSample out{};
  if (u_lobe < chance_) {
    const auto s = glass_->sample(u_lobe / chance_, u);
    if (!s) return std::nullopt;
    out = {s->wi, s->weight * (share_ / chance_), s->pdf, s->spread, true};
  } else {
    const auto s = opaque_.sample((u_lobe - chance_) / (1 - chance_), u);
    if (!s) return std::nullopt;
    out = {s->wi, s->weight, s->pdf};
  }
  if (!(out.pdf > 0)) return out;  // nothing else has that direction
  const BsdfValue f = eval_mixed(out.wi);
  if (!(f.pdf > 0)) return std::nullopt;
  out.weight = f.value / f.pdf, out.pdf = f.pdf;
  return out;
}

}  // namespace ssphh::shading
