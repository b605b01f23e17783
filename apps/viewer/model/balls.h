#pragma once
/// Probes as balls: which colour each point of their surface has.

#include <span>
#include <vector>

#include <ssphh/probes/probe_set.h>

#include "settings.h"
#include "view_camera.h"

namespace ssphh::viewer {

/// Unit sphere of triangles: an octahedron whose faces are halved `levels` times; vertices are shared.
struct BallMesh {
  std::vector<vec3> vertices;
  std::vector<uvec3> triangles;
};
BallMesh make_ball(int levels);

/// Basis of all bands at every vertex of a ball, evaluated once.
class BallShader {
 public:
  explicit BallShader(BallMesh mesh);
  const BallMesh& mesh() const { return mesh_; }

  /// Radiance per vertex, not below 0: of probe `i` of the set as `ball` says; irradiance as E/π, what a
  /// white surface would leave. neighbor and sum are those of the set's hierarchy; without one black and
  /// self. `out` has as many elements as the mesh has vertices.
  void shade(const probes::ProbeSet& set, std::size_t i, Ball ball, std::span<vec3> out) const;

 private:
  BallMesh mesh_;
  std::vector<float> basis_;  ///< [vertex][k]
};

/// How often balls are halved of which so many are drawn: many small ones need fewer triangles each.
int ball_levels(std::size_t balls);

/// Greatest radius of a ball beside its distance from the eye of a perspective view: a near one hides no
/// picture.
constexpr float widest_ball = 0.1f;

/// The radius [m] with which balls of this one are drawn at a place.
float seen_ball_size(float radius, const View& view, const vec3& place);

/// Radius of balls that do not hide each other [m], for Settings::ball_size 0: a sixth of the probes' median
/// distance, at most 0.12 or a twentieth of it.
float default_ball_size(const probes::ProbeSet& set);

}  // namespace ssphh::viewer
