/// Shadow maps of what is infinitely far: the sun's cascades, fitted to the view, and one map over the whole
/// scene for each direction that stands for the environment.

#include <cmath>

#include "lights.h"

namespace ssphh::realtime {
namespace {

/// Distances at which cascades end, as shares of the farthest: each a quarter of the next.
constexpr float cascade_share[] = {1.0f / 64, 1.0f / 16, 1.0f / 4};
static_assert(std::size(cascade_share) + 1 == Lights::sun_cascades);

}  // namespace

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
  gpu.forward = vec4(forward, static_cast<float>(map));
  parallel_.set_view(map, {origin, frame.x / radius, frame.y / radius, forward / range, 0});
  distant_changed_ = true;
}

void Lights::place_sun(const Source& source, const scene::CameraPose& camera, float aspect,
                       const scene::Bounds& bounds) {
  const vec3 forward = -vec3(emitters_[static_cast<std::size_t>(source.emitter)].place);
  const vec3 eye(camera.world[3]), ahead = -glm::normalize(vec3(camera.world[2]));
  const float half_height =
      camera.camera.orthographic ? 0.5f * camera.camera.yheight : std::tan(0.5f * camera.camera.yfov);
  const float across = half_height * std::sqrt(1 + aspect * aspect);
  const float farthest = 2 * bounds.radius();
  for (int i = 0; i < sun_cascades; ++i) {
    vec3 center = bounds.center();
    float radius = bounds.radius();
    if (i + 1 < sun_cascades) {
      const float end = farthest * cascade_share[i];
      const float side = camera.camera.orthographic ? across : across * end;
      const float own = 0.5f * std::sqrt(end * end + 4 * side * side);
      if (own < radius) {
        // In steps, so that a view that moves a little keeps its maps
        const float step = 0.25f * own;
        center = step * glm::round((eye + 0.5f * end * ahead) / step);
        radius = own + 0.87f * step;
      }
    }
    const int map = source.first_map + i;
    const vec3 key = center + 17.0f * forward + vec3(radius);
    vec3& last = parallel_key_[static_cast<std::size_t>(map)];
    if (key == last) continue;
    last = key;
    set_parallel(map, forward, center, radius, bounds);
  }
}

void Lights::place_environment(const scene::Bounds& bounds) {
  environment_bounds_ = bounds;
  for (const Source& source : sources_) {
    if (source.emitter >= scene_emitters_ || emitters_[static_cast<std::size_t>(source.emitter)].items.x !=
                                                 static_cast<int>(EmitterKind::environment))
      continue;
    for (std::size_t i = 0; i < directions_.size(); ++i)
      set_parallel(source.first_map + static_cast<int>(i), -directions_[i].direction, bounds.center(),
                   1.01f * bounds.radius(), bounds);
  }
}

}  // namespace ssphh::realtime
