// Light through a shut door: none with visible probes only, some percent without.

#include <gtest/gtest.h>

#include <ssphh/probes/lookup.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/study/leak.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/relight_session.h>

#include "lit_session.h"

namespace ssphh {
namespace {

/// builtin:two-rooms with probes on a 0.7 m grid in both rooms, lit by surfels.
class TwoRooms : public testing::Test {
 protected:
  static std::vector<scene::ProbePlace> grid() {
    std::vector<scene::ProbePlace> places;
    for (const float x0 : {-4.075f, 0.075f}) {
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 4; ++j) {
          for (int k = 0; k < 6; ++k) {
            const vec3 cell(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f,
                            static_cast<float>(k) + 0.5f);
            places.push_back({"p", vec3(x0, 0, -2) + cell * vec3(4.0f / 6, 3.0f / 4, 4.0f / 6)});
          }
        }
      }
    }
    return places;
  }

  probes::ProbeSet lit(float time) const {
    transport::RelightParams coarse;
    coarse.transport.surfel_size = 0.2f;
    test::LitSession session(source, places, coarse, time);
    session.update();
    probes::ProbeSet set;
    set.degree = 4;
    set.light_groups.push_back({"lamp"});
    for (std::size_t i = 0; i < places.size(); ++i) {
      probes::Probe& probe = set.probes.emplace_back();
      probe.position = places[i].position;
      probe.groups.push_back({{}, session.reflected()[i]});
    }
    probes::merge_groups(set);
    return set;
  }

  std::vector<rays::SurfacePoint> points(float time) const {
    std::vector<vec3> positions;
    for (const scene::ProbePlace& place : places) positions.push_back(place.position);
    return study::reachable_points(source, positions, time, {400, 1});
  }

  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source{scene};
  const std::vector<scene::ProbePlace> places = grid();
  const study::LeakParams params{.path = {.max_depth = 25, .passes = 1, .spp = 64, .seed = 1}};
};

/// While the door is shut; what lookups differ in is asked of one set, at the same points.
class ShutRooms : public TwoRooms {
 protected:
  struct Known {
    probes::ProbeSet set;
    std::vector<rays::SurfacePoint> points;
    study::TruthAtPoints truth;
  };
  const Known& known() const {
    static const Known once = [&] {
      std::vector<rays::SurfacePoint> at = points(0);
      study::TruthAtPoints truth = study::trace_truth(tracer, at, params);
      return Known{lit(0), std::move(at), std::move(truth)};
    }();
    return once;
  }

  const trace::PathTracer tracer{scene, 0};
};

TEST_F(ShutRooms, LeakNothing) {
  // Half of the surface belongs to room B, whose every point is dark: within five standard deviations.
  EXPECT_NEAR(static_cast<double>(known().truth.dark), 200, 5 * 10);
  for (const auto method :
       {probes::WeightMethod::distance, probes::WeightMethod::trilinear, probes::WeightMethod::mls}) {
    probes::LookupParams lookup;
    lookup.weights.method = method;
    const std::vector<vec3> found =
        study::look_up(probes::IrradianceLookup(known().set, tracer, lookup), known().points);
    EXPECT_LE(study::leak_ratio(found, known().truth), 1e-5) << name_of(method);
    double sum = 0;
    for (const vec3& e : found) sum += static_cast<double>(luminance(e));
    // `distance` is 5 to 6 % too bright here; 200 points of 64 paths leave 1 % of noise.
    EXPECT_NEAR(sum / static_cast<double>(found.size()) / known().truth.mean, 1, 0.1) << name_of(method);
  }
}

TEST_F(ShutRooms, WithoutVisibilityLightPassesTheWall) {
  std::vector<vec3> positions;
  for (const scene::ProbePlace& place : places) positions.push_back(place.position);
  probes::WeightParams blind;
  blind.method = probes::WeightMethod::trilinear;
  const auto sees_all = [](const vec3&, const vec3&) { return true; };
  const probes::IrradianceLookup lookup(known().set, probes::make_weights(positions, sees_all, blind));
  const double ratio = study::leak_ratio(study::look_up(lookup, known().points), known().truth);
  RecordProperty("leak_percent", std::to_string(100 * ratio));
  EXPECT_GT(ratio, 0.03);
  EXPECT_LT(ratio, 0.12);
}

TEST_F(TwoRooms, AnOpenDoorLeavesNoPointDark) {
  const trace::PathTracer tracer(scene, 1);
  const study::LeakReport report =
      study::measure_leak(tracer, probes::IrradianceLookup(lit(1), tracer), points(1), params);
  EXPECT_EQ(report.dark, 0u);
  EXPECT_EQ(report.ratio, 0);
}

}  // namespace
}  // namespace ssphh
