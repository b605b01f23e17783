#pragma once
/// What `ssphh relight --animate` may say: tracks of values that are spread evenly over the frames.

#include <string>
#include <vector>

#include <ssphh/rays/transport_source.h>

#include "options/scene_options.h"

namespace ssphh::app {

enum class TrackProperty {
  time,        ///< seconds of the scene's own animations
  position,    ///< of a light, world [m]
  direction,   ///< of a spot or directional light, world, the way the light goes
  intensity,   ///< of a light, units as scene::Light
  color,       ///< of a light, linear RGB
  scale,       ///< factor on a light group, one number or linear RGB
  turn,        ///< of environment and directional lights about +y, radians
  time_of_day  ///< of the sun in a computed sky, hours
};

/// Values at evenly spaced times, linear between them.
struct Track {
  TrackProperty property = TrackProperty::time;
  int target = -1;  ///< light, or light group for `scale`
  std::vector<vec3> keys;

  /// At u in 0..1.
  vec3 at(float u) const;
};

class RelightAnimation {
 public:
  /// Reads "time=0:1", "LIGHT.position=x,y,z:x,y,z", "GROUP.scale=1:0", "time-of-day=06:00..20:00" … Throws
  /// Error that lists the scene's lights or groups for an unknown name, and for values that are no numbers,
  /// of a wrong count or out of range. Keeps references to source and scene.
  RelightAnimation(const rays::TransportSource& source, const scene::Scene& scene, float time,
                   const std::vector<std::string>& specs);

  /// At u in 0..1 of the run; lights without a track stand where the scene's own animation puts them.
  scene::LightingState frame(float u) const;
  bool moves_time() const;

 private:
  /// Preetham's sun must not set.
  void check_sun() const;
  scene::SunSkyParams sun_at(float hour) const;

  const rays::TransportSource& source_;
  const scene::Scene& scene_;
  float time_;
  std::vector<Track> tracks_;
};

/// Of a --time-of-day that is a range its start; the range becomes one more of `specs`.
SceneOptions at_start_of_day(SceneOptions scene, std::vector<std::string>& specs);

/// How a spec is written, for --help.
extern const char* const animation_help;

}  // namespace ssphh::app
