#pragma once
/// Radiance probes that know nothing of visibility: places, the light that RelightSession finds for them, and
/// interpolation between them. `irradiance-volume` looks irradiance up in it, `prt` radiance.

#include <memory>
#include <variant>
#include <vector>

#include <ssphh/geometry/tetrahedra.h>
#include <ssphh/methods/method.h>
#include <ssphh/methods/parameters.h>
#include <ssphh/transport/relight_session.h>

#include "probe_grid.h"

namespace ssphh::methods::probe_volume {

/// How weights at a place are found.
class VolumeWeights final : public probes::LookupWeights {
 public:
  explicit VolumeWeights(std::span<const vec3> positions) : by_(geometry::Tetrahedra(positions)) {}
  explicit VolumeWeights(const ProbeGrid& grid) : by_(GridWeights(grid)) {}
  probes::ProbeWeights at(const rays::SurfacePoint& point) const override { return at(point.position); }
  probes::ProbeWeights at(const vec3& position) const;
  std::size_t bytes() const override;
  /// Null on a grid.
  const geometry::Tetrahedra* tetrahedra() const { return std::get_if<geometry::Tetrahedra>(&by_); }
  /// Of tetrahedra; 0 on a grid.
  std::size_t cell_count() const;

 private:
  std::variant<geometry::Tetrahedra, GridWeights> by_;
};

class ProbeVolume {
 public:
  /// With the parameters that probe_volume_parameters() declares; `degree` of the probes' radiance.
  ProbeVolume(const MethodScene& scene, const MethodParameters& parameters, int degree,
              const Control& control);

  /// `dark`: a light group that does not light the probes; −1: none.
  void update(const scene::LightingState& state, int dark, const Control& control);

  const std::vector<scene::ProbePlace>& places() const { return session_->places(); }
  /// Reflected light, after any number of bounces, of each probe.
  const std::vector<sh::RadianceSh>& radiance() const { return session_->reflected(); }
  std::shared_ptr<const VolumeWeights> weights() const { return weights_; }
  /// Median distance between neighbours [m].
  float spacing() const { return spacing_; }
  /// Tetrahedra, surfels and links.
  sketch::Sketch drawing(Drawing what) const;
  MethodMemory memory() const;
  MethodNumbers numbers() const;

 private:
  std::shared_ptr<const VolumeWeights> weights_;
  std::unique_ptr<transport::RelightSession> session_;
  scene::LightingState state_;  ///< what the session was given last
  float spacing_ = 0;
  int environment_group_ = -1;
};

std::vector<MethodParameter> probe_volume_parameters();

}  // namespace ssphh::methods::probe_volume
