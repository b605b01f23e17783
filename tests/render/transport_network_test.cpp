/// Links and sight of TransportNetwork over Embree: closed forms, reciprocity, poses, shut doors.

#include <algorithm>
#include <array>
#include <map>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/transport/network.h>

#include "transport_fixtures.h"
#include "z_test.h"

namespace ssphh::test {
namespace {

using transport::TransportNetwork;
using transport::TransportParams;

double row_sum(const transport::LinkRows::Row& row) {
  double sum = 0;
  for (const transport::Link& link : row.fixed) sum += double(link.weight);
  for (const transport::Link& link : row.moving) sum += double(link.weight);
  return sum;
}

/// Σ_{i ∈ from} A_i Σ_{j ∈ to} F_ij as a share of all area, with its variance.
struct Exchange {
  double value = 0, variance = 0;
};

/// Area of each surfel by points spread over walls: share of the points that find() gives it.
struct Areas {
  std::vector<double> area;
  std::vector<int> group;  ///< of the walls' points; −1: none
  double lost = 0, total = 0;

  Areas(const TransportNetwork& network) : area(network.surfel_count()), group(area.size(), -1) {}

  void add(const TransportNetwork& network, const Walls& walls, int wall, int group_of_wall, int points) {
    Pcg32 random(static_cast<std::uint64_t>(wall + 17 * group_of_wall));
    for (int i = 0; i < points; ++i) {
      const int s = network.find(0, walls.at(wall, random.uniform2()));
      const double share = walls.area(wall) / points;
      total += share;
      if (s == transport::no_patch) {
        lost += share;
        continue;
      }
      const std::size_t surfel = network.surfel_of(static_cast<std::size_t>(s));
      area[surfel] += share;
      group[surfel] = group_of_wall;
    }
  }

  Exchange exchange(const TransportNetwork& network, int from, int to) const {
    Exchange e;
    for (std::size_t s = 0; s < area.size(); ++s) {
      if (group[s] != from) continue;
      double f = 0;
      for (const auto links : {network.links().rows[s].fixed, network.links().rows[s].moving}) {
        for (const transport::Link& link : links)
          f += group[network.surfel_of(link.patch)] == to ? double(link.weight) : 0;
      }
      e.value += area[s] * f;
      // Rays of a surfel are spread evenly; as many independent ones would have more variance.
      e.variance += area[s] * area[s] * f * (1 - f) / network.params().link_rays;
    }
    return e;
  }
};

TEST(TransportNetworkLinks, WallsOfACubeHaveTheFormFactorsOfSquares) {
  const scene::Scene scene = scene::make_builtin("box");
  const trace::TransportScene source(scene);
  TransportParams params = small_network();
  params.link_rays = 256;
  params.surfel_size = 0.25f;
  const TransportNetwork network(source, positions_of(places_of(scene)), params);
  Areas areas(network);
  for (int wall = 0; wall < 6; ++wall) areas.add(network, {vec3(-1), vec3(1)}, wall, wall, 4000);
  EXPECT_EQ(areas.lost, 0);
  for (const transport::LinkRows::Row& row : network.links().rows) EXPECT_NEAR(row_sum(row), 1, 1e-6);
  // Opposite and adjacent faces of a cube (Howell, A Catalog of Radiation Configuration Factors, C-11, C-14).
  const double opposite =
      2 / pi_d * (0.5 * std::log(4 / 3.0) + 2 * std::sqrt(2.0) * std::atan(std::sqrt(0.5)) - pi_d / 2);
  const double adjacent = (1 - opposite) / 4;
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b < 6; ++b) {
      const double expected = a == b ? 0 : a / 2 == b / 2 ? opposite : adjacent;
      const Exchange e = areas.exchange(network, a, b);
      EXPECT_TRUE(difference_is_noise(e.value / 4 - expected, e.variance / 16, {1e-3, 36}, 1e-6)) << a << b;
    }
  }
}

TEST(TransportNetworkLinks, LightFlowsAsWellFromAToBAsBack) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  TransportParams params = small_network();
  params.link_rays = 256;
  const TransportNetwork network(source, positions_of(places_of(scene)), params, 1);
  Areas areas(network);
  for (int wall = 0; wall < 6; ++wall) {
    areas.add(network, {{-4.075f, 0, -2}, {-0.075f, 3, 2}}, wall, 0, 3000);
    areas.add(network, {{0.075f, 0, -2}, {4.075f, 3, 2}}, wall, 1, 3000);
  }
  const Exchange there = areas.exchange(network, 0, 1), back = areas.exchange(network, 1, 0);
  EXPECT_GT(there.value, 0.5) << "m², through a door of 1.9 m²";
  EXPECT_TRUE(difference_is_noise(there.value - back.value, there.variance + back.variance, {1e-3, 1}, 0));
}

/// What a network answers, without its history.
struct Answers {
  std::vector<transport::SeenPatch> seen;
  std::vector<float> distance;
  std::vector<std::uint16_t> emission;
  std::vector<std::uint8_t> used;
  std::vector<vec3> samples;
  std::vector<std::vector<std::pair<std::uint32_t, float>>> fixed, moving;
  std::size_t lost;

  explicit Answers(const TransportNetwork& n)
      : seen(n.seen()),
        distance(n.seen_distance()),
        emission(n.seen_emission()),
        used(n.sample_used()),
        lost(n.lost_links()) {
    for (const rays::SurfacePoint& p : n.samples()) samples.insert(samples.end(), {p.position, p.normal});
    const auto copy = [](std::span<const transport::Link> links) {
      std::vector<std::pair<std::uint32_t, float>> out;
      for (const transport::Link& link : links) out.emplace_back(link.patch, link.weight);
      return out;
    };
    for (const transport::LinkRows::Row& row : n.links().rows)
      fixed.push_back(copy(row.fixed)), moving.push_back(copy(row.moving));
  }
};

/// Field by field, so that a failure says which.
void expect_same(const Answers& a, const Answers& b, const std::string& what) {
  EXPECT_TRUE(a.seen == b.seen) << what;
  EXPECT_TRUE(a.distance == b.distance) << what;
  EXPECT_TRUE(a.emission == b.emission) << what;
  EXPECT_TRUE(a.used == b.used) << what;
  EXPECT_TRUE(a.samples == b.samples) << what;
  EXPECT_TRUE(a.fixed == b.fixed) << what;
  EXPECT_TRUE(a.moving == b.moving) << what;
  EXPECT_EQ(a.lost, b.lost) << what;
}

TEST(TransportNetwork, TheUndersideOfADoorThatStandsOnTheFloorIsLeftOut) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  TransportNetwork network(source, positions_of(places_of(scene)), small_network());
  for (const float time : {0.0f, 0.3f, 1.0f}) {
    network.set_time(time);
    // Half open, a few end where no surfel is seen: under 0.05 %.
    EXPECT_LE(network.lost_links(), time == 0.3f ? network.surfel_count() * 64 / 2000 : 0) << time;
    // The underside of the leaf, which touches the floor, is of no use; the rest is.
    std::size_t under = 0, used = 0;
    for (std::size_t i = 0; i < network.samples().size(); ++i) {
      if (!network.sample_exists(i)) continue;
      const bool down = network.samples()[i].normal.y < -0.9f && network.samples()[i].position.y < 1e-3f &&
                        network.samples()[i].position.y > -1e-3f;
      under += down;
      used += down && network.sample_used()[i];
    }
    EXPECT_GT(under, 0u);
    EXPECT_EQ(used, 0u) << time;
  }
}

/// A room with a turning panel that almost touches the floor and a glowing box that slides and grows.
scene::Scene workshop() {
  scene::Scene scene;
  const vec3 grey(0.6f);
  add_body(scene, "room", scene::flipped(scene::make_box(vec3(-1.5f), vec3(1.5f))), grey);
  const int panel = add_body(scene, "panel", scene::make_box({0, -1.49f, -0.02f}, {1, 0.8f, 0.02f}), grey);
  const int lamp = add_body(scene, "lamp", scene::make_box(vec3(-0.2f), vec3(0.2f)), grey, vec3(2));
  scene::Animation& animation = scene.animations.emplace_back();
  using scene::AnimationPath, scene::Interpolation;
  animation.channels.push_back({panel,
                                AnimationPath::rotation,
                                Interpolation::linear,
                                {0, 1, 2},
                                {{0, 0, 0, 1}, {0, 0.707f, 0, 0.707f}, {0, 1, 0, 0}}});
  animation.channels.push_back({lamp,
                                AnimationPath::translation,
                                Interpolation::linear,
                                {0, 2},
                                {{-0.8f, -1.2f, 0, 0}, {0.8f, -0.9f, 0.9f, 0}}});
  animation.channels.push_back(
      {lamp, AnimationPath::scale, Interpolation::linear, {0, 2}, {{1, 1, 1, 0}, {1.3f, 0.7f, 1, 0}}});
  add_sphl(scene, "left", {-0.7f, 0.5f, -0.6f});
  add_sphl(scene, "right", {0.9f, 0.2f, 0.7f});
  add_sphl(scene, "low", {0.1f, -1.3f, 1.2f});
  scene::validate(scene);
  return scene;
}

void history_leaves_no_trace(const scene::Scene& scene, float end) {
  const trace::TransportScene source(scene);
  const std::vector<vec3> positions = positions_of(places_of(scene));
  TransportParams params = small_network();
  params.link_rays = 32;
  params.directions = 128;
  const std::vector<float> walk{0, end, 0.31f * end, 0.3f * end, 0, 0.77f * end, 0.5f * end, end};
  set_thread_count(2);
  TransportNetwork walker(source, positions, params, 0.6f * end);
  bool anything_moved = false;
  for (std::size_t step = 0; step < walk.size(); ++step) {
    set_thread_count(1 + static_cast<int>(step) % 2);
    const transport::PoseReport report = walker.set_time(walk[step]);
    anything_moved |= report.hits_changed > 0;
    set_thread_count(1 + static_cast<int>(step / 2) % 2);
    const TransportNetwork fresh(source, positions, params, walk[step]);
    expect_same(Answers(walker), Answers(fresh), "at " + std::to_string(walk[step]) + " s");
    EXPECT_EQ(walker.set_time(walk[step]).hits_changed, 0u) << "nothing changes twice";
  }
  set_thread_count(0);
  EXPECT_TRUE(anything_moved);
}

TEST(TransportNetworkPose, ADoorsHistoryLeavesNoTrace) {
  history_leaves_no_trace(scene::make_builtin("two-rooms"), 1);
}

TEST(TransportNetworkPose, HistoryOfPartsThatTurnSlideGrowAndGlowLeavesNoTrace) {
  history_leaves_no_trace(workshop(), 2);
}

TEST(TransportNetworkPose, PartsThatGlowAreSeenWhereTheyAre) {
  const scene::Scene scene = workshop();
  const trace::TransportScene source(scene);
  TransportParams params = small_network();
  params.directions = 4096;
  TransportNetwork network(source, positions_of(places_of(scene)), params);
  for (const float time : {0.0f, 2.0f}) {
    network.set_time(time);
    const scene::Bounds box = network.part_world_bounds(2);
    std::size_t glowing = 0;
    for (std::size_t i = 0; i < network.seen_emission().size(); ++i) {
      if (network.seen_emission()[i] == 0) continue;
      ++glowing;
      const std::size_t probe = i / 4096, q = i % 4096;
      const vec3 hit =
          network.gbuffer().positions[probe] + network.seen_distance()[i] * network.gbuffer().directions[q];
      EXPECT_TRUE(glm::all(glm::greaterThan(hit, box.min - 1e-4f)) &&
                  glm::all(glm::lessThan(hit, box.max + 1e-4f)));
      EXPECT_EQ(network.palette()[network.seen_emission()[i]].radiance, vec3(2));
    }
    EXPECT_GT(glowing, 50u);
  }
}

enum class Place { room_a, room_b, hollow };

/// Where a surface point of two-rooms with its door shut lies: the leaf stands on room B's side of the wall,
/// 0.075 < x < 0.115; the doorway belongs to A; within the walls and under the floor is hollow.
Place place_of(const rays::SurfacePoint& p) {
  const vec3 x = p.position + 1e-3f * p.normal;
  const auto inside = [&](const vec3& low, const vec3& high) {
    return glm::all(glm::greaterThan(x, low)) && glm::all(glm::lessThan(x, high));
  };
  if (inside({-4.075f, 0, -2}, {-0.075f, 3, 2})) return Place::room_a;
  if (inside({-0.0751f, 0, -0.45f}, {0.0751f, 2.1f, 0.45f})) return Place::room_a;
  if (inside({0.075f, 0, -2}, {4.075f, 3, 2})) return Place::room_b;
  return Place::hollow;
}

TEST(TransportNetworkPose, NothingCrossesAShutDoor) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  std::vector<vec3> positions;
  for (int i = 0; i < 32; ++i)
    positions.push_back({-3.6f + 1.03f * static_cast<float>(i % 8),
                         0.4f + 2.1f * static_cast<float>(i / 8 % 2),
                         -1.3f + 2.5f * static_cast<float>(i / 16)});
  positions.push_back({-0.05f, 1.2f, 0});
  for (const float size : {0.22f, 0.5f, 1.0f}) {
    TransportParams params = small_network();
    params.surfel_size = size;
    // Built with the door open: what the pose must then cut.
    TransportNetwork network(source, positions, params, 1);
    const auto crossings = [&] {
      std::vector<Place> places;
      for (std::size_t s = 0; s < network.surfel_count(); ++s) {
        const transport::Surfel& surfel = network.surfels().surfels()[s];
        const vec3 at(network.poses()[surfel.part] * vec4(surfel.point.position, 1));
        places.push_back(place_of({at, surfel.point.normal}));
      }
      std::size_t count = 0;
      for (std::size_t s = 0; s < places.size(); ++s) {
        for (const auto links : {network.links().rows[s].fixed, network.links().rows[s].moving})
          count += static_cast<std::size_t>(std::count_if(
              links.begin(), links.end(),
              [&](const transport::Link& l) { return places[network.surfel_of(l.patch)] != places[s]; }));
        for (int i = 0; i < params.samples; ++i) {
          const std::size_t sample =
              s * static_cast<std::size_t>(params.samples) + static_cast<std::size_t>(i);
          count += network.sample_used()[sample] && place_of(network.samples()[sample]) != places[s];
        }
      }
      for (std::size_t i = 0; i < network.seen().size(); ++i) {
        const int s = network.seen()[i].index;
        const Place of_probe =
            positions[i / network.gbuffer().directions.size()].x < 0 ? Place::room_a : Place::room_b;
        count +=
            s != transport::no_patch && places[network.surfel_of(static_cast<std::size_t>(s))] != of_probe;
      }
      return count;
    };
    EXPECT_GT(crossings(), 300u) << "door open";
    network.set_time(0);
    EXPECT_EQ(crossings(), 0u) << "door shut, surfels of " << size << " m";
  }
}

TEST(TransportNetworkPose, ContractionBoundsTheFirstAndTheLastPose) {
  for (const bool backward : {false, true}) {
    scene::Scene rooms = scene::make_builtin("two-rooms");
    for (scene::AnimationChannel& channel : rooms.animations[0].channels)
      if (backward) std::ranges::reverse(channel.values);
    const trace::TransportScene source(rooms);
    transport::TransportNetwork network(source, scene::positions_of(test::places_of(rooms)),
                                        test::small_network(), 0.3f);
    const Contraction bounds = network.contraction();
    network.set_time(0);
    const Contraction first = transport::contraction(network.links(), network.albedo());
    network.set_time(source.duration());
    const Contraction last = transport::contraction(network.links(), network.albedo());
    EXPECT_NE(first.upper, last.upper);
    EXPECT_EQ(bounds.lower, std::min(first.lower, last.lower));
    EXPECT_EQ(bounds.upper, std::max(first.upper, last.upper));
  }
}

TEST(TransportNetworkErrors, SayWhatIsWrong) {
  const scene::Scene scene = scene::make_builtin("box");
  const trace::TransportScene source(scene);
  const std::vector<vec3> centre{vec3(0)};
  EXPECT_THROW(TransportNetwork(source, {}, {}), Error);
  EXPECT_THROW(TransportNetwork(source, std::vector<vec3>{vec3(NAN, 0, 0)}, {}), Error);
  const auto with = [](auto change) {
    TransportParams params;
    change(params);
    return params;
  };
  for (const TransportParams& params :
       {with([](TransportParams& p) { p.directions = 7; }), with([](TransportParams& p) { p.link_rays = 3; }),
        with([](TransportParams& p) { p.samples = 0; }), with([](TransportParams& p) { p.samples = 33; }),
        with([](TransportParams& p) { p.surfel_size = -1; }),
        with([](TransportParams& p) { p.surfel_size = NAN; })})
    EXPECT_THROW(TransportNetwork(source, centre, params), Error);

  // Below an open scene there is nothing to see.
  const scene::Scene plain = scene::make_builtin("furnace");
  const trace::TransportScene open(plain);
  TransportParams few;
  few.directions = 8;
  EXPECT_THROW(TransportNetwork(open, std::vector<vec3>{vec3(0, 1e4f, 0)}, few), Error);
}

}  // namespace
}  // namespace ssphh::test
