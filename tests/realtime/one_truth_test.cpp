/// The drawn picture of every built-in scene is the traced one with the same probes.

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>

#include "doubtful_sight.h"
#include "gl_context.h"
#include "pictures.h"

namespace ssphh {
namespace {

using test::PictureSize;

struct BlockMeans {
  int columns, rows;
  std::vector<double> values;  ///< red, green, blue of one block after the other
};

BlockMeans block_means(const image::Image& image, int block = 16) {
  BlockMeans means{image.width / block, image.height / block, {}};
  for (int by = 0; by < means.rows; ++by) {
    for (int bx = 0; bx < means.columns; ++bx) {
      glm::dvec3 sum(0);
      for (int y = 0; y < block; ++y) {
        for (int x = 0; x < block; ++x) sum += glm::dvec3(image.rgb(bx * block + x, by * block + y));
      }
      for (glm::length_t c = 0; c < 3; ++c) means.values.push_back(sum[c] / (block * block));
    }
  }
  return means;
}

/// How far apart what a matte surface reflects may lie where a texel of a probe's map decides what it sees.
/// Seen along a surface, as that beside a doorway from a probe in it, a texel is as long as a wall.
BlockMeans doubts(const scene::Scene& scene, const probes::ProbeSet& probes,
                  const probes::LookupParams& params, const trace::PathTracer& tracer) {
  const trace::TransportScene source(scene);
  const test::PixelPoints points(source, scene::camera_pose(scene, ""), {64, 36});
  std::vector<vec3> places;
  for (const probes::Probe& probe : probes.probes) places.push_back(probe.position);
  test::DoubtfulSight sight(tracer);
  const probes::IrradianceLookup lookup(probes, probes::make_weights(places, sight.sees(), params.weights),
                                        params);
  image::Image apart(points.size.width, points.size.height, 3);
  for (const test::PixelPoint& pixel : points.pixels) {
    if (pixel.hit.escaped()) continue;
    vec3 low(INFINITY), high(0);
    sight.for_each_choice(pixel.point, [&] {
      const vec3 value = pixel.hit.albedo / pi * lookup.irradiance(pixel.point);
      low = glm::min(low, value), high = glm::max(high, value);
    });
    const auto i = static_cast<int>(points.index(pixel));
    apart.set_rgb(i % points.size.width, i / points.size.width, high - low);
  }
  return block_means(apart, 8);
}

class OneTruth : public test::WithGl, public testing::WithParamInterface<std::string> {
 protected:
  void compare(probes::LookupMethod method, probes::WeightMethod weights = probes::WeightMethod::mls) {
    const scene::Scene scene = scene::make_builtin(GetParam());
    compare(scene, method, weights, test::made_up_probes(scene));
  }
  /// `edges`: something throws shadows. `sharing`: so many probes, about, light a point.
  void compare(const scene::Scene& scene, probes::LookupMethod method, probes::WeightMethod weights,
               const probes::ProbeSet& probes, bool edges = true, int sharing = 8);
};

/// What may differ in a block:
/// - the traced picture's noise, from two halves;
/// - edges of what a probe lights, as doubts() has them;
/// - edges of what a lamp lights move by up to 1.5 texels of its shadow map: of 256 texels on 2 d at distance
///   d, d as much as the width the picture shows, against a block of 16 of 128 pixels of that width;
/// - half shadows of lights with an extent come in steps of one of 16 points (8 on spheres).
/// A block with an edge through it has all of that at once.
void OneTruth::compare(const scene::Scene& scene, probes::LookupMethod method, probes::WeightMethod weights,
                       const probes::ProbeSet& probes, bool edges, int sharing) {
  const double edge = edges ? 1.5 * 2.0 / 256 / (16.0 / 128) : 0, steps = edges ? 1.0 / 16 : 0;
  // What is left is interpolation within a probe's tile: seen to be 0.2 % in a block; one probe of sixteen
  // missed makes 1.5 %. 0.5 % lies between; a quarter of it counts four times. It falls as the probes'
  // number's root
  const double least = edges ? 0.005 : 0.00125 * std::sqrt(8.0 / sharing);
  const PictureSize size;

  const trace::PathTracer tracer(scene);
  probes::LookupParams params;
  params.weights.method = weights;
  const auto lookup = probes::make_lookup(method, probes, tracer, params);
  const BlockMeans a = block_means(test::traced(scene, lookup.get(), size, 24, 1, tracer));
  const BlockMeans b = block_means(test::traced(scene, lookup.get(), size, 24, 2, tracer));
  realtime::Renderer renderer(gl(), scene);
  renderer.set_probes(probes);
  if (weights == probes::WeightMethod::fitted)
    renderer.set_fitted(test::prepared(scene, *probes.fitted, tracer));
  realtime::FrameSettings settings;
  settings.lookup = method;
  settings.weights = weights;
  const BlockMeans picture = block_means(test::drawn(renderer, scene, size, settings));

  BlockMeans doubt{a.columns, a.rows, std::vector<double>(a.values.size(), 0)};
  if (edges && weights != probes::WeightMethod::fitted && method == probes::LookupMethod::irradiance)
    doubt = doubts(scene, probes, params, tracer);

  double mean = 0, squares = 0, noise2 = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) mean += 0.5 * (a.values[i] + b.values[i]);
  mean /= static_cast<double>(a.values.size());
  ASSERT_GT(mean, 0);
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double truth = 0.5 * (a.values[i] + b.values[i]), by = truth + 0.01 * mean;
    // Half the difference of two halves estimates the mean's deviation; one pair alone may be equal by chance
    const double noise = std::max(0.5 * std::abs(a.values[i] - b.values[i]), least * by);
    const double off = std::max(std::abs(picture.values[i] - truth) - doubt.values[i], 0.0);
    EXPECT_LT(off, 4 * noise + (edge + steps) * by)
        << "block " << i / 3 % static_cast<std::size_t>(a.columns) << ", "
        << i / 3 / static_cast<std::size_t>(a.columns) << ", channel " << i % 3 << " of " << truth;
    squares += off * off / (by * by);
    noise2 += noise * noise / (by * by);
  }
  const auto n = static_cast<double>(a.values.size());
  // Few blocks have edges, and those rarely all of their light; a fit changes more than an average does where
  // a probe comes into sight, so that more of its edges count
  const double share = weights == probes::WeightMethod::mls ? 0.2 : 0.1;
  EXPECT_LT(squares / n, 4 * noise2 / n + share * edge * edge);
}

TEST_P(OneTruth, PictureIsTheTracedOne) {
  compare(probes::LookupMethod::irradiance);
}

using OneTruthDistance = OneTruth;
TEST_P(OneTruthDistance, PictureWithWeightsByDistanceIsTheTracedOne) {
  compare(probes::LookupMethod::irradiance, probes::WeightMethod::distance);
}
INSTANTIATE_TEST_SUITE_P(Builtin, OneTruthDistance, testing::Values("gallery3"));

INSTANTIATE_TEST_SUITE_P(Builtin, OneTruth,
                         testing::Values("cornell", "furnace", "box", "two-rooms", "gallery1", "gallery2",
                                         "gallery3"),
                         [](const auto& given) {
                           std::string name = given.param;
                           std::erase(name, '-');
                           return name;
                         });

/// Many probes: each point has more than the 16 among which it chooses in reach, and cells list more.
using OneTruthCrowded = OneTruth;
TEST_P(OneTruthCrowded, PictureWithMoreProbesAroundThanAPointTakesIsTheTracedOne) {
  scene::Scene scene = scene::make_builtin(GetParam());
  for (scene::Material& material : scene.materials) material.emission = vec3(0);
  const scene::Bounds room = scene::world_bounds(scene, scene::world_matrices(scene, 0));
  // A face-centred lattice has the most neighbours; slightly shaken, so that no two are equally far
  std::mt19937 random(5);
  std::uniform_real_distribution<float> shake(-0.02f, 0.02f);
  std::vector<vec3> places;
  for (int i = 0; i < 4 * 5 * 5 * 5; ++i) {
    const vec3 cell(static_cast<float>(i % 5), static_cast<float>(i / 5 % 5), static_cast<float>(i / 25 % 5));
    const int corner = i / 125;  // 0, and the middles of the three faces around it
    const vec3 face = corner == 0 ? vec3(0) : vec3(corner != 1, corner != 2, corner != 3) * 0.5f;
    const vec3 share = (cell + 0.25f + face + vec3(shake(random), shake(random), shake(random))) / 5.0f;
    places.push_back(glm::mix(room.min, room.max, share));
  }
  probes::ProbeSet probes = test::made_up_probes(places);
  // Every second one dark, the rest twice as bright: to miss one shows
  for (std::size_t i = 0; i < probes.probes.size(); ++i)
    for (probes::GroupLight& light : probes.probes[i].groups) light.reflected *= vec3(i % 2 ? 0.1f : 2);
  probes::merge_groups(probes);
  compare(scene, probes::LookupMethod::irradiance, probes::WeightMethod::mls, probes, false);
}
INSTANTIATE_TEST_SUITE_P(Builtin, OneTruthCrowded, testing::Values("box"));

/// No probe is seen: those serve that do not stand behind the surface.
using OneTruthHidden = OneTruth;
TEST_P(OneTruthHidden, PictureWithoutAProbeInSightIsTheTracedOne) {
  scene::Scene scene = scene::make_builtin(GetParam());
  scene.lights.clear();
  const scene::Bounds room = scene::world_bounds(scene, scene::world_matrices(scene, 0));
  std::vector<vec3> outside;
  for (const float u : {-0.3f, 1.3f}) {
    outside.push_back(glm::mix(room.min, room.max, vec3(u, 0.4f, 0.6f)));
    outside.push_back(glm::mix(room.min, room.max, vec3(0.6f, u, 0.4f)));
    outside.push_back(glm::mix(room.min, room.max, vec3(0.4f, 0.6f, u)));
  }
  compare(scene, probes::LookupMethod::irradiance, probes::WeightMethod::distance,
          test::made_up_probes(outside), false, 2);
}
INSTANTIATE_TEST_SUITE_P(Builtin, OneTruthHidden, testing::Values("two-rooms"));

/// Weights at points that lie at random: lists hold many, and walls between them have to be found.
using OneTruthFitted = OneTruth;
TEST_P(OneTruthFitted, PictureWithFittedWeightsIsTheTracedOne) {
  const scene::Scene scene = scene::make_builtin(GetParam());
  probes::ProbeSet probes = test::made_up_probes(scene);
  probes.fitted = test::made_up_fit(scene, probes, 1200);
  compare(scene, probes::LookupMethod::irradiance, probes::WeightMethod::fitted, probes);
}
INSTANTIATE_TEST_SUITE_P(Builtin, OneTruthFitted, testing::Values("cornell", "two-rooms"));

using OneTruthTrilinear = OneTruth;
TEST_P(OneTruthTrilinear, PictureWithTrilinearWeightsIsTheTracedOne) {
  const scene::Scene scene = scene::make_builtin(GetParam());
  const scene::Bounds room = scene::world_bounds(scene, scene::world_matrices(scene, 0));
  std::vector<vec3> places;
  for (int i = 0; i < 64; ++i) {
    const vec3 cell(static_cast<float>(i % 4), static_cast<float>(i / 4 % 4), static_cast<float>(i / 16));
    places.push_back(glm::mix(room.min, room.max, (cell + 0.5f) / 4.0f));
  }
  compare(scene, probes::LookupMethod::irradiance, probes::WeightMethod::trilinear,
          test::made_up_probes(places));
}
INSTANTIATE_TEST_SUITE_P(Builtin, OneTruthTrilinear, testing::Values("box"));

using OneTruthLight = OneTruth;
TEST_P(OneTruthLight, PictureOfSphlsAsLightsIsTheTracedOne) {
  compare(probes::LookupMethod::light);
}
INSTANTIATE_TEST_SUITE_P(Builtin, OneTruthLight, testing::Values("cornell"));

}  // namespace
}  // namespace ssphh
