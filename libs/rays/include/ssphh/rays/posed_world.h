#pragma once
/// Rays in the world against parts that stand where their poses put them.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/rays/transport_source.h>

namespace ssphh::rays {

/// The box around a transformed box.
scene::Bounds transformed(const scene::Bounds& box, const mat4& matrix);

/// All parts of a source for one pose of each. Keeps a reference to the source. A part that its pose scales
/// to nothing, also along one axis only, is not there.
class PosedWorld {
 public:
  PosedWorld(const TransportSource& source, float time);
  /// `poses`: part to world, one for each part; that of part 0 is not looked at.
  PosedWorld(const TransportSource& source, std::span<const mat4> poses);
  PosedWorld(const TransportSource&&, float) = delete;  // it would be gone
  PosedWorld(const TransportSource&&, std::span<const mat4>) = delete;

  /// Nearest hit of each ray with any part; where asked for, moves[i] = 1 if that part moves, else 0.
  void intersect(std::span<const RayQuery> rays, std::span<RayHit> hits,
                 std::span<std::uint8_t> moves = {}) const;
  /// blocked[i] = 1 where any part meets segment i, else 0.
  void occluded(std::span<const RayQuery> segments, std::span<std::uint8_t> blocked) const;
  bool occluded(const RayQuery& segment) const;
  /// Whether nothing blocks the open segment between two points.
  bool visible(const vec3& a, const vec3& b) const { return !occluded({a, b - a, 1}); }
  /// Whether there is no glass either that dims light on its way.
  bool joined(const vec3& a, const vec3& b) const;
  /// The box around all parts as posed; empty for a scene without triangles.
  const scene::Bounds& bounds() const { return bounds_; }

 private:
  struct Part {
    int index;
    mat4 to_part;
    RayQuery in_frame(const RayQuery& ray) const {
      return {vec3(to_part * vec4(ray.origin, 1)), mat3(to_part) * ray.direction, ray.t_max};
    }
  };
  void place(int part, const mat4& pose);
  /// Calls visit(part, rays in its frame) for every part that is there.
  template <class Visit>
  void for_parts(std::span<const RayQuery> rays, const Visit& visit) const;

  const TransportSource& source_;
  std::vector<Part> moving_;
  scene::Bounds bounds_;
};

}  // namespace ssphh::rays
