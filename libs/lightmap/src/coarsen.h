#pragma once
/// Wider texels where surfaces are far from everything.

#include <optional>
#include <span>

#include <ssphh/lightmap/chart.h>

namespace ssphh::lightmap {

/// A scene of which wide triangles are cut, so that parts of them may have wider texels.
struct Coarsened {
  scene::Scene scene;
  Halvings halvings;
  double area = 0;  ///< of what has wider texels [m²]
  int most_halvings = 0;
};

/// Surfaces at least 2, 4, 8, … 64 times `near` metres from whatever stands before them get texels 2, 4, 8, …
/// times as wide: at no place wider for its distance than those of places at `near`. Triangles must be so
/// large themselves: what is round has small ones. Of the instances that `own` marks. None where nothing is
/// so far from all.
std::optional<Coarsened> coarsen(const scene::Scene& scene, float time, std::span<const std::uint8_t> own,
                                 float near, const Control& control = {});

}  // namespace ssphh::lightmap
