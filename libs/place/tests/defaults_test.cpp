/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/place/place.h>

#include "draft.h"

namespace ssphh::place {
namespace {

TEST(Defaults, OfPlacement) {
  const PlaceParams params;
  EXPECT_EQ(params.spacing, 0);
  EXPECT_EQ(params.count, 0);
  EXPECT_EQ(params.clearance, 0.04f);
  EXPECT_EQ(params.levels, 1);
  EXPECT_EQ(params.max_probes, 65536);
  const PlacedProbe probe;
  EXPECT_EQ(probe, (PlacedProbe{"", vec3(0), 0.1f, PlaceKind::grid, 0, 0, 0}));
  EXPECT_EQ(PlacedEdge(), (PlacedEdge{0, 0, false}));
  EXPECT_EQ(PlaceCounts(), (PlaceCounts{0, 0, 0, 0, 0, 0, 0, 0, 0}));
  const Placement placement;
  EXPECT_EQ(placement.origin, vec3(0));
  EXPECT_EQ(placement.spacing, 0);
  EXPECT_EQ(placement.clearance, 0);
  EXPECT_EQ(placement.back_limit, 0);
}

TEST(PlaceCounts, RemovedAreAllButThoseRelocated) {
  const PlaceCounts counts{.candidates = 1,
                           .relocated = 20,
                           .inside = 300,
                           .too_close = 4000,
                           .open_air = 50000,
                           .redundant = 600000,
                           .swept = 7000000,
                           .unreachable = 80000000,
                           .surplus = 900000000};
  EXPECT_EQ(counts.removed(), 987654300u);
}

TEST(PlaceValues, OfPlaces) {
  const Draft draft;
  EXPECT_EQ(draft.position, vec3(0));
  EXPECT_EQ(draft.kind, PlaceKind::grid);
  EXPECT_EQ(draft.spacing, 1);
  EXPECT_EQ(draft.reach, 1);
  EXPECT_EQ(draft.radius, 0);
  const Site site;
  EXPECT_TRUE(std::isinf(site.nearest) && std::isinf(site.harmonic) && std::isinf(site.nearest_back));
  EXPECT_EQ(site.back, 0);
  EXPECT_EQ(site.escaped, 0);
  EXPECT_FALSE(site.emitter);
  EXPECT_EQ(site.nearest_hit, vec3(0));
  EXPECT_EQ(site.nearest_normal, vec3(0));
  EXPECT_EQ(site.nearest_back_hit, vec3(0));
  EXPECT_EQ(SiteRules().clearance, 0.04f);
  EXPECT_EQ(SiteRules().back_limit, 0.25f);
  const Lattice lattice;
  EXPECT_EQ(lattice.origin, vec3(0));
  EXPECT_EQ(lattice.spacing, 1);
  EXPECT_EQ(lattice.size, glm::ivec3(0));
}

}  // namespace
}  // namespace ssphh::place
