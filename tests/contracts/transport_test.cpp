/// Contracts of libs/transport beside its sessions, of updates of sets, and of grids of probes.

#include <ssphh/bake/light_modes.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/bake/update.h>
#include <ssphh/geometry/delaunay.h>
#include <ssphh/probes/candidate_grid.h>
#include <ssphh/probes/surface_interpolation.h>
#include <ssphh/probes/surface_lists.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/bounce.h>
#include <ssphh/transport/session_sets.h>
#include <ssphh/transport/surface_gather.h>

#include "contract.h"
#include "probe_sets.h"
#include "spoilt_scenes.h"

namespace ssphh::test {
namespace {

/// As long as what refers to it.
const scene::Scene& scene_of_networks() {
  static const scene::Scene scene = sound_scene();
  return scene;
}

/// A network over the sound scene.
struct Seen {
  trace::TransportScene source{scene_of_networks()};
  transport::TransportNetwork network{source,
                                      std::array{vec3(0, 1, 0)},
                                      {.directions = 32, .surfel_size = 0.5f, .link_rays = 8, .samples = 2}};
  std::vector<rays::SurfacePoint> points{{vec3(0), vec3(0, 1, 0)}, {vec3(0.5f, 0, 0), vec3(0, 1, 0)}};
};
Contract refuses_seen(std::string entry, std::string given, std::function<void(Seen&)> call,
                      std::vector<std::string> words) {
  return refuses(
      std::move(entry), std::move(given),
      [call] {
        Seen seen;
        call(seen);
      },
      std::move(words));
}

std::vector<Contract> of_networks() {
  return {
      refuses_seen("BounceOperator", "OfOtherDirectLight",
                   [](Seen& s) {
                     std::vector<sh::RadianceSh> reflected;
                     transport::BounceOperator(s.network, s.source, 1).solve({}, reflected);
                   },
                   {"each patch"}),
      refuses_seen("Contraction", "WithoutAlbedo",
                   [](Seen& s) { transport::contraction(s.network.links(), {}); }, {"each patch"}),
      refuses_seen("SurfaceGather", "AppendedToItself",
                   [](Seen& s) {
                     transport::SurfaceGather gather(s.network, s.points, 16);
                     gather.append(std::move(gather));
                   },
                   {"another gather"}),
      refuses_seen("GatherWhereNeeded", "WithoutLight",
                   [](Seen& s) { transport::gather_where_needed(s.network, {}, std::array{0.0f}, {}); },
                   {"nothing tells"}),
      {"TransportNetwork", "AskedForRaysThatAreNone",
       [] {
         Seen seen;
         seen.points[0].position.x = nan, seen.points[1].normal = vec3(infinity);
         EXPECT_EQ(seen.network.gather(seen.points, 4).size(), 8u);
         const rays::RayQuery none{vec3(nan), vec3(0, 1, 0)}, far{vec3(1e30f), vec3(0, -1, 0)};
         for (const transport::Sight& sight : seen.network.look(std::array{none, far}))
           EXPECT_EQ(sight.patch, transport::no_patch);
       }},
      refuses("StoreGroups", "OfNone",
              [] {
                probes::ProbeSet set = sound_set();
                transport::store_groups(set, {}, {});
              },
              {"each group"}),
      refuses("StoreGroups", "OfOtherProbes",
              [] {
                probes::ProbeSet set = sound_set();
                transport::store_groups(set, {{}}, {{}});
              },
              {"each group"}),
  };
}

/// A set and a scope of its light that names what it lacks.
Contract refuses_scope(
    std::string entry, std::string given, const bake::LightScope& scope,
    std::function<void(const rays::TransportSource&, probes::ProbeSet&, const bake::LightScope&)> call) {
  return refuses(std::move(entry), std::move(given),
                 [=] {
                   const trace::TransportScene source(scene_of_networks());
                   probes::ProbeSet set = sound_set();
                   set.light_groups[0].name = source.light_groups()[0];
                   call(source, set, scope);
                 },
                 {"scope of light", "ascend"});
}

std::vector<Contract> of_updates() {
  std::vector<Contract> rows = {
      refuses("RenewTrials", "OfNoProbe",
              [] {
                probes::ProbeSet set = sound_set();
                set.baseline.emplace();
                bake::UpdatePlan plan;
                plan.probes = {9};
                bake::renew_trials(set, plan);
              },
              {"other probes"}),
      refuses(
          "SetLightModes", "WithoutRecords", [] { return std::make_unique<probes::ProbeSet>(sound_set()); },
          [](probes::ProbeSet& set) {
            bake::set_light_modes(trace::TransportScene(scene_of_networks()), set,
                                  std::array{scene::LightMode::baked});
          },
          {"has none"}, [](probes::ProbeSet& set) { EXPECT_EQ(set, sound_set()); }),
  };
  const std::array<std::pair<std::string, bake::LightScope>, 3> scopes{
      {{"OfNoProbe", {{{0, 3}}, {}}}, {"OfNoGroup", {{}, {{1}}}}, {"OfAProbeTwice", {{{1, 1}}, {}}}}};
  for (const auto& [given, scope] : scopes) {
    rows.push_back(refuses_scope("UpdateTransport", given, scope, [](auto& source, auto& set, auto& of) {
      bake::TransportBakeReport report;
      bake::update_transport(source, set, {}, of, 0, report);
    }));
    rows.push_back(refuses_scope("AddTransport", given, scope, [](auto& source, auto& set, auto& of) {
      bake::TransportBakeReport report;
      bake::TransportBakeParams params;
      params.records.points = 8;
      bake::TransportScope scope_of_all;
      scope_of_all.light = of;
      bake::add_transport(source, set, params, report, {}, scope_of_all);
    }));
    rows.push_back(refuses_scope("SetLightModes", given, scope, [](auto& source, auto& set, auto& of) {
      bake::set_light_modes(source, set, std::array{scene::LightMode::realtime}, {}, of);
    }));
  }
  return rows;
}

std::vector<Contract> of_grids() {
  scene::Bounds box;
  box.add(vec3(0)), box.add(vec3(1));
  const std::vector<vec3> probes{vec3(0), vec3(1)};
  return {
      gives("CandidateGrid", "OfNoSpacing",
            [=] {
              const probes::CandidateGrid grid = probes::make_candidate_grid(probes, box, 0);
              EXPECT_EQ(grid.cells, glm::ivec3(1)) << "as probes at one place have it";
              EXPECT_EQ(grid.length, 2);
            }),
      gives("CandidateGrid", "OfNoProbes",
            [=] {
              for (const int probe : probes::make_candidate_grid({}, box, 1).lists) EXPECT_EQ(probe, -1);
            }),
      refuses("ProbeReach", "OfFewerProbes",
              [=] { probes::probe_reach(probes::make_candidate_grid(probes, box, 1), {}); },
              {"other probes"}),
      refuses("ProbeReach", "OfTooShortLists",
              [=] {
                probes::CandidateGrid grid = probes::make_candidate_grid(probes, box, 1);
                grid.lists.clear();
                probes::probe_reach(grid, probes);
              },
              {"other probes"}),
      refuses("SurfaceReach", "OfNoSpacings",
              [] { probes::surface_reach(std::vector<rays::SurfacePoint>(2), {}); }, {"one spacing"}),
      refuses("SurfaceCover", "WithoutSight", [] { probes::surface_cover({}, 1, nullptr); },
              {"surface points", "sees"}),
      refuses("SeeAlongSurface", "WithoutSight", [] { probes::see_along_surface({}, {}, 1, 1, nullptr); },
              {"surface points", "sees"}),
      refuses("Headroom", "WithoutSight", [] { probes::headroom({}, 1, 0, nullptr); },
              {"surface points", "sees"}),
      refuses("Delaunay", "OfNoPoints", [] { geometry::delaunay({}); }, {"Delaunay", "plane"}),
      refuses("Delaunay", "OfPointsInAPlane",
              [] {
                const std::vector<geometry::LatticePoint> flat{
                    {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}, {2, 1, 0}};
                geometry::delaunay(flat);
              },
              {"Delaunay", "plane"}),
      refuses("Delaunay", "OfAPointTwice",
              [] {
                const std::vector<geometry::LatticePoint> twice{
                    {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {4, 0, 0}};
                geometry::delaunay(twice);
              },
              {"Delaunay", "twice"}),
      refuses("PrepareSurfaces", "WithoutSight",
              [] { probes::prepare_surfaces(sound_scene(), 0, std::vector<rays::SurfacePoint>(2), {}); },
              {"sees"}),
  };
}

/// A bake of the sound set with parameters that their types allow.
Contract refuses_bake(const std::string& given, std::function<void(bake::TransportBakeParams&)> spoil,
                      std::vector<std::string> words) {
  return refuses(
      "BakeTransport", given,
      [spoil] {
        const trace::TransportScene source(scene_of_networks());
        bake::TransportBakeParams params;
        params.transport = {.directions = 32, .surfel_size = 0.5f, .link_rays = 8, .samples = 2};
        spoil(params);
        bake::TransportBakeReport report;
        bake::bake_transport(source, sound_set(), params, report);
      },
      std::move(words));
}

std::vector<Contract> of_bakes() {
  return {
      refuses_bake("OfAnOperatorThatIsNone",
                   [](auto& params) { params.op = static_cast<probes::LightOperator>(9); },
                   {"light operator"}),
      refuses_bake("OfASourceThatIsNone",
                   [](auto& params) {
                     params.viz = true;
                     params.viz_params.source = static_cast<probes::VizSource>(9);
                   },
                   {"VIZ"}),
      refuses_bake("OfWeightsThatAreNone",
                   [](auto& params) {
                     params.op = probes::LightOperator::bounce;
                     params.bounce.weights.method = static_cast<probes::WeightMethod>(99);
                   },
                   {"weights"}),
      refuses_bake("OfAToleranceThatIsNone", [](auto& params) { params.solve.tolerance = nan; },
                   {"solver", "tolerance"}),
      refuses_bake("OfMinusOneIterations", [](auto& params) { params.solve.max_iterations = -1; },
                   {"solver", "iterations"}),
      refuses_bake("OfBouncesWithoutTolerance",
                   [](auto& params) {
                     params.op = probes::LightOperator::bounce;
                     params.bounce.tolerance = nan;
                   },
                   {"bounce", "tolerance"}),
  };
}

SSPHH_CONTRACTS(TransportBake, of_bakes());
SSPHH_CONTRACTS(Network, of_networks());
SSPHH_CONTRACTS(Update, of_updates());
SSPHH_CONTRACTS(Grid, of_grids());

}  // namespace
}  // namespace ssphh::test
