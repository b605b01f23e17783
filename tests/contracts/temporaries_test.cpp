/// What keeps a reference takes no temporary: such a call does not compile.

#include <type_traits>

#include <gtest/gtest.h>

#include <ssphh/farm/farm_bake.h>
#include <ssphh/gi/lookup.h>
#include <ssphh/gi/relight_session.h>
#include <ssphh/scene/posed_world.h>
#include <ssphh/shading/lights.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::test {
namespace {

using gi::LookupParams;
using gi::ProbeSet;
using scene::Scene;
using trace::PathTracer;
using trace::TransportScene;
using Places = std::vector<gi::ProbePlace>;
using Matrices = std::vector<mat4>;

/// Whether `T` can be made from an object that stays and the rest, and not from one that goes.
template <class T, class Kept, class... Rest>
constexpr bool only_of_what_stays =
    std::is_constructible_v<T, const Kept&, Rest...>&& std::is_constructible_v<T, Kept&, Rest...> &&
    !std::is_constructible_v<T, Kept, Rest...> && !std::is_constructible_v<T, const Kept, Rest...>;

TEST(Temporaries, OfScenesAreRefusedByWhatReadsThemLater) {
  EXPECT_TRUE((only_of_what_stays<PathTracer, Scene>));
  EXPECT_TRUE((only_of_what_stays<PathTracer, Scene, float>));
  EXPECT_TRUE((only_of_what_stays<TransportScene, Scene>));
  EXPECT_TRUE((only_of_what_stays<TransportScene, Scene, trace::TransportOptions>));
  EXPECT_TRUE((only_of_what_stays<trace::SceneGeometry, Scene>));
  EXPECT_TRUE((std::is_constructible_v<PathTracer, trace::SharedGeometry, Scene&>));
  EXPECT_FALSE((std::is_constructible_v<PathTracer, trace::SharedGeometry, Scene>));
  EXPECT_TRUE((std::is_constructible_v<TransportScene, trace::SharedGeometry, Scene&>));
  EXPECT_FALSE((std::is_constructible_v<TransportScene, trace::SharedGeometry, Scene>));
  EXPECT_TRUE((only_of_what_stays<shading::LightSet, Scene, Matrices>));
}

TEST(Temporaries, OfSourcesAreRefusedByWhatAsksThemLater) {
  EXPECT_TRUE((only_of_what_stays<gi::RelightSession, TransportScene, Places>));
  EXPECT_TRUE((only_of_what_stays<gi::RelightSession, TransportScene, Places, gi::RelightParams, float>));
  EXPECT_TRUE(
      (only_of_what_stays<gi::TransportNetwork, TransportScene, std::span<const vec3>, gi::TransportParams>));
  EXPECT_TRUE((only_of_what_stays<scene::PosedWorld, TransportScene, float>));
  EXPECT_TRUE((only_of_what_stays<scene::PosedWorld, TransportScene, Matrices&>));
  EXPECT_TRUE((only_of_what_stays<gi::SurfelSet, TransportScene, float>));
}

TEST(Temporaries, OfTracersAreRefusedByLookups) {
  EXPECT_TRUE((std::is_constructible_v<gi::IrradianceLookup, ProbeSet, PathTracer&, LookupParams>));
  EXPECT_FALSE((std::is_constructible_v<gi::IrradianceLookup, ProbeSet, PathTracer, LookupParams>));
  EXPECT_TRUE((std::is_constructible_v<gi::LightLookup, ProbeSet, PathTracer&>));
  EXPECT_FALSE((std::is_constructible_v<gi::LightLookup, ProbeSet, PathTracer>));
}

TEST(Temporaries, OfNetworksAreRefusedByWhatFollowsThem) {
  EXPECT_TRUE((std::is_constructible_v<gi::BounceOperator, gi::TransportNetwork&, TransportScene&, int>));
  EXPECT_FALSE((std::is_constructible_v<gi::BounceOperator, gi::TransportNetwork, TransportScene&, int>));
  EXPECT_FALSE((std::is_constructible_v<gi::BounceOperator, gi::TransportNetwork&, TransportScene, int>));
}

TEST(Temporaries, OfOptionsOrScenesAreRefusedByTheFarmsCrew) {
  using farm::FarmCrew;
  using farm::FarmOptions;
  EXPECT_TRUE((std::is_constructible_v<FarmCrew, FarmOptions&, Scene&, float>));
  EXPECT_FALSE((std::is_constructible_v<FarmCrew, FarmOptions, Scene&, float>));
  EXPECT_FALSE((std::is_constructible_v<FarmCrew, FarmOptions&, Scene, float>));
  EXPECT_FALSE((std::is_constructible_v<FarmCrew, FarmOptions, Scene, float>));
}

template <class List>
concept LendsItsWeights = requires(List&& list) {
  std::forward<List>(list).used().begin();
};

TEST(Temporaries, OfWeightListsLendNoWeights) {
  EXPECT_TRUE(LendsItsWeights<gi::ProbeWeights&>);
  EXPECT_TRUE(LendsItsWeights<const gi::ProbeWeights&>);
  EXPECT_FALSE(LendsItsWeights<gi::ProbeWeights>);
  EXPECT_FALSE(LendsItsWeights<const gi::ProbeWeights>);
}

}  // namespace
}  // namespace ssphh::test
