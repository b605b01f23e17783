#pragma once
/// What a method holds, as marks to draw over a picture (sketch/sketch.h): the paper's Figures 4 to 7 and 9.

#include <ssphh/core/enum_names.h>
#include <ssphh/geometry/tetrahedra.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/sketch/sketch.h>
#include <ssphh/transport/network.h>

namespace ssphh::methods {

enum class Drawing {
  tetrahedra,  ///< between probes, within which their light is interpolated
  hierarchy,   ///< SPHLs as balls of their light, and the edges between them
  links,       ///< of some surfels, to those whose light they gather
  surfels,     ///< patches of surface that exchange light
  photons,     ///< where these met surfaces: virtual point lights
  voxels,      ///< with the radiance that each shows to each side
  transfer     ///< transfer vectors of some vertices
};
constexpr auto enum_table(Drawing) {
  using enum Drawing;
  return std::to_array<EnumName<Drawing>>({{tetrahedra, "tetrahedra"},
                                           {hierarchy, "hierarchy"},
                                           {links, "links"},
                                           {surfels, "surfels"},
                                           {photons, "photons"},
                                           {voxels, "voxels"},
                                           {transfer, "transfer"}});
}

/// A ball for each probe, of the radiance that its sum (without a hierarchy its own light) has in each
/// direction; and a line for each pair that HIER took, wide and yellow where P is large, thin and blue where
/// it is a thousandth of the largest. Without a hierarchy of the set all edges count. Radius of the balls: a
/// tenth of the probes' median distance.
sketch::Sketch hierarchy_drawing(const probes::ProbeSet& set);

/// All edges, each once, and a ball at each point.
sketch::Sketch tetrahedra_drawing(const geometry::Tetrahedra& tetrahedra, std::span<const vec3> points);

/// A disc for each, as posed, as wide as its voxel, in its albedo.
sketch::Sketch surfels_drawing(const transport::TransportNetwork& network);

/// Draws of some surfels, spread over the scene: their disc, and a line to each surfel that cosine rays from
/// it meet, white where many do and blue where few do.
sketch::Sketch links_drawing(const transport::TransportNetwork& network);

}  // namespace ssphh::methods
