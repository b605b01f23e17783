#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/image/image.h>
#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {
namespace {

void check_light(std::size_t i, const LightState& light) {
  bool finite = is_finite(light.color) && std::isfinite(light.intensity);
  for (int c = 0; c < 4; ++c) finite = finite && is_finite(vec3(light.world[c]));
  if (!finite || light.intensity < 0) {
    throw Error(fmt::format("light {}", i),
                "its place, colour and intensity must be finite, the last not negative");
  }
  if (!light.emission.empty()) check_emission({.frames = {light.emission}}, fmt::format("light {}", i));
}

void check_emission(const SphlEmission& emission) {
  const sh::RadianceSh& leaving = emission.leaving;
  if (leaving.empty()) return;
  constexpr const char* where = "SPHL emission";
  sh::require_degree(leaving.degree(), where);
  require(static_cast<std::size_t>(sh::coefficient_count(leaving.degree())) == leaving.values.size(), where,
          "its coefficients are not those of a degree");
  require(std::ranges::all_of(leaving.values, is_finite), where, "it is not finite");
}

}  // namespace

LightingState lighting_at(const Scene& scene, float time) {
  const std::vector<mat4> world = world_matrices(scene, time);
  LightingState state;
  state.time = time;
  for (const Light& light : scene.lights) {
    const mat4 placed = light.node >= 0 ? world[light.node] : mat4(1);
    state.lights.push_back({placed, light.color, light.intensity, emission_at(light.emission, time)});
  }
  for (const std::string& group : light_groups(scene))
    state.group_scales.emplace_back(!is_dark(scene, group));
  return state;
}

void check_lighting(const LightingState& state, const LightingCounts& counts) {
  require(std::isfinite(state.time), "time", "it must be a finite number of seconds");
  require(std::isfinite(state.environment_rotation), "environment", "its rotation must be a finite angle");
  require(!state.environment_image ||
              (!state.environment_image->empty() && state.environment_image->channels == 3),
          "environment", "its image must have pixels of three channels");
  if (state.lights.size() != counts.lights || state.group_scales.size() != counts.groups) {
    throw Error("lighting",
                fmt::format("it has {} lights and {} groups, but the scene has {} and {}",
                            state.lights.size(), state.group_scales.size(), counts.lights, counts.groups),
                "start from scene::lighting_at()");
  }
  for (std::size_t i = 0; i < state.lights.size(); ++i) check_light(i, state.lights[i]);
  for (std::size_t g = 0; g < state.group_scales.size(); ++g) {
    const vec3& scale = state.group_scales[g];
    if (!is_finite(scale) || glm::any(glm::lessThan(scale, vec3(0))))
      throw Error(fmt::format("light group {}", g), "its factor must be finite and not negative");
  }
  for (auto emission = state.emission.begin(); emission != state.emission.end(); ++emission) {
    const auto is_same = [&](const SphlEmission& other) { return other.probe == emission->probe; };
    if (emission->probe < 0 || static_cast<std::size_t>(emission->probe) >= counts.probes) {
      throw Error(fmt::format("emission of probe {}", emission->probe),
                  fmt::format("there are {} probes", counts.probes));
    }
    if (std::any_of(state.emission.begin(), emission, is_same))
      throw Error(fmt::format("emission of probe {}", emission->probe), "it is given twice");
    check_emission(*emission);
  }
}

}  // namespace ssphh::scene
