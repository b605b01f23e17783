#pragma once
/// Lights at infinity: directional ones, discs such as the sun, and the environment. Chosen with fixed
/// probabilities, by the irradiance they give, so their densities do not depend on the place.

#include <memory>
#include <span>

#include <ssphh/image/image.h>
#include <ssphh/shading/lights.h>

#include "cone.h"
#include "distribution.h"

namespace ssphh::shading {

class ProfileTable;

struct DirectionalLight {
  vec3 to_light;    ///< unit
  vec3 irradiance;  ///< on a facing plane
  int group;
};

/// A scene's light with the colour, intensity and place that it has now.
struct PosedLight {
  scene::Light light;
  mat4 world{1};
  int group = 0;
  sh::IntensitySh emission{};                     ///< now
  std::shared_ptr<const ProfileTable> profile{};  ///< of a point or spot light that has one
};

/// Uniformly bright disc.
struct DiscLight {
  vec3 to_light;  ///< unit, its centre
  Frame frame;
  vec3 radiance;
  Cone cone;
  vec3 irradiance;  ///< on a facing plane
  int group;
};

/// Constant or equirectangular. An image is sampled by the luminance of its bilinear interpolant, averaged
/// per pixel.
class EnvironmentLight {
 public:
  EnvironmentLight(const scene::Environment& environment, int group);
  /// Of another image than the scene's.
  EnvironmentLight(std::shared_ptr<const image::Image> image, const vec3& color, float rotation, int group);

  /// The same with another rotation [rad]: nothing is computed anew.
  EnvironmentLight turned(float rotation) const;
  float rotation() const { return rotation_; }
  /// In place of the scene's own; null: that one.
  const std::shared_ptr<const image::Image>& image() const { return held_; }

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

  EnvironmentLight(const vec3& color, float rotation, int group, const image::Image* image);

  std::shared_ptr<const image::Image> held_;
  const image::Image* image_ = nullptr;  ///< null: constant
  vec3 color_;
  float rotation_, cos_, sin_;
  int group_;
  float mean_irradiance_ = 0;
  std::vector<float> row_cos_;         ///< cos θ at the rows' edges
  Distribution rows_;                  ///< empty: uniform sampling
  std::vector<Distribution> columns_;  ///< in each row
};

class DistantLights {
 public:
  DistantLights() = default;
  /// Leaves out the lights that are not distant or off. `environment` may be null.
  DistantLights(std::span<const PosedLight> lights, std::shared_ptr<const EnvironmentLight> environment) {
    assign(lights, std::move(environment));
  }
  /// The same in place of what they were, in the memory of that.
  void assign(std::span<const PosedLight> lights, std::shared_ptr<const EnvironmentLight> environment);

  /// Those of other light groups than these.
  DistantLights without(std::span<const int> groups) const;

  bool empty() const { return choice_.empty(); }
  std::optional<LightSample> sample(float u_choice, const vec2& u) const;

  /// Those that a ray can find: discs, then the environment.
  int visible_count() const { return static_cast<int>(discs_.size() + (environment_ ? 1 : 0)); }
  std::optional<EmitterHit> hit(int i, const vec3& direction) const;

  /// One by one: directional, discs, environment in this order; densities of the one alone.
  std::size_t count() const { return directional_.size() + static_cast<std::size_t>(visible_count()); }
  Emitter emitter(std::size_t i) const;
  std::optional<LightSample> sample_one(std::size_t i, const vec2& u) const;
  std::optional<EmitterHit> radiance_of(std::size_t i, const vec3& direction) const;
  /// As LightSet::flux and emit.
  float flux(std::size_t i, float radius) const;
  std::optional<rays::Photon> emit(std::size_t i, const vec2& u_place, const vec2& u_direction,
                                   const vec3& center, float radius) const;
  const std::shared_ptr<const EnvironmentLight>& environment() const { return environment_; }

 private:
  void divide_choices();

  std::vector<DirectionalLight> directional_;
  std::vector<DiscLight> discs_;
  std::shared_ptr<const EnvironmentLight> environment_;
  std::vector<float> power_;  ///< scratch
  Distribution choice_;       ///< over directional, discs, environment in this order
};

}  // namespace ssphh::shading
