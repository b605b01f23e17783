/// Words of the tool, of files and of reports, both ways.

#include <gtest/gtest.h>

#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_set.h>

#include "error_message.h"
#include "random_set.h"

namespace ssphh::probes {
namespace {

template <class E>
void expect_names(const std::vector<std::string>& names) {
  EXPECT_EQ(names_of<E>(), names);
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(parse_enum<E>(names[i]), static_cast<E>(i)) << names[i];
  for (const char* other : {"", "none of these", "Path", "surfels"})
    EXPECT_EQ(parse_enum<E>(other), std::nullopt) << other;
}

TEST(Names, OfOperatorsAndMethodsAreThoseOfFiles) {
  expect_names<LightOperator>({"path", "surfel", "bounce"});
  expect_names<VizMethod>({"none", "path", "links"});
  expect_names<GenMode>({"full", "local"});
  expect_names<VizSource>({"intensity", "radiance"});
  expect_names<rays::PathSet>({"all", "diffuse"});
  expect_names<HierOperator>({"coefficient", "mean", "matrix", "raw"});
  expect_names<WeightMethod>({"distance", "trilinear", "mls", "fitted", "surface"});
  expect_names<LookupMethod>({"light", "irradiance"});
  expect_names<ProbeLayer>({"self", "neighbor", "sum"});
}

TEST(Names, OfWeightsChooseTheMethodAndNothingElse) {
  EXPECT_EQ(weights_named("trilinear").method, WeightMethod::trilinear);
  EXPECT_FALSE(weights_named("").method.has_value());
  EXPECT_NE(
      test::message_of([] { weights_named("linear"); }).find("distance, trilinear, mls, fitted, surface"),
      std::string::npos);
  EXPECT_EQ(weights_named("").chosen(true), WeightMethod::fitted);
  EXPECT_EQ(weights_named("").chosen(false), WeightMethod::mls);
  EXPECT_EQ(weights_named("distance").chosen(true), WeightMethod::distance);
}

TEST(ProbeSet, EdgesAreCountedOverAllProbes) {
  EXPECT_EQ(edge_count(ProbeSet()), 0u);
  EXPECT_EQ(edge_count(test::random_set(1, 4, 0)), 12u);
}

TEST(WeightList, HoldsAsManyAsItSays) {
  WeightList<2> list;
  list.add(3, 0.25f);
  list.add(7, 0.5f);
  EXPECT_NE(test::message_of([&] { list.add(8, 1); }).find("full"), std::string::npos);
  ASSERT_EQ(list.used().size(), 2u);
  EXPECT_EQ(list.used()[1], (ProbeWeight{7, 0.5f}));
  WeightList<2> other;
  other.add(3, 0.25f);
  EXPECT_FALSE(list == other);
  other.add(7, 0.5f);
  EXPECT_EQ(list, other);
}

}  // namespace
}  // namespace ssphh::probes
