#pragma once
/// Lights at infinity: directional ones, discs such as the sun, and the environment. Chosen with fixed
/// probabilities, by the irradiance they give, so their densities do not depend on the place.

#include <ssphh/image/image.h>
#include <ssphh/shading/lights.h>

#include "cone.h"
#include "distribution.h"

namespace ssphh::shading {

struct DirectionalLight {
  vec3 to_light;    ///< unit
  vec3 irradiance;  ///< on a facing plane
  int group;
};

/// Uniformly bright disc.
struct DiscLight {
  vec3 to_light;  ///< unit, its centre
  Frame frame;
  vec3 radiance;
  Cone cone;
  int group;
};

/// Constant or equirectangular. An image is sampled by the luminance of its bilinear interpolant, averaged
/// per pixel.
class EnvironmentLight {
 public:
  EnvironmentLight(const scene::Environment& environment, int group);

  int group() const { return group_; }
  /// Mean luminance over the sphere times π: the irradiance of a mean plane.
  float mean_irradiance() const { return mean_irradiance_; }
  vec3 radiance(const vec3& direction) const;
  float pdf(const vec3& direction) const;

  struct Sample {
    vec3 wi, radiance;
    float pdf;
  };
  Sample sample(const vec2& u) const;

 private:
  vec3 to_image(const vec3& d) const { return {cos_ * d.x - sin_ * d.z, d.y, sin_ * d.x + cos_ * d.z}; }
  vec3 to_world(const vec3& d) const { return {cos_ * d.x + sin_ * d.z, d.y, cos_ * d.z - sin_ * d.x}; }
  vec3 lookup(const vec3& image_direction) const;

  const image::Image* image_ = nullptr;  ///< null: constant
  vec3 color_;
  float cos_, sin_;
  int group_;
  float mean_irradiance_ = 0;
  std::vector<float> row_cos_;         ///< cos θ at the rows' edges
  Distribution rows_;                  ///< empty: uniform sampling
  std::vector<Distribution> columns_;  ///< in each row
};

class DistantLights {
 public:
  DistantLights() = default;
  DistantLights(const scene::Scene& scene, const std::vector<mat4>& world,
                const std::vector<std::string>& groups);

  bool empty() const { return choice_.empty(); }
  /// Sum of the irradiances on facing planes (luminance).
  float irradiance() const { return irradiance_; }

  /// pdf without the probability to choose a distant light at all.
  std::optional<LightSample> sample(float u_choice, const vec2& u) const;

  /// Those that a ray can find: discs, then the environment.
  int visible_count() const { return static_cast<int>(discs_.size() + environments_.size()); }
  std::optional<EmitterHit> hit(int i, const vec3& direction) const;

 private:
  std::vector<DirectionalLight> directional_;
  std::vector<DiscLight> discs_;
  std::vector<EnvironmentLight> environments_;  ///< none or one
  Distribution choice_;                         ///< over directional, discs, environment in this order
  float irradiance_ = 0;
};

}  // namespace ssphh::shading
