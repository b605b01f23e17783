/// Surfaces lit from baked probes through the path tracer, against closed forms.

#include <gtest/gtest.h>

#include <ssphh/bake/bake.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>

#include "z_test.h"

namespace ssphh {
namespace {

bake::BakeParams small(int seed) {
  bake::BakeParams params;
  params.face_size = 4;
  params.path.spp = 4;
  params.path.max_depth = 3;
  params.path.seed = static_cast<std::uint64_t>(seed);
  params.viz = false;
  return params;
}

/// The closed box: emission 1, albedo ½, so that depths 1..3 arrive with ½ + ¼ + ⅛ everywhere.
struct BoxTest : testing::Test {
  scene::Scene scene = scene::make_builtin("box");
  trace::PathTracer tracer{scene};
  probes::ProbeSet places = place::init_from_scene(scene, 3);

  probes::ProbeSet bake(int seed) const {
    bake::BakeReport report;
    return bake::bake(tracer, places, small(seed), {}, report);
  }
  static constexpr double arriving = 0.875;
};
using GiLookup = BoxTest;

TEST_F(GiLookup, OnAWallOfTheBoxBothLookupsGiveTheirClosedForms) {
  // On the floor, near the middle; the box is the cube of side 2 around the origin.
  const scene::Bounds bounds = scene::world_bounds(scene, scene::world_matrices(scene));
  const vec3 x(0.3f, bounds.min.y, 0.2f), n(0, 1, 0);
  test::Samples irradiance, light, glossy;
  for (int seed = 0; seed < 40; ++seed) {
    const probes::ProbeSet set = bake(seed);
    const probes::IrradianceLookup volume(set, tracer);
    irradiance.add(double(volume.irradiance({x, n}).y));
    glossy.add(double(volume.glossy({x, n}, glm::normalize(vec3(1, 1, 0)), 0.5f).y));
    light.add(double(probes::LightLookup(set, tracer).irradiance({x, n}).y));
  }
  const test::Significance significance{1e-3, 3};
  EXPECT_TRUE(test::mean_is(irradiance, pi_d * arriving, significance, 1e-4));
  EXPECT_TRUE(test::mean_is(glossy, arriving, significance, 1e-4));
  EXPECT_TRUE(test::mean_is(light, pi_d * arriving, significance, 1e-4));
}

TEST_F(GiLookup, DirectLightAndProbesTogetherAreTheWholeSeriesOfTheBox) {
  // Le Σ ρ^k: depths 0 and 1 from the path tracer, depths 2..4 from probes of depth 1..3 and one more
  // scattering.
  test::Samples pixels;
  for (int seed = 0; seed < 40; ++seed) {
    const probes::ProbeSet set = bake(seed);
    const probes::IrradianceLookup lookup(set, tracer);
    trace::RenderParams params;
    params.width = params.height = 4;
    params.camera = scene::camera_pose(scene, "");
    params.path.spp = 4;
    params.path.seed = static_cast<std::uint64_t>(1000 + seed);
    trace::RenderState state;
    tracer.render_with(lookup, params, state);
    const image::Image image = trace::resolve(state.color, state.passes_done);
    double sum = 0;
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) sum += double(image.rgb(x, y).y);
    }
    pixels.add(sum / 16);
  }
  EXPECT_TRUE(test::mean_is(pixels, 1 + 0.5 + 0.25 + 0.125 + 0.0625, {1e-3, 1}, 1e-4));
}

}  // namespace
}  // namespace ssphh
