#pragma once
/// The glowing balls of VIZ (docs/conventions.md, theory: every ray that meets ball j before a surface sees
/// radiance 1 of it and goes on), as trace_path asks for them. Group j is ball j.

#include <algorithm>

#include <ssphh/rays/radiance_source.h>

#include "path.h"

namespace ssphh::trace {

class GhostEmitters {
 public:
  struct Ball {
    vec3 center;
    float radius;           ///< 0: off
    bool directly_by_rays;  ///< camera rays add it; else somebody else counts its direct view
  };

  explicit GhostEmitters(std::vector<Ball> balls) : balls_(std::move(balls)) {}

  template <class Visit>
  void along(int depth, const PathVertex& vertex, const Ray& ray, float distance, const Visit& visit) const {
    float total = -1;  // computed when first needed
    for (std::size_t j = 0; j < balls_.size(); ++j) {
      const Ball& ball = balls_[j];
      if (depth == 0 && !ball.directly_by_rays) continue;
      if (!meets(ball, ray, distance) || (ray.t_min > 0 && meets(ball, ray, ray.t_min))) continue;
      float pdf = 0;
      if (depth > 0) {
        if (total < 0) total = total_weight(vertex);
        const float w = weight(ball, vertex);
        if (w > 0) pdf = w / (total * cone_solid_angle(ball, vertex.position));
      }
      visit(static_cast<int>(j), vec3(1), pdf, -ray.direction);
    }
  }

  template <class Visit>
  void surface(const PathVertex&, const Ray&, const Hit&, const shading::Surface&, const Visit&) const {}

  int sample_count(const PathVertex&) const { return 1; }
  std::optional<shading::LightSample> sample(int, const PathVertex& vertex, float u_choice,
                                             const vec2& u) const;

  bool found_by_rays(const PathVertex&) const { return true; }
  bool may_meet(const PathVertex&, const Ray& ray) const {
    return std::ranges::any_of(
        balls_, [&](const Ball& ball) { return meets(ball, ray, std::numeric_limits<float>::infinity()); });
  }

  /// Whether the ray meets the ball (its surface, or it starts inside) before `distance`.
  static bool meets(const Ball& ball, const Ray& ray, float distance);
  /// Solid angle [sr] of a ball seen from outside.
  static float cone_solid_angle(const Ball& ball, const vec3& from);
  /// Uniform direction in that cone, and the distance to the ball along it.
  static vec3 sample_cone(const Ball& ball, const vec3& from, const vec2& u, float& distance);

 private:
  /// Chance, up to a factor, with which sample() chooses a ball: its size seen from the vertex times a bound
  /// of the cosine. Zero from inside: scattered rays alone do that best.
  static float weight(const Ball& ball, const PathVertex& vertex);
  float total_weight(const PathVertex& vertex) const;

  std::vector<Ball> balls_;
};

}  // namespace ssphh::trace
