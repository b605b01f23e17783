/// Objects that were moved from can be assigned to and destroyed; any other use of them is an Error.

#include <ssphh/gi/fitted_weights.h>
#include <ssphh/scene/query.h>
#include <ssphh/shading/lights.h>

#include "contract.h"
#include "spoilt_scenes.h"

namespace ssphh::test {
namespace {

std::vector<Contract> rows() {
  return {
      gives("LightSet", "ThatWasMoved",
            [] {
              const scene::Scene scene = sound_scene();
              shading::LightSet first(scene, scene::world_matrices(scene));
              shading::LightSet second = std::move(first);
              expect_refusal([&] { first.groups(); }, {"moved from"});
              expect_refusal([&] { first.sample(vec3(0), 0.5f, vec2(0.5f)); }, {"moved from"});
              expect_refusal([&] { shading::LightSet(first, {}, {}); }, {"moved from"});
              EXPECT_EQ(second.emitter_count(), 1);
              first = std::move(second);
              EXPECT_EQ(first.emitter_count(), 1);
            }),
      gives("WeightFit", "ThatWasMoved",
            [] {
              gi::WeightFit first(std::vector<scene::SurfacePoint>(2));
              const gi::WeightFit second = std::move(first);
              expect_refusal([&] { first.solve(); }, {"moved from"});
              EXPECT_EQ(second.solve().points.size(), 2u);
            }),
  };
}

SSPHH_CONTRACTS(Moved, rows());

}  // namespace
}  // namespace ssphh::test
