#pragma once
/// Light that differs by place, direction and colour, with closed forms: what a lookup must keep apart.

#include <cmath>

#include <ssphh/core/math.h>
#include <ssphh/probes/probe_set.h>

namespace ssphh::test {

/// L(ω) = a + b·ω + c ω_x ω_y, in three colours; b's columns belong to x, y, z.
struct VariedLight {
  vec3 a{0}, c{0};
  mat3 b{0};

  vec3 radiance(const vec3& w) const { return a + b * w + c * (w.x * w.y); }
  /// Ramamoorthi & Hanrahan's factors π, 2π/3, π/4 of the bands.
  vec3 irradiance(const vec3& n) const { return pi * a + 2 * pi / 3 * (b * n) + pi / 4 * c * (n.x * n.y); }
  /// Behind a lobe that scales band l by s[l].
  template <class Scales>
  vec3 glossy(const vec3& r, const Scales& s) const {
    return s[0] * a + s[1] * (b * r) + s[2] * c * (r.x * r.y);
  }

  sh::RadianceSh sh(int degree) const {
    sh::RadianceSh f(degree);
    f[0] = std::sqrt(4 * pi) * a;
    const float band1 = std::sqrt(4 * pi / 3);
    if (degree > 0) f[1] = band1 * b[1], f[2] = band1 * b[2], f[3] = band1 * b[0];
    if (degree > 1) f[4] = c / std::sqrt(15 / (4 * pi));
    return f;
  }

  friend VariedLight operator*(float s, const VariedLight& l) { return {s * l.a, s * l.c, s * l.b}; }
  friend VariedLight operator+(const VariedLight& l, const VariedLight& r) {
    return {l.a + r.a, l.c + r.c, l.b + r.b};
  }
};

/// Linear in place within [0, 4]³ in every number and colour; nowhere negative, for the directional parts are
/// together less than the mean.
inline VariedLight light_at(const vec3& p) {
  const auto grows = [&](float base, const vec3& slope) { return base + glm::dot(slope, p); };
  VariedLight l;
  l.a = {grows(2, {0.7f, 0.1f, 0.3f}), grows(4, {-0.5f, 0.4f, 0.2f}), grows(3, {0.2f, 0.6f, -0.3f})};
  l.b[0] = {grows(0.5f, {0, 0.05f, 0}), grows(-0.4f, {0.1f, 0, 0}), grows(0.2f, {0, 0, 0.08f})};
  l.b[1] = {grows(-0.3f, {0, 0, 0.1f}), grows(0.6f, {0, -0.07f, 0}), grows(0.1f, {0.09f, 0, 0})};
  l.b[2] = {grows(0.4f, {-0.1f, 0, 0}), grows(0.1f, {0, 0, 0.06f}), grows(-0.5f, {0, 0.1f, 0})};
  l.c = {grows(0.3f, {0.05f, 0, 0}), grows(-0.2f, {0, 0.1f, 0}), grows(0.1f, {0, 0, -0.1f})};
  return l;
}

/// One group, whose reflected light is `reflected(position)` and whose emitters are seen as
/// `emitted(position)`.
template <class Reflected, class Emitted>
probes::ProbeSet varied_set(const std::vector<vec3>& places, int degree, const Reflected& reflected,
                            const Emitted& emitted) {
  probes::ProbeSet set;
  set.degree = degree;
  set.light_groups.push_back({"lamp", vec3(1)});
  for (const vec3& place : places) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.position = place;
    probe.groups.push_back({emitted(place).sh(degree), reflected(place).sh(degree)});
  }
  probes::merge_groups(set);
  return set;
}
template <class Reflected>
probes::ProbeSet varied_set(const std::vector<vec3>& places, int degree, const Reflected& reflected) {
  return varied_set(places, degree, reflected, [](const vec3&) { return VariedLight{}; });
}

}  // namespace ssphh::test
