/// Weights fitted to transport over Embree, where the answer is known.

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/probes/lookup.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/transport/fitted_weights.h>

#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

probes::ProbeSet set_of(const transport::RelightSession& session) {
  probes::ProbeSet set;
  set.degree = session.reflected().front().degree();
  set.light_groups.push_back({"all", vec3(1)});
  for (std::size_t i = 0; i < session.places().size(); ++i) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.position = session.places()[i].position;
    probe.groups.push_back({{}, session.reflected()[i]});
  }
  probes::merge_groups(set);
  return set;
}

TEST(FittedWeights, ReproduceTheLightTheyWereFittedToEverywhere) {
  // All walls of the box are as bright: E = π ρ/(1 − ρ) · π / π. Fitted to this light above all, the weights
  // give it at every point of every wall; 256 directions leave 1e-3 in bands 1 and 2 of the probes.
  constexpr float rho = 0.5f;
  const GlowingBox box(rho);
  transport::FitParams params;
  params.own_weight = 1000;
  probes::ProbeSet set = set_of(box.session);
  set.fitted = transport::fit_weights(box.session.network(), box.source,
                                      transport::surfel_points(box.session.network()), params,
                                      box.session.direct_by_group());
  const trace::PathTracer tracer(box.scene);
  const probes::IrradianceLookup lookup(set, tracer);
  const scene::Bounds bounds = scene::world_bounds(box.scene, scene::world_matrices(box.scene));
  const Walls walls{bounds.min, bounds.max};
  Pcg32 rng(3);
  for (int i = 0; i < 300; ++i) {
    const rays::SurfacePoint p = walls.at(i % 6, rng.uniform2());
    EXPECT_NEAR(lookup.irradiance(p).y / (pi * rho / (1 - rho)), 1, 6e-3f);
  }
}

/// Irradiance at fitted points for the session's light: gathered from the surfels, and looked up.
struct Compared {
  std::vector<vec3> truth, looked_up;

  Compared(const probes::FittedPoints& fitted, const transport::RelightSession& session, int rays) {
    const transport::TransportNetwork& network = session.network();
    const std::vector<std::int32_t> seen = network.gather(fitted.points, rays);
    const std::vector<transport::Irradiance4> irradiance = session.patch_irradiance();
    const auto count = static_cast<std::size_t>(rays);
    for (std::size_t p = 0; p < fitted.points.size(); ++p) {
      vec3& t = truth.emplace_back(0);
      for (std::size_t r = p * count; r < (p + 1) * count; ++r) {
        if (seen[r] == transport::no_patch) continue;
        const auto s = static_cast<std::size_t>(seen[r]);
        t += network.albedo()[s] * vec3(irradiance[s]) / static_cast<float>(rays);
      }
      vec3& e = looked_up.emplace_back(0);
      for (const probes::ProbeWeight& entry : fitted.weights[p].used()) {
        const sh::IrradianceSh function = sh::irradiance_from_radiance(session.reflected()[entry.probe]);
        std::vector<float> basis(function.values.size());
        sh::eval_basis(function.degree(), fitted.points[p].normal, basis);
        for (std::size_t k = 0; k < basis.size(); ++k) e += entry.weight * basis[k] * function.values[k];
      }
    }
  }
};

TEST(FittedWeights, MeetTheSumOfTheirEquations) {
  // One probe a point, among coloured walls: no weight meets all three channels. Plain least squares of
  // relative errors would be too dark, by what the channels differ.
  const scene::Scene scene = coloured_room({3, 2.5f, 2});
  const trace::TransportScene source(scene);
  transport::RelightParams session_params;
  session_params.transport = small_network();
  session_params.degree = 2;
  LitSession session(source, places_of(scene), session_params);
  session.update();
  transport::FitParams params;
  params.probes = 1;
  params.training_lights = 1;
  params.own_weight = 1000;
  const probes::FittedPoints fitted =
      transport::fit_weights(session.network(), source, transport::surfel_points(session.network()), params,
                             session.direct_by_group());
  const Compared compared(fitted, session, params.gather_rays);
  double squares = 0;
  for (std::size_t p = 0; p < fitted.points.size(); ++p) {
    ASSERT_EQ(fitted.weights[p].count, 1);
    EXPECT_GT(fitted.weights[p].used()[0].weight, 0);
    const vec3 relative = compared.looked_up[p] / compared.truth[p];
    // The single training light has a thousandth of a say; solving stops at 1e-4 or 1e-3.
    EXPECT_NEAR((relative.x + relative.y + relative.z) / 3, 1, 5e-3f);
    squares += double(glm::dot(relative - 1.0f, relative - 1.0f)) / 3 / double(fitted.points.size());
  }
  EXPECT_GT(squares, 0.02) << "or there is nothing to be too dark by";
}

TEST(FittedWeights, ErrInLightThatIsATenthOfTheProbesAsIfItWereATenth) {
  // A corridor with a lamp at either end, and the only probe at one of them. Each lamp asks for its own
  // weight t / e, the more the smaller max(t, e / 10): where the near lamp is next to nothing the far one has
  // its say
  scene::Scene scene;
  add_body(scene, "corridor", scene::flipped(scene::make_box(vec3(0), {9, 2, 2})), vec3(0.5f));
  for (const float x : {0.7f, 8.3f}) {
    scene.nodes.emplace_back().local.translation = {x, 1.1f, 0.9f};
    scene::Light& lamp = scene.lights.emplace_back();
    lamp.name = x < 1 ? "near" : "far";
    lamp.node = static_cast<int>(scene.nodes.size()) - 1;
  }
  add_sphl(scene, "only", {1, 1, 1});
  scene::validate(scene);
  const trace::TransportScene source(scene);
  transport::RelightParams session_params;
  session_params.transport = small_network();
  session_params.degree = 2;
  LitSession session(source, places_of(scene), session_params);
  session.update();
  transport::FitParams params;
  params.probes = params.training_lights = 1;
  params.own_weight = 1000;
  const probes::FittedPoints fitted =
      transport::fit_weights(session.network(), source, transport::surfel_points(session.network()), params,
                             session.direct_by_group());
  std::vector<Compared> lit;
  for (const int group : {0, 1}) {
    session.state.group_scales[group] = vec3(1);
    session.state.group_scales[1 - group] = vec3(0);
    session.update();
    lit.emplace_back(fitted, session, params.gather_rays);
  }
  int dark = 0, middling = 0;
  for (std::size_t p = 0; p < fitted.points.size(); ++p) {
    ASSERT_EQ(fitted.weights[p].count, 1);
    const double weight = double(fitted.weights[p].used()[0].weight);
    double wanted = 0, got = 0;
    for (const Compared& by : lit) {
      const double t = double(by.truth[p].y), e = double(by.looked_up[p].y) / weight;
      const double scale = 1 / std::max(t, 0.1 * e);
      dark += t<0.1 * e, middling += t> 0.1 * e && t < 0.3 * e;
      wanted += t * scale, got += e * scale;
    }
    // The training light has a thousandth of a say; solving stops at 1e-4 or 1e-3
    EXPECT_NEAR(weight / (wanted / got), 1, 0.01) << fitted.points[p].position.x;
  }
  EXPECT_GT(dark, 20);
  EXPECT_GT(middling, 20);
}

/// Mean over the points with x > min_x of the relative error, green.
double error_of(const probes::FittedPoints& fitted, const transport::RelightSession& session, float min_x) {
  const Compared compared(fitted, session, 1024);
  double sum = 0;
  int count = 0;
  for (std::size_t p = 0; p < fitted.points.size(); ++p) {
    if (fitted.points[p].position.x < min_x) continue;
    sum += double(std::abs(compared.looked_up[p].y - compared.truth[p].y) / compared.truth[p].y);
    ++count;
  }
  return sum / count;
}

TEST(FittedWeights, OfBothPosesServeADoorThatMoves) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.transport = small_network();
  params.degree = 2;
  LitSession session(source, places_of(scene), params);
  session.update();
  const std::vector<rays::SurfacePoint> points =
      transport::spread_points(transport::surfel_points(session.network()), 300);
  transport::WeightFit both(points);
  both.add_pose(session.network(), source, session.direct_by_group());
  const probes::FittedPoints shut = both.solve();
  EXPECT_EQ(shut, transport::fit_weights(session.network(), source, points, {}, session.direct_by_group()))
      << "one pose is a fit of its own";

  session.state.time = 1;
  session.update();
  both.add_pose(session.network(), source, session.direct_by_group());
  const probes::FittedPoints open =
      transport::fit_weights(session.network(), source, points, {}, session.direct_by_group());
  // In room B, the door open: weights that know the pose are best, those of the shut door alone useless.
  const double joint_error = error_of(both.solve(), session, 0.3f);
  const double shut_error = error_of(shut, session, 0.3f), open_error = error_of(open, session, 0.3f);
  EXPECT_LT(joint_error, 0.6 * shut_error);
  EXPECT_LT(open_error, 1.2 * joint_error);
  RecordProperty("errors", fmt::format("{} {} {}", shut_error, joint_error, open_error));
}

TEST(FittedWeights, RefuseParametersOutOfRange) {
  for (const transport::FitParams& params :
       {transport::FitParams{.probes = 0}, transport::FitParams{.probes = 17},
        transport::FitParams{.training_lights = 0}, transport::FitParams{.own_weight = 0},
        transport::FitParams{.own_weight = NAN}, transport::FitParams{.gather_rays = 1},
        transport::FitParams{.degree = 11}})
    EXPECT_THROW(transport::WeightFit({}, params), Error);
}

}  // namespace
}  // namespace ssphh::test
