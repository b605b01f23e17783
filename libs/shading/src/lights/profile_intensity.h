#pragma once
/// The directions of a lamp with a photometric profile: shares of its brightest direction, within the cones
/// of a spot.

#include <memory>

#include <ssphh/scene/scene.h>

#include "distribution.h"
#include "lamp_shape.h"

namespace ssphh::shading {

/// What a spot's cones leave of its light (KHR_lights_punctual).
struct ConeFalloff {
  float scale = 0, offset = 1;  ///< scale 0: there are none

  /// 0..1; `cosine`: of the angle to the spot's axis.
  float at(float cosine) const;
};
ConeFalloff cone_falloff(const scene::Light& spot);

/// What does not change as the lamp moves, is dimmed or coloured: directions are in the axes of its angles.
class ProfileTable {
 public:
  /// A point or spot light whose profile is not empty.
  explicit ProfileTable(const scene::Light& light);

  const mat3& axes() const { return axes_; }  ///< in those of the lamp
  float toward(const vec3& local) const;
  float mean() const { return mean_; }
  LampShape::Direction sample(const vec2& u) const;
  float pdf(const vec3& local) const;

 private:
  float solid_angle(std::size_t cell) const;

  std::shared_ptr<const scene::PhotometricTable> table_;
  ConeFalloff cone_;
  mat3 axes_;
  vec3 aim_;     ///< of the lamp
  float scale_;  ///< 1 over the greatest candela
  float mean_ = 0;
  /// Edges of the cells, which are those of the table, so that none hides a peak: cosines falling from the
  /// pole, angles about it rising [rad].
  std::vector<float> z_, turn_;
  Distribution cells_;  ///< row by row in z, each row around it
};

class ProfileIntensity final : public LampShape {
 public:
  ProfileIntensity(std::shared_ptr<const ProfileTable> table, const mat4& world)
      : table_(std::move(table)), axes_(scene::emission_axes(world) * table_->axes()) {}

  vec3 toward(const vec3& direction) const override { return vec3(table_->toward(to_local(direction))); }
  vec3 mean() const override { return vec3(table_->mean()); }
  Direction sample(const vec2& u) const override {
    const Direction local = table_->sample(u);
    return {glm::normalize(axes_ * local.direction), local.pdf};
  }
  float pdf(const vec3& direction) const override { return table_->pdf(to_local(direction)); }

 private:
  vec3 to_local(const vec3& direction) const { return glm::normalize(direction * axes_); }

  std::shared_ptr<const ProfileTable> table_;
  mat3 axes_;
};

}  // namespace ssphh::shading
