/// A probe's tiles on a ball: the lookup for every normal.

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>

#include "straight_view.h"

namespace ssphh::realtime {
namespace {

using TilePicture = test::WithGl;

/// Seen from −z, where the map's edges meet, and from other sides.
TEST_F(TilePicture, ABallShowsTheProbesIrradianceForEveryNormal) {
  for (const vec3& toward : {vec3(0, 0, -1), vec3(0, 0, 1), vec3(1, 0, 0), vec3(0.4f, -0.7f, 0.6f)}) {
    const StraightView view{Frame::around(glm::normalize(toward)), 1.6f, 48};
    const scene::Scene scene = coloured(scene::make_sphere(1, 96, 48));
    MadeUpProbes probes;
    probes.add(6.0f * view.frame.z);
    Renderer renderer(gl(), scene);
    renderer.set_probes(probes.set);
    FrameSettings settings;
    settings.weights = probes::WeightMethod::distance;
    const image::Image drawn = view.draw(renderer, settings);
    const probes::IrradianceLookup lookup(probes.set,
                                          probes::make_weights(probes.positions(), everything_sees));
    Worst worst;
    for (int y = 0; y < view.side; ++y) {
      for (int x = 0; x < view.side; ++x) {
        const vec2 p = view.place(x, y);
        if (glm::length(p) > 0.8f) continue;
        const vec3 n = view.frame.to_world({p, std::sqrt(1 - glm::dot(p, p))});
        worst.take(drawn.rgb(x, y), reflected(lookup.irradiance({n, n})));
      }
    }
    // Bilinear interpolation on 24 texels, h = π/24 at most: at the map's creases h/4 of the slope's jump,
    // which is up to 2√2 times what band 1 has of the light, a quarter.
    for (int c = 0; c < 3; ++c) EXPECT_LT(worst.share()[c], 0.02f) << c;
  }
}

}  // namespace
}  // namespace ssphh::realtime
