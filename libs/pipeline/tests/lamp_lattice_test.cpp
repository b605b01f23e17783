// Where lamps may be moved to, and of which places their light is blended there.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/pipeline/lamp_lattice.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

#include "error_message.h"
#include "number_list.h"
#include "scene_text.h"

namespace ssphh::pipeline {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Room A of two-rooms is x −4.075…−0.075, y 0…3, z −2…2; its door is shut at 0 s and open at 1 s.
const vec3 home(-2.4f, 2.5f, 0.5f);

class LampLatticeTest : public testing::Test {
 protected:
  LampLattice lattice(std::vector<float> times, const LampLatticeParams& params = {}) const {
    return lamp_lattice(source_, times, home, params);
  }
  /// Middles of the boxes that the lamp may be in.
  static std::vector<vec3> middles(const LampLattice& lattice) {
    std::vector<vec3> out;
    for (int z = 0, i = 0; z < lattice.boxes.z; ++z)
      for (int y = 0; y < lattice.boxes.y; ++y)
        for (int x = 0; x < lattice.boxes.x; ++x, ++i)
          if (lattice.seen[static_cast<std::size_t>(i)] != 0)
            out.push_back(lattice.origin + lattice.box * (vec3(x, y, z) + 0.5f));
    return out;
  }
  static float sum(const std::array<LampShare, 8>& shares) {
    float all = 0;
    for (const LampShare& share : shares) all += share.weight;
    return all;
  }

  const scene::Scene scene_ = scene::make_builtin("two-rooms");
  const trace::TransportScene source_{scene_};
};

TEST_F(LampLatticeTest, NoPlaceIsInAWallOrBehindADoorThatIsEverShut) {
  const LampLatticeParams far{.reach = 5};
  const LampLattice shut = lattice({0, 1}, far);
  ASSERT_GT(shut.places.size(), 20u);
  const auto in_room_a = [](const vec3& at, float margin) {
    return at.x > -4.075f + margin && at.x < -0.075f - margin && at.y > margin && at.y < 3 - margin &&
           std::abs(at.z) < 2 - margin;
  };
  for (const vec3& place : shut.places) EXPECT_TRUE(in_room_a(place, 0.01f)) << place.x << ' ' << place.y;
  for (const vec3& at : middles(shut)) EXPECT_TRUE(in_room_a(at, shut.box / 2)) << at.x << ' ' << at.y;

  // Open, it leads into room B; nowhere does it lead through the wall beside it.
  const LampLattice open = lattice({1}, far);
  bool other_room = false;
  for (const vec3& at : middles(open)) {
    other_room = other_room || at.x > 0.2f;
    const bool in_wall = std::abs(at.x) < 0.075f, in_doorway = std::abs(at.z) < 0.45f && at.y < 2.1f;
    EXPECT_TRUE(!in_wall || in_doorway) << at.y << ' ' << at.z;
  }
  EXPECT_TRUE(other_room);
}

TEST_F(LampLatticeTest, SharesAreOfPlacesThatAreSeenAndAddUpToOne) {
  const LampLattice l = lattice({1}, {.reach = 5});
  const rays::PosedWorld world(source_, 1);
  const std::vector<vec3> all = middles(l);
  ASSERT_GT(all.size(), 1000u);
  for (const vec3& middle : all) {
    EXPECT_NEAR(sum(lamp_shares(l, middle)), 1, 1e-6f);
    for (const LampShare& share : lamp_shares(l, middle + vec3(0.3f, -0.2f, 0.1f) * l.box)) {
      if (share.place < 0) continue;
      EXPECT_GE(share.weight, 0);
      EXPECT_TRUE(world.visible(middle, l.places[static_cast<std::size_t>(share.place)]));
    }
  }
  EXPECT_EQ(sum(lamp_shares(l, vec3(0, 2.5f, 1))), 0);  // in the wall
  EXPECT_EQ(sum(lamp_shares(l, vec3(100, 0, 0))), 0);
  EXPECT_EQ(sum(lamp_shares(l, vec3(std::numeric_limits<float>::quiet_NaN()))), 0);
}

TEST_F(LampLatticeTest, AtAPlaceItAloneCounts) {
  const LampLattice l = lattice({0});
  std::size_t inside = 0;
  for (std::size_t p = 0; p < l.places.size(); ++p) {
    // On the border of several boxes rounding chooses one, which the lamp may not be in.
    const auto shares = lamp_shares(l, l.places[p]);
    if (sum(shares) == 0) continue;
    ++inside;
    for (const LampShare& share : shares) {
      EXPECT_NEAR(share.weight, share.place == static_cast<std::int32_t>(p) ? 1 : 0, 1e-5f);
    }
  }
  EXPECT_GT(inside, l.places.size() / 2);
  const auto near_home = [](const vec3& place) { return glm::distance(place, home) < 1e-5f; };
  EXPECT_EQ(std::ranges::count_if(l.places, near_home), 1);
}

TEST_F(LampLatticeTest, SharesFollowALinearFieldWhereAllCornersAreSeen) {
  const LampLattice l = lattice({0});
  const auto field = [](const vec3& at) { return 3 + glm::dot(at, vec3(1, -2, 0.5f)); };
  std::size_t asked = 0;
  for (const vec3& middle : middles(l)) {
    const vec3 at = middle + vec3(-0.3f, 0.4f, 0.2f) * l.box;
    float blended = 0;
    int corners = 0;
    for (const LampShare& share : lamp_shares(l, at)) {
      if (share.place < 0) continue;
      ++corners;
      blended += share.weight * field(l.places[static_cast<std::size_t>(share.place)]);
    }
    if (corners < 8) continue;
    ++asked;
    EXPECT_NEAR(blended, field(at), 1e-4f);
  }
  EXPECT_GT(asked, 1000u);
}

TEST_F(LampLatticeTest, IsAsTheListHasIt) {
  test::NumberList list;
  const auto add = [&](const char* name, const std::vector<float>& times, const LampLatticeParams& params) {
    const LampLattice l = lattice(times, params);
    std::array<int, 9> seen{};  // boxes that see a corner, and any
    for (const std::uint8_t bits : l.seen) {
      for (int c = 0; c < 8; ++c) seen[static_cast<std::size_t>(c)] += bits >> c & 1;
      seen[8] += bits != 0;
    }
    list.add(name, l.origin, l.box, l.boxes, std::string_view("seen"), seen);
    for (const std::vector<int>& planes : l.planes) list.add("  planes", planes);
    list.add("  places", l.places);
    list.add("  place of", l.place_of);
    for (int i = 0; i < 24; ++i) {
      const vec3 at =
          home +
          params.reach *
              (2.0f * vec3(test::weight(3 * i), test::weight(3 * i + 1), test::weight(3 * i + 2)) - 1.0f);
      const auto shares = lamp_shares(l, at);
      std::vector<float> text;
      for (const LampShare& share : shares)
        if (share.place >= 0) text.push_back(static_cast<float>(share.place)), text.push_back(share.weight);
      if (!text.empty()) list.add("  shares", at, std::string_view(":"), text);
    }
  };
  add("usual", {0, 1}, {.reach = 1.2f});
  add("wide", {0, 1}, {.spacing = 3, .reach = 1.1f});
  add("a ball", {0}, {.spacing = 0.9f, .reach = 1.3f, .radius = 0.25f});
  list.expect("libs/pipeline/tests/expected/lamp-lattice.txt");
}

TEST_F(LampLatticeTest, HasNoMorePlacesThanTheMost) {
  // 2 ⌈reach / spacing⌉ + 1 along each axis: 15³ = 3375 are few enough, 17³ = 4913 are not.
  EXPECT_EQ(test::message_of([&] { lattice({0}, {.spacing = 5, .reach = 35}); }), "no error");
  EXPECT_EQ(test::message_of([&] { lattice({0}, {.spacing = 5, .reach = 35.1f}); }),
            "lattice of a lamp: places 5 m apart as far as 35.1 m are 4913, and 4096 is the most (set them "
            "farther apart, or reach less far)");
}

TEST_F(LampLatticeTest, SaysWhatCannotBe) {
  const auto said = [&](const std::vector<float>& times, const LampLatticeParams& params,
                        const vec3& place = home) {
    return test::message_of([&] { lamp_lattice(source_, times, place, params); });
  };
  EXPECT_THAT(said({0}, {.spacing = 1e-3f}),
              AllOf(HasSubstr("4096 is the most"), HasSubstr("farther apart")));
  const std::string of = "lattice of a lamp: ";
  EXPECT_EQ(said({0}, {.spacing = 100, .reach = 500}),
            of + "there is no free space around it: it cannot be moved");
  for (const float bad : {0.0f, -1.0f, NAN, INFINITY}) {
    EXPECT_EQ(said({0}, {.spacing = bad}), of + "its spacing must be over 0 m");
    EXPECT_EQ(said({0}, {.reach = bad}), of + "its reach must be over 0 m");
    if (bad == 0) continue;
    EXPECT_EQ(said({0}, {.radius = bad}), of + "its radius must not be negative");
  }
  EXPECT_EQ(said({}, {}), of + "it needs a place and a time");
  EXPECT_EQ(said({0}, {}, vec3(0, NAN, 0)), of + "it needs a place and a time");
}

}  // namespace
}  // namespace ssphh::pipeline
