/// Objects that were moved from can be assigned to and destroyed; any other use of them is an Error.

#include <ssphh/probes/lookup.h>
#include <ssphh/scene/query.h>
#include <ssphh/shading/lights.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/network.h>

#include "contract.h"
#include "probe_sets.h"
#include "spoilt_scenes.h"
#include "unruly_source.h"

namespace ssphh::test {
namespace {

std::vector<Contract> of_moved_from() {
  return {
      gives("LightSet", "ThatWasMoved",
            [] {
              const scene::Scene scene = sound_scene();
              shading::LightSet first(scene, scene::world_matrices(scene));
              shading::LightSet second = std::move(first);
              expect_refusal([&] { first.groups(); }, {"moved from"});
              expect_refusal([&] { first.sample(0, vec3(0), 0.5f, vec2(0.5f)); }, {"moved from"});
              expect_refusal([&] { shading::LightSet(first, {}, {}); }, {"moved from"});
              EXPECT_EQ(second.emitter_count(), 1);
              first = std::move(second);
              EXPECT_EQ(first.emitter_count(), 1);
            }),
      gives("WeightFit", "ThatWasMoved",
            [] {
              transport::WeightFit first(std::vector<rays::SurfacePoint>(2));
              const transport::WeightFit second = std::move(first);
              expect_refusal([&] { first.solve(); }, {"moved from"});
              EXPECT_EQ(second.solve().points.size(), 2u);
            }),
      gives("PathTracer", "ThatWasMoved",
            [] {
              const scene::Scene scene = sound_scene();
              trace::PathTracer first(scene);
              trace::PathTracer second = std::move(first);
              expect_refusal([&] { first.light_groups(); }, {"moved from"});
              expect_refusal([&] { first.visible(vec3(0), vec3(1)); }, {"moved from"});
              first = std::move(second);
              EXPECT_EQ(first.light_groups(), scene::light_groups(scene));
            }),
      gives("IrradianceLookup", "ThatWasMoved",
            [] {
              const scene::Scene scene = sound_scene();
              const trace::PathTracer tracer(scene);
              probes::IrradianceLookup first(sound_set(), tracer);
              const vec3 seen = first.irradiance({});
              probes::IrradianceLookup second = std::move(first);
              expect_refusal([&] { first.irradiance({}); }, {"moved from"});
              EXPECT_EQ(second.irradiance({}), seen);
              first = std::move(second);
              EXPECT_EQ(first.irradiance({}), seen);
            }),
      gives("LightLookup", "ThatWasMoved",
            [] {
              const scene::Scene scene = sound_scene();
              const trace::PathTracer tracer(scene);
              probes::LightLookup first(sound_set(), tracer);
              const vec3 seen = first.irradiance({});
              const probes::LightLookup second = std::move(first);
              expect_refusal([&] { first.glossy({}, {0, 0, 1}, 0.5f); }, {"moved from"});
              EXPECT_EQ(second.irradiance({}), seen);
            }),
      gives("TransportNetwork", "ThatWasMoved",
            [] {
              const scene::Scene scene = door_scene();
              const trace::TransportScene source(scene);
              const std::vector<vec3> places{scene::sphl_places(scene)[0].position};
              transport::TransportNetwork first(source, places,
                                                {.directions = 32, .surfel_size = 0.5f, .link_rays = 8});
              const std::size_t surfels = first.surfel_count();
              transport::TransportNetwork second = std::move(first);
              expect_refusal([&] { first.surfel_count(); }, {"moved from"});
              EXPECT_EQ(second.surfel_count(), surfels);
              second.set_time(0.5f);
              first = std::move(second);
              EXPECT_EQ(first.time(), 0.5f);
            }),
  };
}

SSPHH_CONTRACTS(Moved, of_moved_from());

}  // namespace
}  // namespace ssphh::test
