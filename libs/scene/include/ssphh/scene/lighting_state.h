#pragma once
/// What lights a scene at one moment, as one value: methods, relight sessions, renderers and the viewer take
/// it whole and find out by themselves what has changed.

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>

#include <ssphh/core/vectors.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::image {
struct Image;
}

namespace ssphh::scene {

struct Scene;

/// A light of the scene as it is now; its type, cone, radius, range and group are the scene's.
struct LightState {
  mat4 world{1};  ///< light to world: position, and direction −z
  vec3 color{1};
  float intensity = 1;         ///< units as scene::Light; 0: off
  sh::IntensitySh emission{};  ///< of an SPHL now, in its axes; empty: of others, and of one that is dark

  friend bool operator==(const LightState&, const LightState&) = default;
};

/// A probe that is a light of its own: a sphere of the probe's radius, which neither blocks nor reflects.
struct SphlEmission {
  int probe = 0;
  sh::RadianceSh leaving;  ///< radiance that leaves the sphere into each direction

  friend bool operator==(const SphlEmission&, const SphlEmission&) = default;
};

/// What is infinitely far away, as it is now.
struct EnvironmentState {
  float rotation = 0;  ///< about +y beyond the scene's own, counter-clockwise seen from above [rad]
  /// Equirectangular radiance in place of that of the scene's environment, whose factor and rotation it gets;
  /// null: the scene's own. An image that was given is not changed.
  std::shared_ptr<const image::Image> image;

  EnvironmentState(float turned = 0, std::shared_ptr<const image::Image> other = nullptr)
      : rotation(turned), image(std::move(other)) {}
  friend bool operator==(const EnvironmentState&, const EnvironmentState&) = default;
};

struct LightingState {
  float time = 0;                  ///< poses the moving parts [s]
  std::vector<LightState> lights;  ///< one for each light of the scene, in its order
  std::vector<vec3> group_scales;  ///< a factor for each light group, in the order of light_groups()
  /// The environment is turned about +y by so much beyond the scene's own rotation, counter-clockwise seen
  /// from above [rad].
  float environment_rotation = 0;
  std::vector<SphlEmission> emission;  ///< of the probes that shine, each once; the others do not
  std::shared_ptr<const image::Image> environment_image{};  ///< as EnvironmentState::image

  EnvironmentState environment() const { return {environment_rotation, environment_image}; }
  friend bool operator==(const LightingState&, const LightingState&) = default;
};

/// The scene's own lights where its animations put them at `time`, every group at its full strength, but dark
/// ones at 0.
LightingState lighting_at(const Scene& scene, float time = 0);

/// How many of each a state must speak of.
struct LightingCounts {
  std::size_t lights = 0, groups = 0, probes = 0;
};

/// Throws Error that names the light, group or probe for another number of lights or groups, for a probe that
/// there is not or that shines twice, for what is not finite, for coefficients of no degree, and for a
/// negative intensity or factor.
void check_lighting(const LightingState& state, const LightingCounts& counts);

}  // namespace ssphh::scene
