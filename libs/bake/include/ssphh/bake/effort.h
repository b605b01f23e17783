#pragma once
/// How much a bake spends, by one word and by the memory that it may take.

#include <cstdint>

#include <ssphh/core/enum_names.h>

namespace ssphh::bake {

enum class Quality : std::uint8_t { draft, good, best };
constexpr auto enum_table(Quality) {
  using enum Quality;
  return std::to_array<EnumName<Quality>>({{draft, "draft"}, {good, "good"}, {best, "best"}});
}

/// What a bake's error follows from.
struct Effort {
  int spp = 16;                   ///< paths of GEN and VIZ per texel of a probe's cube map
  int directions = 1536;          ///< rays by which a probe sees surfels
  int link_rays = 128;            ///< rays by which a surfel finds what lights it
  float surfels_per_radius = 32;  ///< the scene's radius over the edge of a surfel
  int most_surfels = 100000;      ///< about so many; beyond, they grow with the distance of probes
  int records = 16384;            ///< surface points that keep light, at most

  friend bool operator==(const Effort&, const Effort&) = default;
};

/// From quality to quality time grows two- to fourfold (docs/methods/transport.md#quality).
Effort effort_of(Quality quality);

/// Bytes that a network of so many surfels takes while it is built, with all their rays: 45 bytes a ray and 2
/// kB a surfel, as measured, beside 64 MB for all else.
double network_bytes(double surfels, double rays);

/// Surfels whose network, at so many rays each, stays within `bytes` while it is built. Never less than a
/// thousand.
int surfels_within(std::uint64_t bytes, int link_rays);

}  // namespace ssphh::bake
