#pragma once
/// Probe G-buffers: what each probe sees along fixed directions. Depends on geometry alone, so lights may do
/// what they like (theory: docs/methods/transport.md).

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::transport {

/// One hit in 16 bytes. Errors: distance none, normal < 0.01°, albedo 5e-4.
struct PackedHit {
  float distance;                 ///< metres; infinite: the ray escaped
  std::uint16_t normal[2];        ///< octahedral
  std::uint32_t albedo_and_back;  ///< 10 bits a channel, R lowest; bit 30: a back face
  std::uint16_t emission;         ///< index into the emission palette; 0: none
  std::uint16_t part;
};
static_assert(sizeof(PackedHit) == 16);

/// Radiance of an emitter with the light group it belongs to.
struct EmissionEntry {
  vec3 radiance{0};
  int group = -1;
  friend bool operator==(const EmissionEntry&, const EmissionEntry&) = default;
};

/// Distinct emissions, each quantised to 1 part in 512; entry 0 is darkness. When 65,535 are not enough, the
/// rest take the last one of their group.
class EmissionPalette {
 public:
  std::uint16_t add(const vec3& radiance, int group);
  /// 0 when it was never added.
  std::uint16_t find(const vec3& radiance, int group) const;
  const EmissionEntry& operator[](std::uint16_t i) const { return entries_[i]; }
  std::size_t size() const { return entries_.size(); }

 private:
  std::vector<EmissionEntry> entries_{EmissionEntry{}};
  std::map<std::array<float, 4>, std::uint16_t> index_;
};

PackedHit pack_hit(const rays::RayHit& hit, int part, EmissionPalette& palette);
vec3 unpack_normal(const PackedHit& hit);
vec3 unpack_albedo(const PackedHit& hit);

/// 10 bits a channel; input is clamped to 0..1.
std::uint32_t pack_albedo(const vec3& albedo);
vec3 unpack_albedo(std::uint32_t packed);

/// What a probe ray meets by way of a pane that mirrors it.
struct MirroredHit {
  std::uint32_t owner;  ///< probe · directions + direction
  vec3
      from;  ///< the probe, or where the pane before hangs that mirrors it: the way to ray.origin starts here
  rays::RayQuery ray;  ///< from the pane on; t_max is the distance of the hit
  vec3 normal, albedo;
  vec3 share;  ///< of the hit's light, what panes and other glass leave of it
};

struct ProbeGBuffer {
  std::vector<vec3> positions;   ///< of the probes
  std::vector<vec3> directions;  ///< unit, the same for every probe; weight 4π / count each
  std::vector<PackedHit> hits;   ///< [probe · directions.size() + direction]
  /// RayHit::through of each hit, packed as an albedo; empty where no ray meets glass. Emission is kept as
  /// seen through it.
  std::vector<std::uint32_t> through;
  std::vector<MirroredHit> mirrored;  ///< by owner
  EmissionPalette palette;

  /// Albedo of a hit as the probe sees it, packed: dimmed by glass in front of it.
  std::uint32_t seen_albedo(std::size_t hit) const;
  vec3 point(std::size_t probe, std::size_t direction) const {
    return positions[probe] + hits[probe * directions.size() + direction].distance * directions[direction];
  }
};

/// Traces `direction_count` spherical Fibonacci directions at each position against part 0 alone.
ProbeGBuffer trace_gbuffer(const rays::TransportSource& source, std::span<const vec3> positions,
                           int direction_count, const Control& control = {});

}  // namespace ssphh::transport
