#pragma once
/// Probes on a regular grid.

#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/place/lattice.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::methods::probe_volume {

struct ProbeGrid {
  place::Lattice lattice;
  std::vector<std::int32_t>
      probe;                    ///< at each place of the lattice, x fastest; −1: none, it is within a body
  std::vector<vec3> positions;  ///< of the probes
};

struct ProbeGridParams {
  float spacing = 0;  ///< [m]; 0: such that the grid has about `places` places
  int places = 200;   ///< for spacing 0
  int most = 4096;    ///< more places are an Error, not a long wait
  std::vector<vec3> interest =
      {};  ///< places that are not within a body, to tell which side of surfaces is out
};

/// Over the box of all that never moves, at the offset where most places are free. Places within bodies, by
/// the share of back faces seen (calibrated_back_limit), have no probe. Throws Error for too many places, for
/// a scene without surfaces, and when no place is free.
ProbeGrid make_probe_grid(const rays::TransportSource& source, const ProbeGridParams& params,
                          const Control& control);

/// Trilinear interpolation. Corners without a probe do not count; where a whole cell has none, the probe
/// nearest to the cell's middle serves. Outside of the grid the nearest point of its box counts.
class GridWeights final : public probes::LookupWeights {
 public:
  explicit GridWeights(const ProbeGrid& grid);
  probes::ProbeWeights at(const rays::SurfacePoint& point) const override { return at(point.position); }
  probes::ProbeWeights at(const vec3& position) const;
  std::size_t bytes() const override;

 private:
  std::int32_t probe_at(const glm::ivec3& place) const;

  place::Lattice lattice_;
  std::vector<std::int32_t> probe_;
  std::vector<std::int32_t> nearest_;  ///< probe nearest to each cell's middle, where its corners have none
};

}  // namespace ssphh::methods::probe_volume
