/// A whole scene turned about an oblique axis: what the probes' functions, turned back, keep of it.

#include <gtest/gtest.h>

#include <ssphh/bake/bake.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/hier.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/transport/bounce.h>
#include <ssphh/transport/relight_session.h>

#include "transport_fixtures.h"
#include "turned_scene.h"

namespace ssphh::test {
namespace {

const quat oblique = glm::angleAxis(glm::radians(37.0f), glm::normalize(vec3(1, 2, -0.7f)));
/// A turn by any angle: none of these maps the axes onto themselves.
const quat turns[] = {oblique, glm::angleAxis(glm::radians(131.0f), glm::normalize(vec3(-2, 1, 1)))};

using Functions = std::vector<sh::RadianceSh>;

Functions turned_back(const Functions& functions, const quat& turn = oblique) {
  Functions result;
  for (const sh::RadianceSh& f : functions) result.push_back(sh::rotate(f, glm::conjugate(turn)));
  return result;
}

/// Root mean square over all coefficients, relative to that of `b`.
double difference(const Functions& a, const Functions& b) {
  double squares = 0, scale = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a[i].values.size(); ++k) {
      const glm::dvec3 d = glm::dvec3(a[i].values[k]) - glm::dvec3(b[i].values[k]);
      squares += glm::dot(d, d);
      scale += glm::dot(glm::dvec3(b[i].values[k]), glm::dvec3(b[i].values[k]));
    }
  }
  return std::sqrt(squares / scale);
}

/// Probes' functions of one network, by who makes them.
struct Found {
  Functions surfel, bounce, sphl;
};

/// What a session of the scene, turned, finds with surfels of that size and so many directions.
Found found_in(const scene::Scene& scene, const quat& turn, float surfel_size, int directions) {
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.transport.surfel_size = surfel_size;
  params.transport.directions = directions;
  params.transport.link_rays = 64;
  params.warm_start = false;
  LitSession session(source, places_of(scene), params);
  session.update();
  Found found;
  found.surfel = session.reflected();
  // With weights that know no axes: the tents of `trilinear` stand along them.
  transport::BounceParams bounce;
  bounce.weights.method = probes::WeightMethod::mls;
  transport::BounceOperator(session.network(), source, 4, bounce).solve(session.patch_direct(), found.bounce);
  // `matrix`: one probe emits a lobe that turns with the scene; all other light is off.
  sh::RadianceSh lobe(3);
  for (std::size_t k = 0; k < lobe.values.size(); ++k)
    lobe.values[k] = vec3(k == 0 ? 3.0f : 0.9f / static_cast<float>(k), 1.0f, 0.5f);
  for (int g = 0; g < static_cast<int>(source.light_groups().size()); ++g)
    session.state.group_scales[g] = vec3(0);
  session.shine(0, sh::rotate(lobe, turn));
  session.update();
  found.sphl = session.reflected();
  return found;
}

/// A scene as it is, with other sizes and counts, and turned.
struct Turned {
  Found base;
  std::vector<Found> others, tilted;
};

const Turned& turned_cornell() {
  static const Turned all = [] {
    const scene::Scene scene = scene::make_builtin("cornell");
    const quat none(1, 0, 0, 0);
    Turned out{found_in(scene, none, 0.15f, 2048), {}, {}};
    const std::pair<float, int> others[] = {{0.14f, 2000}, {0.16f, 2100}, {0.145f, 2160}, {0.155f, 1930}};
    for (const auto& [size, directions] : others)
      out.others.push_back(found_in(scene, none, size, directions));
    for (const quat& turn : turns) out.tilted.push_back(found_in(turned(scene, turn), turn, 0.15f, 2048));
    return out;
  }();
  return all;
}

/// Turning draws voxels, directions and rays anew. So do other sizes and counts: their mean difference says
/// how much that may be, and single ones differ from it by less than half.
void expect_to_turn_with_the_scene(Functions Found::*functions) {
  const Turned& all = turned_cornell();
  const Functions& base = all.base.*functions;
  double sampling = 0;
  for (const Found& other : all.others)
    sampling += difference(other.*functions, base) / static_cast<double>(all.others.size());
  EXPECT_LT(sampling, 0.05);
  for (std::size_t i = 0; i < std::size(turns); ++i) {
    const Functions& tilted = all.tilted[i].*functions;
    EXPECT_LT(difference(turned_back(tilted, turns[i]), base), 1.5 * sampling);
    EXPECT_GT(difference(tilted, base), 0.3) << "not turned back, it is another";
  }
}

TEST(TransportRotation, SurfelProbesTurnWithTheSceneBeyondSamplingOnly) {
  expect_to_turn_with_the_scene(&Found::surfel);
}

TEST(TransportRotation, BounceProbesTurnWithTheSceneBeyondSamplingOnly) {
  expect_to_turn_with_the_scene(&Found::bounce);
}

TEST(TransportRotation, SphlsThatAreLightsTurnWithTheScene) {
  expect_to_turn_with_the_scene(&Found::sphl);
}

TEST(TransportRotation, CoefficientHierarchyDependsOnTheAxes) {
  const scene::Scene scene = scene::make_builtin("cornell"), tilted = turned(scene, oblique);
  const auto baked = [](const scene::Scene& s, std::uint64_t seed) {
    bake::BakeParams params;
    params.face_size = 16;
    params.path = {3, 1, 16, seed};
    params.viz_params.matrix = true;
    bake::BakeReport report;
    return bake::bake(trace::PathTracer(s), place::init_from_scene(s, 4), params, {}, report);
  };
  const auto neighbors = [](probes::ProbeSet set, probes::HierOperator op) {
    probes::HierParams params;
    params.op = op;
    probes::hier(set, params);
    return set.hierarchy->neighbor;
  };
  const probes::ProbeSet straight = baked(scene, 1), again = baked(scene, 2), oblique_set = baked(tilted, 1);
  const auto mean = probes::HierOperator::mean, coefficient = probes::HierOperator::coefficient;
  // `mean` and `matrix` commute with turning: they change as another seed and other texels make them, while
  // the paper's operator gives another answer.
  const double noise = difference(neighbors(again, mean), neighbors(straight, mean));
  const double by_mean = difference(turned_back(neighbors(oblique_set, mean)), neighbors(straight, mean));
  const double by_coefficient =
      difference(turned_back(neighbors(oblique_set, coefficient)), neighbors(straight, coefficient));
  const auto matrix = probes::HierOperator::matrix;
  const double matrix_noise = difference(neighbors(again, matrix), neighbors(straight, matrix));
  const double by_matrix =
      difference(turned_back(neighbors(oblique_set, matrix)), neighbors(straight, matrix));
  EXPECT_LT(by_mean, 2 * noise);
  EXPECT_LT(by_matrix, 2 * matrix_noise);
  RecordProperty("coefficient", std::to_string(by_coefficient));
  EXPECT_GT(by_coefficient, 0.5);
}

}  // namespace
}  // namespace ssphh::test
