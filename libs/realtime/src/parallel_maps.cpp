/// Shadow maps of what is infinitely far: the sun's cascades, fitted to the view, and one map over the whole
/// scene for each direction that stands for the environment.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include <glm/gtc/matrix_transform.hpp>

#include <ssphh/sh/rotate.h>

#include "lights.h"

namespace ssphh::realtime {
namespace {

/// What one of a sun's maps shows: a square across its light.
struct Square {
  vec3 center;
  float radius;  ///< half a side
};

/// Around the places up to this depth, in steps, so that a view that moves a little keeps its maps. `gap`:
/// how far apart the places may stand.
std::optional<Square> square_around(std::span<const vec4> places, float end, const Frame& light, float gap) {
  vec2 low(std::numeric_limits<float>::max()), high(-low);
  for (const vec4& p : places) {
    if (p.w > end) continue;
    const vec2 at(glm::dot(vec3(p), light.x), glm::dot(vec3(p), light.y));
    low = glm::min(low, at), high = glm::max(high, at);
  }
  if (low.x > high.x) return {};
  const vec2 half = 0.5f * (high - low) + gap;
  const float own = std::exp2(std::ceil(4 * std::log2(std::max(half.x, half.y))) / 4), step = 0.25f * own;
  const vec2 center = step * glm::round(0.5f * (low + high) / step);
  return Square{center.x * light.x + center.y * light.y, own + 0.5f * step};
}

/// Around all that may be seen up to this depth, in steps likewise.
Square square_around(const vec3& eye, const vec3& ahead, float end, float side) {
  const float own = 0.5f * std::sqrt(end * end + 4 * side * side), step = 0.25f * own;
  return {step * glm::round((eye + 0.5f * end * ahead) / step), own + 0.87f * step};
}

/// Depths at which all cascades but the last end, which holds the whole scene: all but one in equal ratios up
/// to where most of the picture stands, one halfway to the farthest that is seen.
std::array<float, sun_cascades - 1> cascade_ends(const Seen& seen, float whole) {
  constexpr int fine = sun_cascades - 2;
  constexpr float least_spread = 4;  // nothing is gained by maps that hardly differ
  const float far = seen.far > 0 ? std::min(seen.far, whole) : whole;
  const float most = seen.far > 0 ? std::min(seen.most, far) : whole / least_spread;
  const float near = std::min(seen.far > 0 ? seen.near : most / 64, most / least_spread);
  std::array<float, sun_cascades - 1> ends;
  for (int i = 0; i < fine; ++i)
    ends[i] = near * std::pow(most / near, static_cast<float>(i + 1) / static_cast<float>(fine));
  ends.back() = std::sqrt(most * far);
  return ends;
}

}  // namespace

bool Lights::is_sun(const Source& source) const {
  return source.light >= 0 && lights_[source.light].type == scene::LightType::directional;
}

bool Lights::any_sun() const {
  return std::ranges::any_of(sources_, [&](const Source& s) { return is_sun(s) && s.lights(); });
}

int Lights::most_sun_parts(const scene::Scene& scene, const RendererParams& params) {
  int suns = 0, discs = 0;
  for (const scene::Light& light : scene.lights) {
    if (light.type != scene::LightType::directional) continue;
    ++suns;
    discs += light.angular_radius > 0;
  }
  const int environment = scene.environment ? std::clamp(params.environment_samples, 1, max_area_samples) : 0;
  const int spare = (max_parallel_maps - environment) / sun_cascades - suns;
  return std::clamp(1 + spare / std::max(discs, 1), 1, std::clamp(params.sun_samples, 1, max_area_samples));
}

void Lights::point_sun(const Source& source, const vec3& axis, float radius) {
  GpuEmitter& e = emitters_[source.emitter];
  e.place = vec4(axis, radius);
  e.count.z = suns_.size(), e.count.w = suns_.layout().columns_log2;
  if (bounds_) e.items.w = bounds_->layout().columns_log2, e.count.x = bounds_->levels();
  e.more.x = std::sin(radius) / std::sqrt(static_cast<float>(source.parts.size()));
  const Frame frame = Frame::around(axis);
  float along = 0;
  for (const vec3& part : source.parts) along += part.z;
  for (std::size_t i = 0; i < source.parts.size(); ++i) {
    e.samples[i].place = vec4(frame.to_world(source.parts[i]), 1 / along);  // all together 1 along the axis
    e.samples[i].normal.w = static_cast<float>(source.first_map + sun_cascades * static_cast<int>(i));
  }
}

void Lights::set_parallel(int map, const vec3& forward, const vec3& center, float radius,
                          const scene::Bounds& bounds) {
  const Frame frame = Frame::around(forward);
  // Everything that may stand between the light and the piece counts
  const float reach = 1.01f * bounds.radius() + 1e-4f;
  const float middle = glm::dot(bounds.center() - center, forward);
  const vec3 origin = center + (middle - reach) * forward;
  const float range = 2 * reach;
  GpuSunMap& gpu = distant_.maps[map];
  gpu.origin = vec4(origin, 1 / range);
  gpu.right = vec4(frame.x, 1 / radius);
  gpu.up = vec4(frame.y, 1 / radius);
  const bool sun = map < sun_slots_;
  const int tile = sun ? map : map - sun_slots_;
  gpu.forward = vec4(forward, static_cast<float>(tile));
  (sun ? suns_ : skies_).set_view(tile, {origin, frame.x / radius, frame.y / radius, forward / range, 0});
  distant_changed_ = true;
}

void Lights::place_sun(const Source& source, const scene::CameraPose& camera, float aspect, const Seen& seen,
                       const scene::Bounds& bounds) {
  GpuEmitter& emitter = emitters_[source.emitter];
  const vec3 eye(camera.world[3]), ahead = -glm::normalize(vec3(camera.world[2]));
  const float half_height =
      camera.camera.orthographic ? 0.5f * camera.camera.yheight : std::tan(0.5f * camera.camera.yfov);
  const float across = half_height * std::sqrt(1 + aspect * aspect);
  const auto ends = cascade_ends(seen, 2 * bounds.radius());
  // Depth is measured through the whole scene, by all cascades alike
  const bool stretched = bounds.min != sun_bounds_.min || bounds.max != sun_bounds_.max;
  for (int i = 0; i < emitter.items.z * sun_cascades; ++i) {
    const int cascade = i % sun_cascades;
    const vec3 forward(-emitter.samples[i / sun_cascades].place);
    Square square{bounds.center(), bounds.radius()};
    if (cascade + 1 < sun_cascades) {
      const float end = ends[cascade], side = camera.camera.orthographic ? across : across * end;
      const Square all = square_around(eye, ahead, end, side);
      const Square some =
          square_around(seen.places, end, Frame::around(forward), side / SeenPlaces::width).value_or(all);
      const Square& less = some.radius < all.radius ? some : all;
      if (less.radius < square.radius) square = less;
    }
    const int map = source.first_map + i;
    const ParallelKey key{forward, square.center, square.radius};
    std::optional<ParallelKey>& last = sun_key_[map];
    if (key == last && !stretched) continue;
    last = key;
    set_parallel(map, forward, square.center, square.radius, bounds);
    const GpuSunMap& gpu = distant_.maps[map];
    emitter.corners[i] = vec4(glm::dot(square.center, vec3(gpu.right)), glm::dot(square.center, vec3(gpu.up)),
                              1 / square.radius, map);
    emitters_changed_ = true;
  }
}

/// The directions that stand for the environment's image, and their light.
void Lights::find_environment() {
  directions_ = environment_directions(*environment_, environment_samples_);
  sky_irradiance_ = environment_irradiance(*environment_);
  show_directions();
}

void Lights::show_directions() {
  for (const Source& source : sources_) {
    GpuEmitter& e = emitters_[source.emitter];
    if (e.items.x != static_cast<int>(EmitterKind::environment)) continue;
    e.items.z = static_cast<int>(directions_.size());
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      GpuAreaSample& s = e.samples[i];
      s.normal.w = static_cast<float>(source.first_map + static_cast<int>(i));
      s.light = vec4(directions_[i].weight, 0);
    }
  }
  turn_environment();
}

void Lights::turn_environment() {
  const sh::IrradianceSh turned =
      sh::Rotation::about_axis(sky_irradiance_.degree(), vec3(0, 1, 0), turn_).apply(sky_irradiance_);
  for (int k = 0; k < static_cast<int>(std::size(distant_.environment_sh)); ++k)
    distant_.environment_sh[k] = vec4(turned[k], 0);
  const mat3 turn(glm::rotate(mat4(1), turn_, vec3(0, 1, 0)));
  for (const Source& source : sources_) {
    GpuEmitter& e = emitters_[source.emitter];
    if (e.items.x != static_cast<int>(EmitterKind::environment)) continue;
    for (std::size_t i = 0; i < directions_.size(); ++i)
      e.samples[i].place = vec4(turn * directions_[i].direction, 0);
  }
  emitters_changed_ = distant_changed_ = true;
}

void Lights::place_environment(const scene::Bounds& bounds) {
  environment_bounds_ = bounds;
  emitters_changed_ = true;
  for (const Source& source : sources_) {
    GpuEmitter& e = emitters_[source.emitter];
    if (e.items.x != static_cast<int>(EmitterKind::environment)) continue;
    e.count.z = skies_.size(), e.count.w = skies_.layout().columns_log2;
    for (std::size_t i = 0; i < directions_.size(); ++i)
      set_parallel(source.first_map + static_cast<int>(i), -vec3(e.samples[i].place), bounds.center(),
                   1.01f * bounds.radius(), bounds);
  }
}

}  // namespace ssphh::realtime
