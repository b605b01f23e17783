#pragma once
/// A set's light resampled on a regular grid, for engines that interpolate between grid points without asking
/// what sees what.

#include <ssphh/core/control.h>
#include <ssphh/probe_export/free_light.h>

namespace ssphh::probe_export {

/// One cell per point, the point in its middle.
struct GridShape {
  vec3 low{0};         ///< least corner of the first cell [m]
  vec3 cell{1};        ///< edges of a cell [m]
  glm::ivec3 size{0};  ///< cells along each axis

  vec3 high() const { return low + cell * vec3(size); }
  vec3 point(const glm::ivec3& at) const { return low + cell * (vec3(at) + 0.5f); }
  std::size_t count() const {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
  }
  /// x fastest, then y, then z.
  std::size_t index(const glm::ivec3& at) const {
    return (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(size.y) +
            static_cast<std::size_t>(at.y)) *
               static_cast<std::size_t>(size.x) +
           static_cast<std::size_t>(at.x);
  }
  glm::ivec3 place(std::size_t index) const;
};

struct GridParams {
  float spacing = 0;  ///< longest edge of a cell [m]; 0: such that there are some 8,000 points
  std::size_t most = std::size_t{1} << 20;  ///< more points are an Error, not a long wait
  int most_cells = 290;                     ///< along one axis: what textures of common GPUs hold
};

/// Over the surfaces' box, as far as two distances between probes beyond the outermost ones, and half a cell
/// more. Along each axis by itself the cells are as wide, and begin, as lets least light through walls: an
/// engine that looks half a cell before a surface meets no point behind it where a border between two cells
/// lies in the wall. Throws Error that names metres which would fit for too many points, before memory is
/// taken.
GridShape fit_grid(const probes::ProbeSet& set, const FreeLight& light, const GridParams& params = {});

/// A point that takes the mean of others' light.
struct FilledPoint {
  std::size_t index;
  std::vector<std::size_t> from;
};

struct LightGrid {
  GridShape shape;
  std::vector<sh::RadianceSh> light;  ///< of degree 2, as FreeLight::at has it
  std::vector<FilledPoint> filled;    ///< points within bodies or out of all probes' sight, each after those
                                      ///< that it takes from
};

/// Points that lie within a body (by the share of backs seen, place::calibrated_back_limit) or see no probe
/// would get a guess; they take the mean of the neighbours along the axes that are good, of those the ones
/// whose side of the wall is nearest, and so on from neighbour to neighbour. Throws Error when no point is
/// good, Cancelled when asked to stop.
LightGrid resample(const probes::ProbeSet& set, const FreeLight& light, const rays::TransportSource& source,
                   const GridShape& shape, const Control& control = {});

}  // namespace ssphh::probe_export
