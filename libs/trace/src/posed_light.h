#pragma once
/// Direct light of a scene for one state of its lights and one pose of its parts.

#include <bit>

#include <ssphh/core/random.h>
#include <ssphh/shading/mesh_view.h>

#include "transport_data.h"

namespace ssphh::trace {

/// Of the random numbers of a place: its bits.
inline std::uint64_t position_seed(const vec3& p) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return hash_combine((std::uint64_t{bits(p.x)} << 32) | bits(p.y), bits(p.z));
}

class PosedLight final : public rays::DirectLight {
 public:
  PosedLight(std::shared_ptr<const TransportData> data, std::span<const scene::LightState> lights,
             std::span<const mat4> poses, const scene::EnvironmentState& environment);
  bool is_of(const TransportData* data) const { return data_.get() == data; }
  /// Becomes what the constructor makes of the same data, in its own memory.
  void pose(std::span<const scene::LightState> lights, std::span<const mat4> poses,
            const scene::EnvironmentState& environment);

  void irradiance(int group, std::span<const rays::SurfacePoint> points, std::span<vec3> out) const override;
  bool may_shadow(int group, const rays::SurfacePoint& point, const scene::Bounds& box) const override;
  vec3 emitted(int group, const rays::RayQuery& ray, float distance) const override;
  rays::IrradianceByNormal irradiance_by_normal(int group, const rays::SurfacePoint& point,
                                                int samples) const override;
  std::vector<rays::ArrivingLight> arriving(int group, const vec3& place, int samples) const override;
  bool mirrors() const override { return !data_->panes.empty(); }
  void mirrored(int group, std::span<const rays::SurfacePoint> points, std::span<vec3> out) const override;
  rays::IrradianceByNormal mirrored_by_normal(int group, const rays::SurfacePoint& point,
                                              int samples) const override;
  std::vector<rays::ArrivingLight> mirrored_arriving(int group, const vec3& place,
                                                     int samples) const override;
  float flux(int group) const override;
  std::optional<rays::Photon> emit(int group, const rays::PhotonNumbers& numbers) const override;
  std::vector<vec3> emitter_places(int group, float widest, int count) const override;

 private:
  struct GroupEmitter {
    int index;  ///< in lights_
    shading::Emitter emitter;
  };
  /// A lit point with the place where its shadow rays start. With a pane: its mirror image there, to which
  /// lamps send what the point gets by way of the pane; `start` is still the point's own.
  struct Receiver {
    vec3 position, normal, start;
    std::uint64_t seed;
    const Pane* pane = nullptr;
  };

  Receiver receiver(const rays::SurfacePoint& point) const;
  /// The point's mirror image in pane `index`, if that lies before it.
  std::optional<Receiver> mirrored_receiver(const Receiver& at, std::size_t index) const;
  /// Whether light of an emitter that is no sky may come to a mirror image through its pane.
  bool may_arrive(const GroupEmitter& light, const Receiver& image) const;
  /// Calls add(emitter, image, seed) for all mirror images of the point in which emitters of the group may
  /// be seen.
  template <class Add>
  void for_images(int group, const Receiver& at, const Add& add) const;
  /// Share of a sample's light that arrives.
  vec3 arriving_share(const Receiver& at, const shading::LightSample& sample, RayTask& task) const;
  /// Calls add(direction, L / density) for about `count` times the pane's share of the hemisphere: what the
  /// image's point gets of a sky by way of its pane.
  template <class Add>
  void sample_mirrored_sky(const GroupEmitter& light, const Receiver& image, std::uint64_t seed, int count,
                           RayTask& task, const Add& add) const;
  /// irradiance_by_normal() of one emitter, no sky with an image.
  void add_by_normal(const GroupEmitter& light, const Receiver& at, std::uint64_t seed, int samples,
                     RayTask& task, rays::IrradianceByNormal& sum) const;
  /// Share of a light's irradiance that arrives, past what holds it back and through glass. `draw(u)` gives a
  /// LightSample toward it, or none; `sine2` is the squared sine of the angle from its centre to its edge, 1
  /// if that is not known.
  template <class Draw>
  vec3 visible_share(const Receiver& at, std::uint64_t seed, float sine2, const Draw& draw,
                     RayTask& task) const;
  /// Of a sphere light as if nothing held it back; sets `sine2` where the point is outside of it.
  vec3 sphere_irradiance(const GroupEmitter& light, const Receiver& at, std::uint64_t seed,
                         float& sine2) const;
  vec3 irradiance_of(const GroupEmitter& light, const Receiver& at, std::uint64_t seed, RayTask& task) const;
  vec3 sky_irradiance(const GroupEmitter& light, const Receiver& at, std::uint64_t seed, RayTask& task) const;
  /// Calls add(direction, irradiance) for at most `count` samples of a sky: their sum over `count` is its
  /// irradiance. sample_sky.h.
  template <class Add>
  void sample_sky(const GroupEmitter& light, const Receiver& at, std::uint64_t seed, int count, RayTask& task,
                  const Add& add) const;
  /// Likewise of about `count` samples, more at the edges of what hides the sky; their sum is its irradiance.
  template <class Add>
  void sample_kept_sky(const GroupEmitter& light, const Receiver& at, std::uint64_t seed, int count,
                       RayTask& task, const Add& add) const;
  const std::vector<GroupEmitter>& emitters_of(int group) const;
  void list_emitters();

  std::shared_ptr<const TransportData> data_;
  std::vector<mat4> world_;  ///< of nodes
  shading::LightSet lights_;
  PosedGeometry geometry_;
  std::vector<std::vector<GroupEmitter>> groups_;
};

}  // namespace ssphh::trace
