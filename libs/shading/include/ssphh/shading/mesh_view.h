#pragma once
/// An emissive mesh as a surface point sees it: its irradiance in closed form, and directions to it.

#include <array>
#include <optional>

#include <ssphh/shading/lights.h>

namespace ssphh::shading {

/// For meshes of few triangles and even emission. Triangles are cut off at the point's horizon.
class MeshView {
 public:
  static constexpr std::size_t max_triangles = 32;

  /// `normal` is the receiver's, of unit length.
  MeshView(const vec3& position, const vec3& normal, const vec3& radiance, int group)
      : position_(position), normal_(normal), radiance_(radiance), group_(group) {}

  /// Adds a triangle of a side that emits toward the point; at most max_triangles of them. World space.
  void add(const vec3& p0, const vec3& p1, const vec3& p2);

  /// [W/m²] on the receiver if nothing stood between (Lambert's formula for polygons).
  vec3 irradiance() const { return radiance_ * static_cast<float>(total()); }

  /// Chooses a triangle by its irradiance and a direction to it, uniform in solid angle (Arvo, Stratified
  /// Sampling of Spherical Triangles, SIGGRAPH 1995). `pdf` as LightSet::sample_emitter. Empty when nothing
  /// is seen.
  std::optional<LightSample> sample(const vec2& u) const;

 private:
  struct Piece {
    glm::dvec3 a, b, c;  ///< from the receiver
    double sum;          ///< irradiance / radiance of the pieces up to this one
  };
  double total() const { return count_ > 0 ? pieces_[count_ - 1].sum : 0; }
  void add_piece(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

  glm::dvec3 position_, normal_;
  vec3 radiance_;
  int group_;
  std::size_t count_ = 0;
  std::array<Piece, 2 * max_triangles> pieces_;
};

}  // namespace ssphh::shading
