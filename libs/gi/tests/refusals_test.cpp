/// What entries of the module refuse, word by word; tests/contracts asks that nothing is left half done.

#include <limits>

#include <gtest/gtest.h>

#include <ssphh/gi/fitted_weights.h>
#include <ssphh/gi/init.h>
#include <ssphh/gi/leak.h>
#include <ssphh/gi/lookup_error.h>
#include <ssphh/gi/lookup_weights.h>
#include <ssphh/gi/nearest.h>
#include <ssphh/gi/session_sets.h>
#include <ssphh/gi/transport/projection.h>
#include <ssphh/gi/transport/solve.h>
#include <ssphh/gi/vct/voxel_grid.h>

#include "error_message.h"
#include "relight_data.h"
#include "unlit_source.h"

namespace ssphh::gi {
namespace {

using test::message_of;

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr float endless = std::numeric_limits<float>::infinity();

TEST(Refusals, OfLookups) {
  const SeesProbe sees = [](const vec3&, const vec3&) { return true; };
  const std::vector<vec3> one{vec3(0)};
  const auto said = [&](std::span<const vec3> at, const SeesProbe& see, const WeightParams& params = {}) {
    return message_of([&] { make_weights(at, see, params, nullptr); });
  };
  EXPECT_EQ(said({}, sees), "probe lookup: the probe set is empty (bake a scene with SPHLs)");
  EXPECT_EQ(said(std::vector<vec3>{vec3(0), vec3(0, none, 0)}, sees),
            "probe lookup: a probe's position is not finite");
  EXPECT_EQ(said(one, nullptr), "probe lookup: nothing tells what sees the probes");
  const std::string lengths = "probe lookup: spacing and normal offset must be lengths";
  for (const float bad : {-0.1f, none, endless}) {
    EXPECT_EQ(said(one, sees, {.method = {}, .spacing = bad}), lengths);
    EXPECT_EQ(said(one, sees, {.method = {}, .normal_offset = bad}), lengths);
  }
  EXPECT_EQ(said(one, sees, {.method = WeightMethod::fitted}),
            "probe lookup: there are no fitted weights (fit some, or choose others)");
  EXPECT_EQ(said(one, sees), "no error");
  EXPECT_EQ(message_of([] { lookup_error(std::vector<vec3>(2), {}); }),
            "lookup error: there is not one lookup for each truth");
  EXPECT_EQ(message_of([] { leak_ratio(std::vector<vec3>(2), {}); }),
            "leak: there is not one lookup for each point");
  EXPECT_EQ(message_of([] {
              NearestPoints(std::vector<vec3>{vec3(0), vec3(endless)});
            }),
            "nearest points: a point is not finite");
  EXPECT_EQ(message_of([] { lookup_set({}, {}); }), "lookup set: there are no probes");
  EXPECT_EQ(message_of([] { lookup_set(std::vector<ProbePlace>(2), {sh::RadianceSh(0)}); }),
            "lookup set: there are 1 functions for 2 probes (a session has light after its first update())");
  PointWeights full;
  for (int i = 0; i < 16; ++i) full.add(i, 1);
  EXPECT_EQ(message_of([&] { full.add(16, 1); }), "list of weights: it is full");
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
  void intersect(int, std::span<const scene::RayQuery>, std::span<scene::RayHit>) const override {}
  void occluded(int, std::span<const scene::RayQuery>, std::span<std::uint8_t>) const override {}
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
  std::vector<ProbePlace> places(3);
  places[0].radius = 0;
  EXPECT_EQ(message_of([&] { check_places(places); }), "no error");
  for (const float bad : {-1.0f, none, endless}) {
    places[2].radius = bad;
    EXPECT_EQ(message_of([&] { check_places(places); }),
              fmt::format("probe 2: its radius {} is no length", bad));
  }
}

TEST(Init, OfAPlacementTakesItsProbes) {
  scene::Scene scene;
  scene.name = std::string(1030, 's');
  Placement placement;
  placement.probes = {{.name = "auto 1", .position = vec3(1, 2, 3), .radius = 0.25f},
                      {.name = std::string(1030, 'n'), .position = vec3(4), .radius = 0.5f}};
  const ProbeSet set = init_from_placement(scene, placement, 3, 1.5f);
  EXPECT_EQ(set.degree, 3);
  EXPECT_EQ(set.generator.time, 1.5f);
  EXPECT_EQ(set.generator.scene, std::string(1024, 's'));
  EXPECT_EQ(set.generator.scene_hash, scene::light_hash(scene));
  ASSERT_EQ(set.probes.size(), 2u);
  EXPECT_EQ(set.probes[0].name, "auto 1");
  EXPECT_EQ(set.probes[0].position, vec3(1, 2, 3));
  EXPECT_EQ(set.probes[0].radius, 0.25f);
  EXPECT_EQ(set.probes[1].name, std::string(1024, 'n'));
  for (const int degree : {-1, 11})
    EXPECT_EQ(message_of([&] { init_from_placement(scene, placement, degree); }),
              fmt::format("degree {}: the degree must be 0..10", degree));
  EXPECT_EQ(message_of([&] { init_from_placement(scene, placement, 10); }), "no error");
  const auto said = [&](const vec3& position, float radius) {
    placement.probes[0] = {.name = "p", .position = position, .radius = radius};
    return message_of([&] { init_from_placement(scene, placement, 0); });
  };
  const std::string finite = "SPHL \"p\": its position must be finite and its radius positive";
  EXPECT_EQ(said(vec3(0, endless, 0), 1), finite);
  for (const float bad : {0.0f, -1.0f, none, endless}) EXPECT_EQ(said(vec3(0), bad), finite);
}

}  // namespace
}  // namespace ssphh::gi
