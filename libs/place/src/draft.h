#pragma once
/// Places on their way to be probes.

#include <ssphh/geometry/near_grid.h>
#include <ssphh/place/lattice.h>
#include <ssphh/place/place.h>
#include <ssphh/place/site.h>

namespace ssphh::place {

inline constexpr float link_distance = 1.8f;  ///< of neighbours, in spacings: the cube's diagonal

struct Draft {
  std::string name;  ///< of a manual one
  vec3 position{0};
  Site site;
  PlaceKind kind = PlaceKind::grid;
  float spacing = 1;
  float reach = 1;
  float radius = 0;  ///< of a manual one
};

/// What all steps of one placement share.
struct PlaceContext {
  const rays::TransportSource& source;
  const PlaceParams& params;
  const Control& control;
  SiteRules rules;
  float spacing;
};

inline bool inside(const scene::Bounds& box, const vec3& p) {
  return glm::all(glm::greaterThan(p, box.min)) && glm::all(glm::lessThan(p, box.max));
}

/// The manual probes, then the valid places of the grid, relocated where that helps, then those of halved
/// cells. A cell is halved where the harmonic mean distance that a corner sees is under half of its size, or
/// where some corners are no valid places; of the places that this makes only those stay that see so near
/// themselves, or see no other probe within the cell's size (a small room).
std::vector<Draft> grid_drafts(const PlaceContext& context, const Lattice& lattice, PlaceCounts& counts);

/// Moves drafts out of the way of moving parts, or removes them. Manual ones stay.
void clear_sweeps(const PlaceContext& context, std::vector<Draft>& drafts, PlaceCounts& counts);

/// Pairs that are neighbours by distance and see each other, ascending. `moving` is not set.
std::vector<PlacedEdge> link(const PlaceContext& context, const std::vector<Draft>& drafts);

/// Adds probes where an edge leads through a passage: narrower than 1.5 spacings, and at least that much
/// wider at both of the edge's ends.
void add_passages(const PlaceContext& context, std::vector<Draft>& drafts,
                  const std::vector<PlacedEdge>& edges, PlaceCounts& counts);

/// Which drafts are of use: connected by edges to one that sees a place of interest or a shining surface.
/// Where none is, the largest component counts, and every other with a tenth of its size.
std::vector<bool> reachable(const PlaceContext& context, const std::vector<Draft>& drafts,
                            const std::vector<PlacedEdge>& edges);

/// Chooses `count` of the drafts, manual ones first, each next one the farthest along edges from those chosen
/// before; a part of the graph without any comes first.
std::vector<bool> most_spread(const std::vector<Draft>& drafts, const std::vector<PlacedEdge>& edges,
                              std::size_t count);

/// Takes the drafts and edges that `keep` names, indices adapted.
void filter(std::vector<Draft>& drafts, std::vector<PlacedEdge>& edges, const std::vector<bool>& keep);

}  // namespace ssphh::place
