/// The steps of placement one by one: links, rooms, passages, ways of doors, grids.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/place/sweep.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>

#include "draft.h"
#include "error_message.h"
#include "ray_source.h"
#include "triangle_source.h"

namespace ssphh::place {
namespace {

using test::RaySource;
using test::TriangleSource;

const RaySource empty_space([](const vec3&, const vec3&) { return rays::RayHit{}; });
const PlaceParams no_params;
const Control no_control;

PlaceContext context_of(const rays::TransportSource& source, const PlaceParams& params = no_params) {
  return {source, params, no_control, {0.04f, 0.25f}, 1};
}

std::vector<Draft> drafts_at(const std::vector<vec3>& positions) {
  std::vector<Draft> drafts(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) drafts[i].position = positions[i];
  return drafts;
}

TEST(PlaceLinks, AreThoseOfAllPairsHoweverUnlikeTheirSpacings) {
  Pcg32 rng(5);
  std::vector<Draft> drafts(400);
  for (Draft& draft : drafts) {
    draft.position = vec3(60, 4, 60) * rng.uniform3();
    draft.spacing = std::exp2(6 * rng.uniform() - 2);
  }
  std::vector<PlacedEdge> wanted;
  for (std::uint32_t a = 0; a < drafts.size(); ++a) {
    for (std::uint32_t b = a + 1; b < drafts.size(); ++b) {
      const float limit = link_distance * 0.5f * (drafts[a].spacing + drafts[b].spacing);
      if (glm::distance(drafts[a].position, drafts[b].position) <= limit) wanted.push_back({a, b, false});
    }
  }
  EXPECT_GT(wanted.size(), 1000u);
  EXPECT_EQ(link(context_of(empty_space), drafts), wanted);
}

TEST(PlaceLinks, ReachOneAndEightTenthsOfTheMeanSpacing) {
  for (const float distance : {1.34f, 1.36f}) {
    std::vector<Draft> drafts = drafts_at({{0, 0, 0}, {0, distance, 0}});
    drafts[1].spacing = 0.5f;
    EXPECT_EQ(link(context_of(empty_space), drafts).size(), distance < 1.35f ? 1u : 0u) << distance;
    std::swap(drafts[0], drafts[1]);
    EXPECT_EQ(link(context_of(empty_space), drafts).size(), distance < 1.35f ? 1u : 0u) << distance;
  }
}

TEST(PlaceLinks, WithoutInterestPartsOfATenthOfTheLargestStay) {
  // Three parts of 20, 2 and 1.
  std::vector<vec3> positions;
  for (int i = 0; i < 23; ++i) positions.emplace_back(i + (i < 20 ? 0 : i < 22 ? 10 : 20), 0, 0);
  const std::vector<Draft> drafts = drafts_at(positions);
  const std::vector<bool> keep =
      reachable(context_of(empty_space), drafts, link(context_of(empty_space), drafts));
  EXPECT_EQ(std::count(keep.begin(), keep.end(), true), 22);
  EXPECT_FALSE(keep[22]);
}

TEST(PlaceLinks, OnlyPartsAroundAPlaceOfInterestStay) {
  // Those within 1.8 m of it, and the nearest where there are none.
  const std::vector<Draft> drafts = drafts_at({{0, 0, 0}, {1, 0, 0}, {6, 0, 0}, {9.4f, 0, 0}, {9.4f, 9, 0}});
  const auto kept = [&](const vec3& place) {
    PlaceParams params;
    params.interest = {place};
    const PlaceContext context = context_of(empty_space, params);
    return reachable(context, drafts, link(context, drafts));
  };
  EXPECT_EQ(kept({-7, 0, 0}), (std::vector<bool>{true, true, false, false, false}));
  EXPECT_EQ(kept({7.55f, 0, 0}), (std::vector<bool>{false, false, true, false, false}));
  EXPECT_EQ(kept({7.7f, 0, 0}), (std::vector<bool>{false, false, true, true, false}));
  EXPECT_EQ(kept({7.85f, 0, 0}), (std::vector<bool>{false, false, false, true, false}));
}

/// A room of 6 × 2 `half` × 4 m with a wall of 0.3 m across it, in which a slot of `width` is centred at y =
/// 0.2.
scene::Scene slotted_room(float half, float width) {
  scene::Scene scene;
  scene.nodes.emplace_back();
  scene.meshes = {scene::flipped(scene::make_box({-3, 0.2f - half, -2}, {3, 0.2f + half, 2})),
                  scene::make_box({-0.15f, 0.2f + width / 2, -2}, {0.15f, 0.2f + half, 2}),
                  scene::make_box({-0.15f, 0.2f - half, -2}, {0.15f, 0.2f - width / 2, 2})};
  scene.instances = {{0, 0, -1, ""}, {1, 0, -1, ""}, {2, 0, -1, ""}};
  return scene;
}

std::vector<Draft> with_passages(float half, float width) {
  const TriangleSource source(slotted_room(half, width));
  std::vector<Draft> drafts = drafts_at({{-1, 0.3f, 0}, {1, 0.3f, 0}});
  PlaceCounts counts;
  add_passages(context_of(source), drafts, {{0, 1, false}}, counts);
  return drafts;
}

TEST(Passages, StandInTheMiddleOfWhatIsNarrowerThanOneAndAHalfSpacings) {
  const std::vector<Draft> found = with_passages(2, 1.45f);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[2].kind, PlaceKind::passage);
  EXPECT_NEAR(found[2].position.x, 0, 1e-5f);
  EXPECT_NEAR(found[2].position.y, 0.2f, 1e-5f);
  EXPECT_NEAR(found[2].position.z, 0, 1e-5f);
  EXPECT_NEAR(found[2].reach, 1.45f, 1e-5f);
  EXPECT_EQ(found[2].spacing, 1);
  EXPECT_EQ(with_passages(2, 1.55f).size(), 2u);
}

TEST(Passages, HaveEndsThatAreHalfAgainAsWide) {
  EXPECT_EQ(with_passages(0.77f, 1).size(), 3u);
  EXPECT_EQ(with_passages(0.73f, 1).size(), 2u);
}

TEST(Lattice, OfABareFloorStandsAboveIt) {
  const TriangleSource floor([] {
    scene::Scene scene;
    scene.nodes.emplace_back();
    scene.meshes = {scene::make_quad({0, 1, 0}, {0, 0, 0.5f}, {5, 0, 0})};
    scene.instances = {{0, 0, -1, ""}};
    return scene;
  }());
  const scene::Bounds box = lattice_box(floor, 2);
  EXPECT_EQ(box.min, vec3(0, 1, -0.75f));
  EXPECT_EQ(box.max, vec3(5, 3, 1.25f));
  EXPECT_NEAR(lattice_places(box, 2), 3.5 * 2 * 2, 1e-9);
}

TEST(Lattice, OfNothingThatStandsStillIsRefused) {
  EXPECT_EQ(test::message_of([] { lattice_box(TriangleSource(scene::Scene{}), 1); }),
            "probe placement: the scene has no surface that stands still, so there is no place to look for "
            "(give the scene SPHLs and use --probes scene)");
}

TEST(Lattice, WhereNothingIsNearItIsCentredInItsBoxWhereverThatStands) {
  // A speck far below: all places are as good, and no offset has more than the middle's four along an axis.
  const TriangleSource speck([] {
    scene::Scene scene;
    scene.nodes.emplace_back();
    scene.meshes = {scene::make_quad({0, -900, 0}, {0, 0, 0.1f}, {0.1f, 0, 0})};
    scene.instances = {{0, 0, -1, ""}};
    return scene;
  }());
  const vec3 low(5, 20, -40);
  const Lattice lattice = choose_lattice(speck, {low, low + 3.6f}, 1, {}, {});
  EXPECT_EQ(lattice.size, glm::ivec3(4));
  EXPECT_LT(glm::distance(lattice.origin, low + 0.3f), 1e-4f);
}

TEST(Lattice, OfAFlatHouseStandsInItsRoomsNotAboveTheRoof) {
  // Floor and roof of 40 m by 40, 3 m apart: places 8 m apart are freer above.
  const TriangleSource house([] {
    scene::Scene scene;
    for (const float y : {0.0f, 2.8f}) {
      scene.meshes.push_back(scene::make_box({0, y, 0}, {40, y + 0.2f, 40}));
      scene.instances.push_back({static_cast<int>(scene.instances.size()), 0, -1, ""});
    }
    scene.nodes.emplace_back();
    return scene;
  }());
  const Lattice lattice = choose_lattice(house, house.part_bounds(0), 8, {}, {});
  for (const vec3& place : lattice_points(lattice)) {
    EXPECT_GT(place.y, 0.2f);
    EXPECT_LT(place.y, 2.8f);
  }
}

TEST(Lattice, PlacesFillTheBoxFromAnOffset) {
  const Lattice lattice = make_lattice({vec3(1, 2, 3), vec3(4, 4, 9)}, 2, {0.25f, 0.5f, 0.9f});
  EXPECT_EQ(lattice.size, glm::ivec3(2, 1, 3));
  const std::vector<vec3> points = lattice_points(lattice);
  ASSERT_EQ(points.size(), 6u);
  EXPECT_EQ(points[1], vec3(3.5f, 3, 4.8f));
  EXPECT_EQ(points[5], vec3(3.5f, 3, 8.8f));
}

/// builtin:two-rooms: the leaf, shut at 0 s, fills x 0.075 … 0.115, z ±0.5, y up to 2.15; it turns by 100°
/// about (0.115, −0.5).
class Door : public testing::Test {
 protected:
  TriangleSource source_{scene::make_builtin("two-rooms")};
};

TEST_F(Door, IsPassedNearerThanTheClearanceOrInside) {
  const Sweep shut = Sweep::at(source_, 0);
  // 48 rays find a wall's distance to a few per cent.
  EXPECT_TRUE(shut.passes({0.165f, 1, 0}, 0.055f));
  EXPECT_FALSE(shut.passes({0.165f, 1, 0}, 0.048f));
  ASSERT_NE(shut.passes({0.095f, 1, 0}, 1e-3f), nullptr) << "within the leaf";
  EXPECT_FALSE(shut.passes({0.165f, 2.3f, 0}, 0.1f)) << "above it";
}

TEST_F(Door, PassesEveryPlaceOnItsWay) {
  // Poses 4 cm apart, a leaf of 4 cm: nothing is left between.
  const Sweep sweep(source_, 0.04f);
  for (float degrees = 3; degrees < 98; degrees += 0.5f) {
    const float a = glm::radians(degrees);
    EXPECT_TRUE(sweep.passes(vec3(0.115f + 0.9f * std::sin(a), 1.1f, -0.5f + 0.9f * std::cos(a)), 0.01f))
        << degrees;
  }
}

TEST_F(Door, SeparatesPlacesWhenItIsShut) {
  const vec3 a(-0.5f, 1, 0), b(0.5f, 1, 0);
  EXPECT_TRUE(Sweep::at(source_, 0).separates(a, b));
  EXPECT_FALSE(Sweep::at(source_, source_.duration()).separates(a, b));
  EXPECT_TRUE(Sweep(source_, 0.04f).separates(a, b)) << "at some time";
  EXPECT_FALSE(Sweep(source_, 0.04f).separates(a, a + vec3(0, 1, 0)));
}

}  // namespace
}  // namespace ssphh::place
