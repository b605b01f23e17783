#include "property.h"
#include "set_generators.h"

namespace ssphh::probes {
namespace {

using namespace ssphh::test;

ProbeSet lit(ProbeSet set, const HierParams& params) {
  hier(set, params);
  return set;
}

double apart(const sh::RadianceSh& a, const sh::RadianceSh& b) {
  float worst = a.values.size() == b.values.size() ? 0 : INFINITY;
  for (std::size_t k = 0; k < std::min(a.values.size(), b.values.size()); ++k)
    worst = std::max(worst, max_component(glm::abs(a.values[k] - b.values[k])));
  return static_cast<double>(worst);
}

TEST(HierProperty, ProbesInAnotherOrderGetTheSameLight) {
  EXPECT_TRUE(for_all(set_shapes(1, 7), hier_params(), seeds())
                  .cases(60)
                  .holds([](const SetShape& shape, const HierParams& params, std::uint64_t seed) {
                    const std::vector<std::size_t> order = random_order(std::size_t(shape.probes), seed);
                    const HierParams fit = fitting(params, shape);
                    const ProbeSet set = lit(shape.make(), fit),
                                   other = lit(permuted(shape.make(), order), fit);
                    // Neighbours are added by P, whatever their places: to the bit.
                    for (std::size_t i = 0; i < order.size(); ++i) {
                      if (other.hierarchy->sum[i] != set.hierarchy->sum[order[i]] ||
                          other.hierarchy->neighbor[i] != set.hierarchy->neighbor[order[i]])
                        return false;
                    }
                    return true;
                  }));
}

TEST(HierProperty, LightTimesKGivesNeighboursTimesKToTheBit) {
  EXPECT_TRUE(for_all(set_shapes(1, 6), hier_params(), integers(-20, 19))
                  .cases(60)
                  .holds([](const SetShape& shape, const HierParams& params, int exponent) {
                    const HierParams fit = fitting(params, shape);
                    const float k = std::ldexp(1.0f, exponent);
                    ProbeSet set = shape.make();
                    for (LightGroup& group : set.light_groups) group.scale = vec3(1);
                    merge_groups(set);
                    ProbeSet brighter = set;
                    for (const LightGroup& group : set.light_groups) relight(brighter, group.name, vec3(k));
                    set = lit(set, fit), brighter = lit(brighter, fit);
                    for (std::size_t i = 0; i < set.probes.size(); ++i) {
                      sh::RadianceSh expected = set.hierarchy->sum[i];
                      expected *= vec3(k);
                      if (brighter.hierarchy->sum[i] != expected) return false;
                    }
                    return true;
                  }));
}

TEST(HierProperty, GroupsAddUpAndAGroupMayBeSplitInTwo) {
  EXPECT_TRUE(for_all(set_shapes(1, 6), hier_params())
                  .cases(60)
                  .holds([](const SetShape& shape, const HierParams& params) {
                    const HierParams fit = fitting(params, shape);
                    const ProbeSet whole = lit(shape.make(), fit);
                    // One group alone at a time.
                    std::vector<sh::RadianceSh> sums(whole.probes.size(), sh::RadianceSh(shape.degree));
                    for (const LightGroup& on : whole.light_groups) {
                      ProbeSet alone = whole;
                      for (const LightGroup& group : whole.light_groups)
                        relight(alone, group.name, group.name == on.name ? group.scale : vec3(0));
                      hier(alone, fit);
                      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += alone.hierarchy->sum[i];
                    }
                    // The last group twice, at half of its power each.
                    ProbeSet split = shape.make();
                    split.light_groups.back().scale *= 0.5f;
                    split.light_groups.push_back({"twin", split.light_groups.back().scale});
                    for (Probe& probe : split.probes) probe.groups.push_back(GroupLight(probe.groups.back()));
                    merge_groups(split);
                    hier(split, fit);
                    double worst = 0;
                    for (std::size_t i = 0; i < sums.size(); ++i) {
                      worst = std::max({worst, apart(sums[i], whole.hierarchy->sum[i]),
                                        apart(split.hierarchy->sum[i], whole.hierarchy->sum[i])});
                    }
                    // Sums of up to 5 · 25 products of numbers up to 6.
                    return at_most(worst, 1e-4);
                  }));
}

TEST(HierProperty, FewerNeighboursOrAHigherThresholdChooseAmongTheSameOnes) {
  EXPECT_TRUE(for_all(set_shapes(1, 8, 1), hier_params(), hier_params())
                  .cases(100)
                  .holds([](const SetShape& shape, const HierParams& a, const HierParams& b) {
                    const ProbeSet set = shape.make();
                    HierParams fewer = a;
                    fewer.threshold = std::max(a.threshold, b.threshold);
                    if (b.neighbors >= 0)
                      fewer.neighbors = a.neighbors < 0 ? b.neighbors : std::min(a.neighbors, b.neighbors);
                    for (const Probe& probe : set.probes) {
                      const std::vector<int> most = select_neighbors(probe, a),
                                             least = select_neighbors(probe, fewer);
                      if (least.size() > most.size() || !std::equal(least.begin(), least.end(), most.begin()))
                        return false;
                    }
                    return true;
                  }));
}

}  // namespace
}  // namespace ssphh::probes
