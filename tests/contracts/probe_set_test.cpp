/// Contracts of what libs/gi does with sets of probes.

#include <ssphh/gi/bake.h>
#include <ssphh/gi/fitted_weights.h>
#include <ssphh/gi/hier.h>
#include <ssphh/gi/init.h>
#include <ssphh/gi/lookup_error.h>
#include <ssphh/gi/lookup_weights.h>
#include <ssphh/gi/methods/table.h>
#include <ssphh/gi/nearest.h>
#include <ssphh/gi/probe_file.h>
#include <ssphh/scene/builtin.h>

#include "contract.h"
#include "probe_sets.h"

namespace ssphh::test {
namespace {

using gi::ProbeSet;

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

gi::LookupParams wanting_neighbors() {
  gi::LookupParams params;
  params.layer = gi::ProbeLayer::neighbor;
  return params;
}
gi::WeightParams wanting_fitted() {
  gi::WeightParams params;
  params.method = gi::WeightMethod::fitted;
  return params;
}

gi::WeightParams with_spacing(float spacing) {
  gi::WeightParams params;
  params.spacing = spacing;
  return params;
}

void give_higher_degree(ProbeSet& set) {
  set.probes[1].reflected = sh::RadianceSh(4);
  set.probes[1].groups[0].reflected = sh::RadianceSh(4);
}
void forget_merging(ProbeSet& set) {
  for (gi::Probe& probe : set.probes) probe.reflected = probe.self = {};
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
      refuses_set("Lookup", "OfInfiniteLight", [](ProbeSet& set) { set.probes[2].reflected[3].y = infinite; },
                  look_up, {"probe 2", "not finite"}),
      refuses_set("Lookup", "OfAHierarchyOfOtherProbes",
                  [](ProbeSet& set) { set.hierarchy = gi::Hierarchy{}; }, look_up, {"hierarchy"}),
      refuses_set("Lookup", "OfAHierarchyOfAnotherDegree",
                  [](ProbeSet& set) {
                    gi::hier(set, {});
                    set.hierarchy->neighbor[1] = sh::RadianceSh(1);
                  },
                  look_up, {"probe 1", "4 RGB coefficients"}),
      refuses("Lookup", "OfAnEmptySet", [] { gi::surface_light({}, {}); }, {"empty", "bake"}),
      refuses("Lookup", "OfALayerWithoutHierarchy",
              [] { gi::surface_light(sound_set(), wanting_neighbors()); }, {"no hierarchy"}),
      refuses("IrradianceLookup", "WithoutWeights",
              [] { gi::IrradianceLookup(sound_set(), std::unique_ptr<gi::LookupWeights>()); },
              {"no weights"}),
      refuses("IrradianceLookup", "WhoseWeightsNameNoProbe",
              [] {
                struct Stray : gi::LookupWeights {
                  gi::ProbeWeights at(const scene::SurfacePoint&) const override {
                    gi::ProbeWeights weights;
                    weights.add(7, 1);
                    return weights;
                  }
                  std::size_t bytes() const override { return 0; }
                };
                gi::IrradianceLookup(sound_set(), std::make_unique<Stray>()).irradiance({});
              },
              {"lookup weights", "not there"}),
      gives("IrradianceLookup", "AtNoPlace",
            [] {
              lookup_of(sound_set())->irradiance({vec3(nan), vec3(0, 1, 0)});
            }),
      refuses("MakeWeights", "WithoutProbes", [] { gi::make_weights({}, all_seen); }, {"empty"}),
      refuses("MakeWeights", "WithoutSight", [] { gi::make_weights(std::vector<vec3>(2), nullptr); },
              {"sees"}),
      refuses("MakeWeights", "OfAPlaceThatIsNone",
              [] {
                gi::make_weights(std::vector<vec3>{vec3(0), vec3(nan)}, all_seen);
              },
              {"not finite"}),
      refuses("MakeWeights", "OfASpacingThatIsNone",
              [] { gi::make_weights(std::vector<vec3>(2), all_seen, with_spacing(nan)); }, {"spacing"}),
      refuses("MakeWeights", "FittedWithoutPoints",
              [] { gi::make_weights(std::vector<vec3>(2), all_seen, wanting_fitted()); },
              {"no fitted weights"}),
      refuses("MakeWeights", "OfPointsWithoutTheirWeights",
              [] {
                gi::FittedPoints fitted;
                fitted.points.resize(2);
                gi::make_weights(std::vector<vec3>(2), all_seen, {}, &fitted);
              },
              {"fitted points", "weights"}),
      refuses("MakeWeights", "OfAPointWithManyWeights",
              [] {
                gi::FittedPoints fitted;
                fitted.points.resize(1);
                fitted.weights.resize(1);
                fitted.weights[0].count = 17;
                gi::make_weights(std::vector<vec3>(2), all_seen, {}, &fitted);
              },
              {"fitted point 0", "17"}),
      refuses("MakeWeights", "OfAPointThatNamesNoProbe",
              [] {
                gi::FittedPoints fitted;
                fitted.points.resize(1);
                fitted.weights.resize(1);
                fitted.weights[0].add(2, 1);
                gi::make_weights(std::vector<vec3>(2), all_seen, {}, &fitted);
              },
              {"fitted point 0", "probe 2"}),
      refuses(
          "WeightList", "ThatIsFull",
          [] {
            auto list = std::make_unique<gi::WeightList<2>>();
            list->add(0, 0.25f), list->add(1, 0.75f);
            return list;
          },
          [](gi::WeightList<2>& list) { list.add(2, 1); }, {"full"},
          [](gi::WeightList<2>& list) {
            EXPECT_THAT(list.used(),
                        testing::ElementsAre(gi::ProbeWeight{0, 0.25f}, gi::ProbeWeight{1, 0.75f}));
          }),
      refuses("WeightsNamed", "OfNoMethod", [] { gi::weights_named("best"); }, {"best", "mls"}),
      refuses("NearestPoints", "OfAPointThatIsNone",
              [] { gi::NearestPoints(std::vector<vec3>(20, vec3(nan))); }, {"not finite"}),
      gives("NearestPoints", "FoundNearNoPlace",
            [] {
              std::array<gi::Near, 3> near;
              EXPECT_EQ(gi::NearestPoints(std::vector<vec3>(2)).find(vec3(nan), near), 0);
            }),
      refuses("LookupError", "OfOtherNumbers",
              [] { gi::lookup_error(std::vector<vec3>(2), std::vector<scene::IrradianceEstimate>(3)); },
              {"each truth"}),
      refuses("FitNonNegative", "OfRowsThatAreTooShort",
              [] {
                gi::fit_non_negative(std::vector<double>(3), std::vector<double>(2), std::vector<double>(2),
                                     1);
              },
              {"matching sizes"}),
      refuses("SpreadPoints", "ToNone", [] { gi::spread_points({}, 0); }, {"at least one"}),
      refuses("SpreadPoints", "OfAPlaceThatIsNone",
              [] {
                std::vector<scene::SurfacePoint> points(3);
                points[2].position.x = infinite;
                gi::spread_points(points, 1);
              },
              {"not finite"}),
      refuses("FindMethod", "OfNoName", [] { gi::find_method("magic"); }, {"magic", "choose one of"}),
  };
}

std::vector<Contract> of_sets() {
  const auto none = [](ProbeSet&) {};
  const auto merge = [](ProbeSet& set) { gi::merge_groups(set); };
  const auto dim = [](ProbeSet& set) { gi::relight(set, "lamp", vec3(0.5f)); };
  const auto link = [](ProbeSet& set) { gi::hier(set, {}); };
  const auto multiply = [](ProbeSet& set) { gi::hier(set, {.op = gi::HierOperator::matrix}); };
  const auto write = [](ProbeSet& set) { gi::probes_to_binary(set); };
  return {
      refuses_set("MergeGroups", "OfAFunctionOfHigherDegree", give_higher_degree, merge, {"probe 1", "25"}),
      refuses_set("MergeGroups", "OfMoreGroupsThanTheSetHas", [](ProbeSet& set) { set.light_groups.clear(); },
                  merge, {"probe 0", "1 groups"}),
      refuses_set("MergeGroups", "OfDegreeEleven", [](ProbeSet& set) { set.degree = 11; }, merge, {"0..10"}),
      refuses_set("Relight", "OfAFunctionOfHigherDegree", give_higher_degree, dim, {"probe 1", "25"}),
      refuses_set("Relight", "OfNoGroup", none, [](ProbeSet& set) { gi::relight(set, "sun", vec3(1)); },
                  {"sun", "lamp"}),
      refuses_set("Relight", "ByAFactorThatIsNoNumber", none,
                  [](ProbeSet& set) { gi::relight(set, "lamp", vec3(nan)); }, {"lamp", "scale"}),
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
                  [](ProbeSet& set) { gi::hier(set, {.threshold = nan}); }, {"threshold"}),
      refuses_set(
          "HierContraction", "OfAnEdgeFromNoProbe", [](ProbeSet& set) { set.probes[1].edges[0].from = -1; },
          [](ProbeSet& set) { gi::hier_contraction(set, {.op = gi::HierOperator::mean}); },
          {"probe 1", "no probe"}),
      gives("Hier", "OfAnEmptySet",
            [] {
              ProbeSet set;
              EXPECT_EQ(gi::hier(set, {}), 0u);
            }),
      refuses_set("ProbesToBinary", "OfAFunctionOfHigherDegree", give_higher_degree, write,
                  {"/probes/1/groups/0/reflected", "25"}),
      refuses_set("ProbesToJson", "OfAFunctionOfHigherDegree", give_higher_degree,
                  [](ProbeSet& set) { gi::probes_to_json(set); }, {"/probes/1"}),
      refuses_set("ProbesToBinary", "OfAnEdgeFromNoProbe",
                  [](ProbeSet& set) { set.probes[1].edges[0].from = 3; }, write, {"/probes/1/edges/0/from"}),
      refuses("ProbesFromBinary", "OfNoBytes", [] { gi::probes_from_binary({}, "x.sphl"); }, {"x.sphl"}),
      refuses("ReadProbeFile", "WithAnUnknownEnding", [] { gi::read_probe_file("x.png"); }, {"x.png"}),
      refuses("InitFromScene", "OfDegreeEleven", [] { gi::init_from_scene(scene::make_builtin("box"), 11); },
              {"degree 11", "0..10"}),
      refuses("InitFromScene", "WithoutSphls", [] { gi::init_from_scene({}, 2); }, {"no enabled SPHL"}),
      refuses("InitFromPlacement", "OfAPlaceThatIsNone",
              [] {
                gi::Placement placement;
                placement.probes.push_back({"lost", vec3(nan)});
                gi::init_from_placement({}, placement, 2);
              },
              {"lost", "finite"}),
  };
}

SSPHH_CONTRACTS(Lookup, of_lookups());
SSPHH_CONTRACTS(ProbeSet, of_sets());

}  // namespace
}  // namespace ssphh::test
