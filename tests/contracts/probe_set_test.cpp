/// Contracts of what is done with sets of probes.

#include <ssphh/bake/bake.h>
#include <ssphh/geometry/nearest.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/study/lookup_error.h>
#include <ssphh/transport/fitted_weights.h>

#include "contract.h"
#include "probe_sets.h"

namespace ssphh::test {
namespace {

using probes::ProbeSet;

/// A sound set with one thing wrong.
std::function<std::unique_ptr<ProbeSet>()> spoilt(std::function<void(ProbeSet&)> spoil) {
  return [spoil = std::move(spoil)] {
    auto set = std::make_unique<ProbeSet>(linked_set());
    spoil(*set);
    return set;
  };
}

/// A row for an entry that must refuse the set and leave it as it was.
Contract refuses_set(const std::string& entry, const std::string& given, std::function<void(ProbeSet&)> spoil,
                     std::function<void(ProbeSet&)> call, std::vector<std::string> words) {
  return {entry, given, [=] {
            const auto set = spoilt(spoil)();
            const ProbeSet before = *set;
            expect_refusal([&] { call(*set); }, words);
            EXPECT_EQ(*set, before);
          }};
}

probes::LookupParams wanting_neighbors() {
  probes::LookupParams params;
  params.layer = probes::ProbeLayer::neighbor;
  return params;
}
probes::WeightParams wanting_fitted() {
  probes::WeightParams params;
  params.method = probes::WeightMethod::fitted;
  return params;
}

probes::WeightParams with_spacing(float spacing) {
  probes::WeightParams params;
  params.spacing = spacing;
  return params;
}

void give_higher_degree(ProbeSet& set) {
  set.probes[1].reflected = sh::RadianceSh(4);
  set.probes[1].groups[0].reflected = sh::RadianceSh(4);
}
void forget_merging(ProbeSet& set) {
  for (probes::Probe& probe : set.probes) probe.reflected = probe.self = {};
}

std::vector<Contract> of_lookups() {
  const auto look_up = [](ProbeSet& set) { lookup_of(set); };
  return {
      refuses_set("Lookup", "OfAFunctionOfHigherDegree", give_higher_degree, look_up,
                  {"probe 1", "25 RGB coefficients", "9"}),
      refuses_set("Lookup", "OfGroupsThatWereNotMerged", forget_merging, look_up,
                  {"probe 0", "merge_groups"}),
      refuses_set("Lookup", "OfDegreeMinusOne", [](ProbeSet& set) { set.degree = -1; }, look_up,
                  {"probe set", "0..10"}),
      refuses_set("Lookup", "OfInfiniteLight", [](ProbeSet& set) { set.probes[2].reflected[3].y = infinity; },
                  look_up, {"probe 2", "not finite"}),
      refuses_set("Lookup", "OfAHierarchyOfOtherProbes",
                  [](ProbeSet& set) { set.hierarchy = probes::Hierarchy{}; }, look_up, {"hierarchy"}),
      refuses_set("Lookup", "OfAHierarchyOfAnotherDegree",
                  [](ProbeSet& set) {
                    probes::hier(set, {});
                    set.hierarchy->neighbor[1] = sh::RadianceSh(1);
                  },
                  look_up, {"probe 1", "4 RGB coefficients"}),
      refuses("Lookup", "OfAnEmptySet", [] { probes::surface_light({}, {}); }, {"empty", "bake"}),
      refuses("Lookup", "OfALayerWithoutHierarchy",
              [] { probes::surface_light(sound_set(), wanting_neighbors()); }, {"no hierarchy"}),
      refuses("IrradianceLookup", "WithoutWeights",
              [] { probes::IrradianceLookup(sound_set(), std::unique_ptr<probes::LookupWeights>()); },
              {"no weights"}),
      refuses("IrradianceLookup", "WhoseWeightsNameNoProbe",
              [] {
                struct Stray : probes::LookupWeights {
                  probes::ProbeWeights at(const rays::SurfacePoint&) const override {
                    probes::ProbeWeights weights;
                    weights.add(7, 1);
                    return weights;
                  }
                  std::size_t bytes() const override { return 0; }
                };
                probes::IrradianceLookup(sound_set(), std::make_unique<Stray>()).irradiance({});
              },
              {"lookup weights", "not there"}),
      refuses("IrradianceLookup", "ByAWeightThatNamesNoProbe",
              [] {
                probes::ProbeWeights weights;
                weights.add(7, 1);
                lookup_of(sound_set())->irradiance({}, weights);
              },
              {"lookup weights", "not there"}),
      gives("IrradianceLookup", "AtNoPlace",
            [] {
              lookup_of(sound_set())->irradiance({vec3(nan), vec3(0, 1, 0)});
            }),
      refuses("MakeWeights", "WithoutProbes", [] { probes::make_weights({}, all_seen); }, {"empty"}),
      refuses("MakeVisibleWeights", "WithoutProbes", [] { probes::make_visible_weights({}); }, {"empty"}),
      refuses("MakeVisibleWeights", "OfAPlaceThatIsNone",
              [] {
                probes::make_visible_weights(std::vector<vec3>{vec3(0), vec3(nan)});
              },
              {"not finite"}),
      refuses("MakeWeights", "WithoutSight", [] { probes::make_weights(std::vector<vec3>(2), nullptr); },
              {"sees"}),
      refuses("MakeWeights", "OfAPlaceThatIsNone",
              [] {
                probes::make_weights(std::vector<vec3>{vec3(0), vec3(nan)}, all_seen);
              },
              {"not finite"}),
      refuses("MakeWeights", "OfASpacingThatIsNone",
              [] { probes::make_weights(std::vector<vec3>(2), all_seen, with_spacing(nan)); }, {"spacing"}),
      refuses("MakeWeights", "FittedWithoutPoints",
              [] { probes::make_weights(std::vector<vec3>(2), all_seen, wanting_fitted()); },
              {"no fitted weights"}),
      refuses("MakeWeights", "OfPointsWithoutTheirWeights",
              [] {
                probes::FittedPoints fitted;
                fitted.points.resize(2);
                probes::make_weights(std::vector<vec3>(2), all_seen, {}, &fitted);
              },
              {"fitted points", "weights"}),
      refuses("MakeWeights", "OfAPointWithManyWeights",
              [] {
                probes::FittedPoints fitted;
                fitted.points.resize(1);
                fitted.weights.resize(1);
                fitted.weights[0].count = 17;
                probes::make_weights(std::vector<vec3>(2), all_seen, {}, &fitted);
              },
              {"fitted point 0", "17"}),
      refuses("MakeWeights", "OfAPointThatNamesNoProbe",
              [] {
                probes::FittedPoints fitted;
                fitted.points.resize(1);
                fitted.weights.resize(1);
                fitted.weights[0].add(2, 1);
                probes::make_weights(std::vector<vec3>(2), all_seen, {}, &fitted);
              },
              {"fitted point 0", "probe 2"}),
      refuses(
          "WeightList", "ThatIsFull",
          [] {
            auto list = std::make_unique<probes::WeightList<2>>();
            list->add(0, 0.25f), list->add(1, 0.75f);
            return list;
          },
          [](probes::WeightList<2>& list) { list.add(2, 1); }, {"full"},
          [](probes::WeightList<2>& list) {
            EXPECT_THAT(list.used(),
                        testing::ElementsAre(probes::ProbeWeight{0, 0.25f}, probes::ProbeWeight{1, 0.75f}));
          }),
      refuses("WeightsNamed", "OfNoMethod", [] { probes::weights_named("best"); }, {"best", "mls"}),
      refuses("NearestPoints", "OfAPointThatIsNone",
              [] { geometry::NearestPoints(std::vector<vec3>(20, vec3(nan))); }, {"not finite"}),
      gives("NearestPoints", "FoundNearNoPlace",
            [] {
              std::array<geometry::Near, 3> near;
              EXPECT_EQ(geometry::NearestPoints(std::vector<vec3>(2)).find(vec3(nan), near), 0);
            }),
      refuses("LookupError", "OfOtherNumbers",
              [] { study::lookup_error(std::vector<vec3>(2), std::vector<rays::IrradianceEstimate>(3)); },
              {"each truth"}),
      refuses("FitNonNegative", "OfRowsThatAreTooShort",
              [] {
                transport::fit_non_negative(std::vector<double>(3), std::vector<double>(2),
                                            std::vector<double>(2), 1);
              },
              {"matching sizes"}),
      refuses("SpreadPoints", "ToNone", [] { transport::spread_points({}, 0); }, {"at least one"}),
      refuses("SpreadPoints", "OfAPlaceThatIsNone",
              [] {
                std::vector<rays::SurfacePoint> points(3);
                points[2].position.x = infinity;
                transport::spread_points(points, 1);
              },
              {"not finite"}),
      refuses("FindMethod", "OfNoName", [] { methods::find_method("magic"); }, {"magic", "choose one of"}),
  };
}

std::vector<Contract> of_sets() {
  const auto none = [](ProbeSet&) {};
  const auto merge = [](ProbeSet& set) { probes::merge_groups(set); };
  const auto dim = [](ProbeSet& set) { probes::relight(set, "lamp", vec3(0.5f)); };
  const auto link = [](ProbeSet& set) { probes::hier(set, {}); };
  const auto multiply = [](ProbeSet& set) { probes::hier(set, {.op = probes::HierOperator::matrix}); };
  const auto write = [](ProbeSet& set) { probes::probes_to_binary(set); };
  return {
      refuses_set("MergeGroups", "OfAFunctionOfHigherDegree", give_higher_degree, merge, {"probe 1", "25"}),
      refuses_set("MergeGroups", "OfMoreGroupsThanTheSetHas", [](ProbeSet& set) { set.light_groups.clear(); },
                  merge, {"probe 0", "1 groups"}),
      refuses_set("MergeGroups", "OfDegreeEleven", [](ProbeSet& set) { set.degree = 11; }, merge, {"0..10"}),
      refuses_set("Relight", "OfAFunctionOfHigherDegree", give_higher_degree, dim, {"probe 1", "25"}),
      refuses_set("Relight", "OfNoGroup", none, [](ProbeSet& set) { probes::relight(set, "sun", vec3(1)); },
                  {"sun", "lamp"}),
      refuses_set("Relight", "ByAFactorThatIsNoNumber", none,
                  [](ProbeSet& set) { probes::relight(set, "lamp", vec3(nan)); }, {"lamp", "scale"}),
      refuses_set("Hier", "OfGroupsThatWereNotMerged", forget_merging, link, {"probe 0", "merge_groups"}),
      refuses_set("Hier", "OfAnEdgeFromNoProbe", [](ProbeSet& set) { set.probes[1].edges[0].from = 3; }, link,
                  {"probe 1", "no probe"}),
      refuses_set("Hier", "OfAnEdgeOfAnotherDegree",
                  [](ProbeSet& set) { set.probes[1].edges[0].h = sh::RadianceSh(3); }, link,
                  {"probe 1", "edge", "degree"}),
      refuses_set("Hier", "OfAMatrixOfAnotherDegree",
                  [](ProbeSet& set) { set.probes[1].edges[0].matrix = sh::TransferMatrix(1, 2); }, multiply,
                  {"probe 1", "matrix"}),
      refuses_set("Hier", "WithoutMatrices", [](ProbeSet& set) { set.probes[1].edges[0].matrix = {}; },
                  multiply, {"matrices", "--viz-transfer"}),
      refuses_set("Hier", "OfAThresholdThatIsNoNumber", none,
                  [](ProbeSet& set) { probes::hier(set, {.threshold = nan}); }, {"threshold"}),
      refuses_set(
          "HierContraction", "OfAnEdgeFromNoProbe", [](ProbeSet& set) { set.probes[1].edges[0].from = -1; },
          [](ProbeSet& set) { probes::hier_contraction(set, {.op = probes::HierOperator::mean}); },
          {"probe 1", "no probe"}),
      gives("Hier", "OfAnEmptySet",
            [] {
              ProbeSet set;
              EXPECT_EQ(probes::hier(set, {}), 0u);
            }),
      refuses_set("ProbesToBinary", "OfAFunctionOfHigherDegree", give_higher_degree, write,
                  {"/probes/1/groups/0/reflected", "25"}),
      refuses_set("ProbesToJson", "OfAFunctionOfHigherDegree", give_higher_degree,
                  [](ProbeSet& set) { probes::probes_to_json(set); }, {"/probes/1"}),
      refuses_set("ProbesToBinary", "OfAnEdgeFromNoProbe",
                  [](ProbeSet& set) { set.probes[1].edges[0].from = 3; }, write, {"/probes/1/edges/0/from"}),
      refuses("ProbesFromBinary", "OfNoBytes", [] { probes::probes_from_binary({}, "x.sphl"); }, {"x.sphl"}),
      refuses("ReadProbeFile", "WithAnUnknownEnding", [] { probes::read_probe_file("x.png"); }, {"x.png"}),
      gives("DarkSet", "OfPlacesWithoutAScene",
            [] {
              const ProbeSet set = probes::dark_set(std::vector<scene::ProbePlace>{{"a", vec3(1, 2, 3)}}, 3);
              ASSERT_EQ(set.probes.size(), 1u);
              EXPECT_EQ(set.probes[0].name, "a");
              EXPECT_EQ(set.probes[0].position, vec3(1, 2, 3));
              EXPECT_EQ(set.degree, 3);
            }),
      refuses("DarkSet", "OfDegreeMinusOne", [] { probes::dark_set({}, -1); }, {"degree -1", "0..10"}),
      refuses("DarkSet", "OfAPlaceWithoutARadius",
              [] {
                probes::dark_set(std::vector<scene::ProbePlace>{{"flat", vec3(0), 0}}, 2);
              },
              {"flat", "radius"}),
      refuses("InitFromScene", "OfDegreeEleven",
              [] { place::init_from_scene(scene::make_builtin("box"), 11); }, {"degree 11", "0..10"}),
      refuses("InitFromScene", "WithoutSphls", [] { place::init_from_scene({}, 2); }, {"no enabled SPHL"}),
      refuses("InitFromPlacement", "OfAPlaceThatIsNone",
              [] {
                place::Placement placement;
                placement.probes.push_back({"lost", vec3(nan)});
                place::init_from_placement({}, placement, 2);
              },
              {"lost", "finite"}),
  };
}

SSPHH_CONTRACTS(Lookup, of_lookups());
SSPHH_CONTRACTS(ProbeSet, of_sets());

}  // namespace
}  // namespace ssphh::test
