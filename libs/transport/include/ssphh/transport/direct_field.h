#pragma once
/// Direct irradiance of patches of surfels, per light group, kept as long as nothing changes it: straight
/// from emitters, and what panes mirror of their light.

#include <span>
#include <vector>

#include <ssphh/transport/network.h>

namespace ssphh::transport {

class DirectField {
 public:
  /// Keeps a reference to the network. Everything is dark until the first update.
  DirectField(const TransportNetwork& network, std::size_t group_count);
  DirectField(const TransportNetwork&&, std::size_t) = delete;  // it would be gone

  /// Finds the group's light at all samples.
  std::size_t update_all(int group, const rays::DirectLight& light);
  /// After the parts moved: only at samples on parts, and where one of `moved` (the parts' world bounds
  /// before and after) may shadow the light. Returns the number of samples asked for.
  std::size_t update_moved(int group, const rays::DirectLight& light, std::span<const scene::Bounds> moved);

  /// Both in pieces: choose_all() or choose_moved(), then find() of the `chosen` samples, a range at a time.
  std::size_t choose_all(int group);
  std::size_t choose_moved(int group, const rays::DirectLight& light, std::span<const scene::Bounds> moved);
  void find(int group, const rays::DirectLight& light, std::size_t begin, std::size_t end);

  /// Σ_g scale_g · E_g of each patch: at its sample; where that is not in use, the mean of the surfel's other
  /// ones. `extra` is added at each sample when not empty.
  void sum(std::span<const vec3> group_scales, std::span<const vec3> extra,
           std::vector<Irradiance4>& out) const;

 private:
  void require_group(int group) const;
  const TransportNetwork& network_;
  std::vector<std::vector<vec3>> groups_;  ///< [group][sample]
  std::vector<std::uint32_t> which_;       ///< samples that were chosen
  std::vector<std::uint8_t> touched_;
  std::vector<rays::SurfacePoint> points_;
  std::vector<vec3> values_, mirrored_;
};

}  // namespace ssphh::transport
