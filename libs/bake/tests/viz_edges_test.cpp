/// Which edges VIZ keeps, in what order, and what their P is.

#include <gmock/gmock.h>

#include <ssphh/bake/viz.h>

#include "error_message.h"
#include "fake_source.h"

namespace ssphh::bake {
namespace {

TEST(VizTransfer, IsTheLuminanceOfTheMeanResponse) {
  sh::RadianceSh h(2);
  h[0] = 3.5449077f * vec3(0.2f, 0.5f, 0.9f);
  h[3] = vec3(7);
  EXPECT_NEAR(probes::transfer_coefficient(h), 0.2126f * 0.2f + 0.7152f * 0.5f + 0.0722f * 0.9f, 1e-5f);
}

/// Neighbours of probe 1 at 3, 1.5, 2 and 6 m, whose spheres of 0.5 m have P near (r / 2 d)²; the last is
/// around it.
class VizEdges : public testing::Test {
 protected:
  VizEdges() {
    set_.degree = 1;
    for (const vec3& p :
         {vec3(3, 0, 0), vec3(0), vec3(0, -1.5f, 0), vec3(0, 0, 2), vec3(6, 0, 0), vec3(0.1f, 0, 0)}) {
      set_.probes.emplace_back().position = p;
      set_.probes.back().radius = 0.5f;
    }
  }
  std::vector<int> kept(VizParams params) {
    params.source = probes::VizSource::radiance;
    edges_ = viz(test::FakeSource(), set_, 1, {.face_size = 16, .path = {.spp = 4}}, params);
    std::vector<int> from;
    for (const probes::Edge& edge : edges_) from.push_back(edge.from);
    return from;
  }

  probes::ProbeSet set_;
  std::vector<probes::Edge> edges_;
};

using testing::ElementsAre;

TEST_F(VizEdges, AreTheStrongestInTheOrderOfTheirNeighbours) {
  EXPECT_THAT(kept({}), ElementsAre(0, 2, 3, 4, 5));
  EXPECT_THAT(kept({.neighbors = 9}), ElementsAre(0, 2, 3, 4, 5)) << "all that there are";
  EXPECT_THAT(kept({.neighbors = 3}), ElementsAre(2, 3, 5));
  EXPECT_THAT(kept({.neighbors = 2}), ElementsAre(2, 5));
  EXPECT_THAT(kept({.neighbors = 0}), ElementsAre());
}

TEST_F(VizEdges, LieAboveTheThreshold) {
  kept({});
  const float third = edges_[2].transfer;
  EXPECT_NEAR(third, 1.0f / 64, 0.002f);
  EXPECT_THAT(kept({.threshold = third}), ElementsAre(2, 5)) << "not at it";
  EXPECT_THAT(kept({.threshold = 0.999f * third}), ElementsAre(2, 3, 5));
}

TEST_F(VizEdges, OfNoProbeAreRefused) {
  EXPECT_EQ(test::message_of([&] { viz(test::FakeSource(), set_, set_.probes.size(), {}, {}); }),
            "VIZ: there is no probe of that index");
}

TEST_F(VizEdges, OfASphereAroundTheProbeHaveAPOfOne) {
  kept({});
  EXPECT_NEAR(edges_[4].transfer, 1, 1e-5f);
}

TEST(VizMatrices, AreRefusedBeforeTheyTakeMoreThan4GiB) {
  // 48 chunks of 121² colours each of each neighbour: 4 GiB / 8433216 B = 509.3 of them.
  test::FakeSource source;
  source.free = [](const vec3&, const vec3&) { return false; };
  const rays::CubeRequest request{.face_size = 1, .path = {.spp = 1}};
  probes::ProbeSet set;
  set.degree = 10;
  for (int i = 0; i < 510; ++i) set.probes.push_back({"", vec3(static_cast<float>(i)), 0.1f, {}, {}, {}, {}});
  const auto said = [&](bool matrix) {
    return test::message_of([&] { viz(source, set, 0, request, {.matrix = matrix}); });
  };
  EXPECT_EQ(said(true), "no error");
  set.probes.push_back(set.probes.back());
  EXPECT_EQ(
      said(true),
      "VIZ: the transfer matrices of that many probes do not fit into 4 GiB (use a lower degree or fewer "
      "probes)");
  EXPECT_EQ(said(false), "no error") << "coefficients alone take little";
}

}  // namespace
}  // namespace ssphh::bake
