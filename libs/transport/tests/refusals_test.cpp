/// What entries of the module refuse, word by word; tests/contracts asks that nothing is left half done.

#include <gtest/gtest.h>

#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/projection.h>
#include <ssphh/transport/session_sets.h>
#include <ssphh/transport/solve.h>

#include "error_message.h"
#include "relight_data.h"
#include "unlit_source.h"

namespace ssphh::transport {
namespace {

using test::message_of;

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr float endless = std::numeric_limits<float>::infinity();

TEST(Refusals, OfLookupSets) {
  EXPECT_EQ(message_of([] { lookup_set({}, {}); }), "lookup set: there are no probes");
  EXPECT_EQ(message_of([] { lookup_set(std::vector<scene::ProbePlace>(2), {sh::RadianceSh(0)}); }),
            "lookup set: there are 1 functions for 2 probes (a session has light after its first update())");
}

TEST(Refusals, OfSolvers) {
  LinkRows rows;
  rows.rows.resize(2);
  const std::vector<Irradiance4> two(2), three(3);
  std::vector<Irradiance4> out(2);
  const std::string sizes = ": sizes differ from the number of rows";
  EXPECT_EQ(message_of([&] { bounce_once(rows, three, out); }), "bounce" + sizes);
  out.resize(1);
  EXPECT_EQ(message_of([&] { bounce_once(rows, two, out); }), "bounce" + sizes);
  const std::vector<vec3> albedo(2), single(1);
  std::vector<Irradiance4> found;
  EXPECT_EQ(message_of([&] { Solver().solve(rows, albedo, three, 0.5, {}, found); }), "solver" + sizes);
  EXPECT_EQ(message_of([&] { Solver().solve(rows, single, two, 0.5, {}, found); }), "solver" + sizes);
  EXPECT_EQ(message_of([&] { Solver().solve(rows, albedo, two, 0.5, {}, found); }), "no error");
  const std::string matching = "least squares: rows, targets and prior are not of matching sizes";
  const std::vector<double> values(6, 1);
  EXPECT_EQ(message_of([&] { fit_non_negative(values, std::vector<double>(3), {}, 0.1); }), matching);
  EXPECT_EQ(message_of([&] { fit_non_negative(values, std::vector<double>(2), std::vector<double>(2), 1); }),
            matching);
}

TEST(Refusals, OfProjections) {
  EXPECT_EQ(message_of([] { DirectionProjector(1, {}); }), "projection of probes: there are no directions");
  const DirectionProjector projector(1, std::vector<vec3>{{0, 0, 1}, {0, 1, 0}});
  const std::vector<float> right(3 * projector.stride()), wrong(3 * projector.stride() - 1);
  const std::string size = "projection of probes: radiance or function are not of the projector's size";
  sh::RadianceSh first(1), second(2);
  EXPECT_EQ(message_of([&] { projector.project(wrong, first); }), size);
  EXPECT_EQ(message_of([&] { projector.project(right, second); }), size);
  EXPECT_EQ(message_of([&] { projector.project(right, first); }), "no error");
}

/// Says of its one light and its environment whatever groups it is told to; there are two.
class Grouped final : public test::UnlitSource {
 public:
  int light = 0, environment = -1;

  const std::vector<std::string>& light_groups() const override { return groups_; }
  int light_group_of(int) const override { return light; }
  int environment_group() const override { return environment; }
  int part_count() const override { return 1; }
  const std::string& part_name(int) const override { return groups_[0]; }
  scene::Bounds part_bounds(int) const override { return {}; }
  float duration() const override { return 0; }
  mat4 part_pose(int, float) const override { return mat4(1); }
  void intersect(int, std::span<const rays::RayQuery>, std::span<rays::RayHit>) const override {}
  void occluded(int, std::span<const rays::RayQuery>, std::span<std::uint8_t>) const override {}
  std::uint64_t rays_traced() const override { return 0; }

 private:
  std::vector<std::string> groups_ = {"a", "b"};
};

TEST(Refusals, OfSourcesThatContradictThemselves) {
  Grouped source;
  const auto said = [&](std::size_t lights) { return message_of([&] { check_source(source, lights); }); };
  for (const auto& [light, environment] : {std::pair{0, -1}, {1, 0}, {0, 1}}) {
    source.light = light, source.environment = environment;
    EXPECT_EQ(said(1), "no error") << light << " " << environment;
  }
  for (const int light : {-1, 2}) {
    source.light = light;
    EXPECT_EQ(said(1), "transport source: a light is of a group that there is not");
    EXPECT_EQ(said(0), "no error") << "without lights nothing is asked";
  }
  source.light = 0;
  for (const int environment : {-2, 2}) {
    source.environment = environment;
    EXPECT_EQ(said(1), "transport source: the environment is of a group that there is not");
  }
}

TEST(Refusals, OfPlacesWithoutARadius) {
  std::vector<scene::ProbePlace> places(3);
  places[0].radius = 0;
  EXPECT_EQ(message_of([&] { check_places(places); }), "no error");
  for (const float bad : {-1.0f, none, endless}) {
    places[2].radius = bad;
    EXPECT_EQ(message_of([&] { check_places(places); }),
              fmt::format("probe 2: its radius {} is no length", bad));
  }
}

}  // namespace
}  // namespace ssphh::transport
