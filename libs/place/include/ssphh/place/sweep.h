#pragma once
/// Places that a moving part passes.

#include <vector>

#include <ssphh/rays/transport_source.h>

namespace ssphh::place {

/// Poses of all moving parts during the scene's animations, close enough that a part moves no farther than
/// `step` metres from one to the next (but at most 256 of them).
class Sweep {
 public:
  Sweep(const rays::TransportSource& source, float step);
  /// The poses of one moment [s] alone.
  static Sweep at(const rays::TransportSource& source, float time);

  bool any() const { return !parts_.empty(); }
  /// Name of the first part that comes nearer than `clearance` to the place, or has it inside, at some time;
  /// null: none does.
  const std::string* passes(const vec3& position, float clearance) const;
  /// Whether a part lies between two places at some time.
  bool separates(const vec3& a, const vec3& b) const;

 private:
  struct Part {
    int index;
    scene::Bounds bounds;
    std::vector<mat4> to_part;  ///< world to part, at each time
  };
  explicit Sweep(const rays::TransportSource& source) : source_(source) {}

  const rays::TransportSource& source_;
  std::vector<Part> parts_;
};

}  // namespace ssphh::place
