/// Networks of more surfels than are found, linked or gathered from at one go.

#include <algorithm>
#include <atomic>

#include <gtest/gtest.h>

#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/network.h>

#include "ball_room.h"

namespace ssphh::transport {
namespace {

/// Holds that every stage tells of as much as it announced.
struct Sums : Progress {
  void begin(const std::string& name, std::uint64_t units, const std::string&) override {
    stage = name, total = units, done = 0;
    ++stages[name];
  }
  void advance(std::uint64_t count) override { done += count; }
  void end() override { EXPECT_EQ(done, total) << stage; }

  std::string stage;
  std::map<std::string, int> stages;
  std::atomic<std::uint64_t> total = 0, done = 0;
};

TEST(ManySurfels, AreAllLinkedAndAllToldOf) {
  const test::BallRoom room;
  Sums sums;
  std::vector<vec3> positions;
  for (int i = 0; i < 300; ++i) positions.push_back(0.9f * spherical_fibonacci(i, 300));
  TransportNetwork network(room, positions,
                           {.directions = 32, .surfel_size = 0.08f, .link_rays = 4, .samples = 1}, 0.3f,
                           {&sums, nullptr});
  EXPECT_GT(network.surfel_count(), 8192u);
  // The room is closed: from every surfel of the walls all four rays end somewhere.
  std::size_t open = 0;
  for (std::size_t s = 0; s < network.surfel_count(); ++s) {
    if (network.surfels().surfels()[s].part > 0) continue;
    float sum = 0;
    for (const auto links : {network.links().rows[s].fixed, network.links().rows[s].moving})
      for (const Link& link : links) sum += link.weight;
    open += std::abs(sum - 1) > 1e-5f;
  }
  EXPECT_LE(open, network.lost_links());
  network.prepare_poses(2, {&sums, nullptr});
  const std::vector<rays::SurfacePoint> points = surfel_points(network);
  const std::vector<std::int32_t> seen = network.gather(points, 1, {&sums, nullptr});
  EXPECT_EQ(seen.size(), points.size());
  EXPECT_EQ(std::ranges::count(seen, no_surfel), 0);
  EXPECT_GE(sums.stages["finding surfels"], 2);
  EXPECT_GE(sums.stages["linking surfels"], 1);
  for (const char* stage : {"probe G-buffers", "poses", "gathering"})
    EXPECT_EQ(sums.stages[stage], 1) << stage;
}

}  // namespace
}  // namespace ssphh::transport
