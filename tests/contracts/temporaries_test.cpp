/// What keeps a reference takes no temporary: such a call does not compile.

#include <type_traits>

#include <gtest/gtest.h>

#include <ssphh/farm/farm_bake.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/shading/lights.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/bounce.h>
#include <ssphh/transport/network.h>
#include <ssphh/transport/relight_session.h>

namespace ssphh::test {
namespace {

using probes::LookupParams;
using probes::ProbeSet;
using scene::Scene;
using trace::PathTracer;
using trace::TransportScene;
using Places = std::vector<scene::ProbePlace>;
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
  EXPECT_TRUE((only_of_what_stays<transport::RelightSession, TransportScene, Places>));
  EXPECT_TRUE((only_of_what_stays<transport::RelightSession, TransportScene, Places, transport::RelightParams,
                                  float>));
  EXPECT_TRUE((only_of_what_stays<transport::TransportNetwork, TransportScene, std::span<const vec3>,
                                  transport::TransportParams>));
  EXPECT_TRUE((only_of_what_stays<rays::PosedWorld, TransportScene, float>));
  EXPECT_TRUE((only_of_what_stays<rays::PosedWorld, TransportScene, Matrices&>));
  EXPECT_TRUE((only_of_what_stays<transport::SurfelSet, TransportScene, float>));
}

TEST(Temporaries, OfTracersAreRefusedByLookups) {
  EXPECT_TRUE((std::is_constructible_v<probes::IrradianceLookup, ProbeSet, PathTracer&, LookupParams>));
  EXPECT_FALSE((std::is_constructible_v<probes::IrradianceLookup, ProbeSet, PathTracer, LookupParams>));
  EXPECT_TRUE((std::is_constructible_v<probes::LightLookup, ProbeSet, PathTracer&>));
  EXPECT_FALSE((std::is_constructible_v<probes::LightLookup, ProbeSet, PathTracer>));
}

TEST(Temporaries, OfNetworksAreRefusedByWhatFollowsThem) {
  EXPECT_TRUE((std::is_constructible_v<transport::BounceOperator, transport::TransportNetwork&,
                                       TransportScene&, int>));
  EXPECT_FALSE((
      std::is_constructible_v<transport::BounceOperator, transport::TransportNetwork, TransportScene&, int>));
  EXPECT_FALSE((
      std::is_constructible_v<transport::BounceOperator, transport::TransportNetwork&, TransportScene, int>));
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
  EXPECT_TRUE(LendsItsWeights<probes::ProbeWeights&>);
  EXPECT_TRUE(LendsItsWeights<const probes::ProbeWeights&>);
  EXPECT_FALSE(LendsItsWeights<probes::ProbeWeights>);
  EXPECT_FALSE(LendsItsWeights<const probes::ProbeWeights>);
}

}  // namespace
}  // namespace ssphh::test
