#pragma once
/// Ways to find indirect light, behind one interface, so that each can be drawn, timed and measured as every
/// other: methods/method_list.h lists them. A method is made once for a scene (its bake) and then follows
/// lamps and doors frame by frame.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/methods/drawing.h>
#include <ssphh/methods/light_data.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::methods {

/// What a method may ask of the scene. Both outlive the method.
struct MethodScene {
  const scene::Scene& scene;  ///< as loaded; its lights and poses are those of time 0
  const rays::TransportSource& source;
  /// Whether its light may hold direct light (rays::IndirectLight::direct_groups) of light groups whose mode
  /// says so, for pictures; not where methods are compared.
  bool keep_direct = false;
};

/// Part to world at the state's time, one per part.
std::vector<mat4> part_poses(const rays::TransportSource& source, float time);

/// Named counts and sizes of a method, for tables: "probes", "photons", "lost_energy" …
using MethodNumbers = std::vector<std::pair<std::string, double>>;

/// Bytes that must stay in memory, the scene and its acceleration structures apart.
struct MethodMemory {
  std::size_t lookup = 0;  ///< what light() reads: enough while nothing moves
  std::size_t update = 0;  ///< beside it, what update() needs to follow lamps and doors
};

class Method {
 public:
  virtual ~Method() = default;

  /// One frame: brings the light up to date with the state, keeping whatever of the last frame still holds. A
  /// pure function of the states given so far. SPHLs that shine (LightingState::emission) are those of the
  /// method itself: of `ssphh` alone. Throws Cancelled when asked to stop; the method is then of no more use.
  virtual void update(const scene::LightingState& state, const Control& control) = 0;

  /// Indirect light after the last update(); valid until the next one. Emitters that a surface sees straight
  /// are not in it. Safe to call from several threads.
  virtual const rays::IndirectLight& light() const = 0;

  /// The same light as data, where the method's entry says so. As long valid as light().
  virtual LightData light_data() const { return {}; }

  /// What the method holds after the last update(), as marks in the world; empty for what its entry does not
  /// list.
  virtual sketch::Sketch drawing(Drawing what) const {
    static_cast<void>(what);
    return {};
  }

  virtual MethodMemory memory() const = 0;

  virtual MethodNumbers numbers() const { return {}; }
};

}  // namespace ssphh::methods
