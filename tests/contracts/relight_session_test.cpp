/// Contracts of transport::RelightSession: refused input, a source that fails, and the light afterwards.

#include <algorithm>

#include <ssphh/scene/query.h>
#include <ssphh/transport/direct_field.h>
#include <ssphh/transport/session_sets.h>
#include <ssphh/transport/surface_gather.h>

#include "contract.h"
#include "unruly_source.h"

namespace ssphh::test {
namespace {

std::vector<scene::ProbePlace> door_places() {
  std::vector<scene::ProbePlace> places;
  for (const scene::ProbePlace& place : scene::sphl_places(door_scene()))
    places.push_back({place.name, place.position, place.radius});
  places.resize(std::min<std::size_t>(places.size(), 3));
  return places;
}

transport::RelightParams coarse(probes::LightOperator op = probes::LightOperator::surfel) {
  transport::RelightParams params;
  params.transport = {.directions = 32, .surfel_size = 0.5f, .link_rays = 8, .samples = 2};
  params.degree = 1;
  params.warm_start = false;  // so that the bits tell nothing of the past
  params.op = op;
  return params;
}

struct Session {
  explicit Session(probes::LightOperator op = probes::LightOperator::surfel)
      : source(door_scene()), session(source, door_places(), coarse(op)) {}
  UnrulySource source;
  transport::RelightSession session;

  /// Brings the light up to date with the last state.
  transport::RelightReport update() { return session.update(session.lighting()); }
};

/// A lit session.
std::unique_ptr<Session> lit() {
  auto s = std::make_unique<Session>();
  s->update();
  return s;
}
std::unique_ptr<Session> unlit() {
  return std::make_unique<Session>();
}

void is_up_to_date(Session& s) {
  const std::vector<sh::RadianceSh> before = s.session.reflected();
  EXPECT_TRUE(s.update().changed_probes.empty());
  EXPECT_EQ(s.session.reflected(), before);
}

/// A row for input that a lit session refuses without a change of its light.
Contract refuses_input(const std::string& given, std::function<void(transport::RelightSession&)> call,
                       std::vector<std::string> words) {
  return refuses(
      "RelightSession", given, lit, [call](Session& s) { call(s.session); }, std::move(words), is_up_to_date);
}

/// The same for a state of the light.
Contract refuses_state(const std::string& given, std::function<void(scene::LightingState&)> spoil,
                       std::vector<std::string> words) {
  return refuses_input(
      given,
      [spoil](transport::RelightSession& session) {
        scene::LightingState state = session.lighting();
        spoil(state);
        session.update(state);
      },
      std::move(words));
}

void make_session(std::function<void(UnrulySource&)> spoil, transport::RelightParams params = coarse(),
                  std::vector<scene::ProbePlace> places = door_places(), float time = 0) {
  UnrulySource source(door_scene());
  spoil(source);
  transport::RelightSession session(source, std::move(places), params, time);
  session.update(session.lighting());
}

void sound(UnrulySource&) {}

std::vector<Contract> of_input() {
  return {
      refuses_state("StateWithoutALight", [](auto& s) { s.lights.clear(); }, {"lighting", "0 lights"}),
      refuses_state("StateOfOneLightMore", [](auto& s) { s.lights.resize(2); }, {"lighting", "2 lights"}),
      refuses_state("StateOfOneGroupMore", [](auto& s) { s.group_scales.resize(9); }, {"9 groups"}),
      refuses_state("LightOfAnIntensityThatIsNoNumber", [](auto& s) { s.lights[0].intensity = nan; },
                    {"light 0", "finite"}),
      refuses_state("GroupScaleBelowZero", [](auto& s) { s.group_scales[0] = vec3(1, -1, 1); },
                    {"group 0", "negative"}),
      refuses_state("TimeThatIsNoNumber", [](auto& s) { s.time = nan; }, {"time"}),
      refuses_state("EnvironmentRotationThatIsNoNumber", [](auto& s) { s.environment_rotation = nan; },
                    {"environment"}),
      refuses_state("EmissionOfNoProbe",
                    [](auto& s) {
                      s.emission = {{99, {}}};
                    },
                    {"probe 99"}),
      refuses_state("EmissionOfOneProbeTwice",
                    [](auto& s) {
                      s.emission = {{1, {}}, {1, {}}};
                    },
                    {"probe 1", "twice"}),
      refuses_state("EmissionOfDegreeEleven",
                    [](auto& s) {
                      s.emission.resize(1);
                      s.emission[0].leaving.values.assign(144, vec3(1));
                    },
                    {"emission", "0..10"}),
      refuses_state("EmissionOfFiveCoefficients",
                    [](auto& s) {
                      s.emission.resize(1);
                      s.emission[0].leaving.values.assign(5, vec3(1));
                    },
                    {"emission", "not those of a degree"}),
      refuses_state("EmissionThatIsNoNumber",
                    [](auto& s) {
                      s.emission = {{0, sh::RadianceSh(0)}};
                      s.emission[0].leaving[0] = vec3(nan);
                    },
                    {"emission", "finite"}),
      refuses_input("EmittedOfNoProbe", [](auto& s) { s.emitted(99); }, {"probe 99"}),
      refuses_input("ArrivingOfNoGroup", [](auto& s) { s.arriving(9, 0); }, {"light group"}),
      refuses_input("ArrivingOfAGroupBelowZero", [](auto& s) { s.arriving(-1, 0); }, {"light group"}),
      refuses_input("ArrivingAtNoProbe", [](auto& s) { s.arriving(0, 99); }, {"probe 99"}),
      refuses_input("KeptDirectOfNoGroup", [](auto& s) { s.kept_direct(0); }, {"surface records"}),
      refuses_input("EmissionProfileWithoutRays", [](auto& s) { s.emission_profile(vec3(0), 1, 2, 0); },
                    {"rays"}),
      refuses_input("EmissionProfileOfNoPlace", [](auto& s) { s.emission_profile(vec3(nan), 1, 2); },
                    {"finite centre"}),
      refuses_input("NetworkPartThatIsNotThere", [](auto& s) { s.network().part_world_bounds(99); },
                    {"part"}),
      refuses_input("NetworkFindOnNoPart", [](auto& s) { s.network().find(-1, {}); }, {"part"}),
      refuses_input("NetworkSampleThatIsNotThere", [](auto& s) { s.network().sample_exists(1u << 30); },
                    {"sample"}),
      refuses_input("NetworkGatherWithoutRays",
                    [](auto& s) { s.network().gather(std::vector<rays::SurfacePoint>(1), -1); },
                    {"gather rays"}),
      refuses_input("DirectFieldOfNoGroup",
                    [](auto& s) {
                      transport::DirectField field(s.network(), 1);
                      const UnrulySource source(door_scene());
                      const auto light = source.direct_light(source.lights(0), s.network().poses(), 0);
                      field.update_all(1, *light);
                    },
                    {"light group"}),
      refuses("RelightSession", "WithoutProbes", [] { make_session(sound, coarse(), {}); }, {"no probes"}),
      refuses("RelightSession", "OfPathTracing",
              [] { make_session(sound, coarse(probes::LightOperator::path)); },
              {"relighting", "surfel or bounce"}),
      refuses("RelightSession", "OfDegreeEleven",
              [] {
                transport::RelightParams params = coarse();
                params.degree = 11;
                make_session(sound, params);
              },
              {"0..10"}),
      refuses("RelightSession", "OfOnePose",
              [] {
                transport::RelightParams params = coarse();
                params.poses = 1;
                make_session(sound, params);
              },
              {"poses"}),
      refuses("RelightSession", "OfASurfelSizeThatIsNoNumber",
              [] {
                transport::RelightParams params = coarse();
                params.transport.surfel_size = nan;
                make_session(sound, params);
              },
              {"surfel size"}),
      refuses("RelightSession", "AtNoTime", [] { make_session(sound, coarse(), door_places(), nan); },
              {"time"}),
      refuses("RelightSession", "OfARadiusThatIsNone",
              [] {
                std::vector<scene::ProbePlace> places = door_places();
                places[1].radius = nan;
                make_session(sound, coarse(), places);
              },
              {"probe 1", "radius"}),
      refuses("LookupSet", "BeforeTheFirstUpdate", [] { transport::lookup_set(door_places(), {}); },
              {"lookup set", "update()"}),
      refuses("LookupSet", "OfNoPlaces", [] { transport::lookup_set({}, {}); }, {"no probes"}),
      refuses("LookupSet", "OfTwoDegrees",
              [] {
                transport::lookup_set({{}, {}}, {sh::RadianceSh(2), sh::RadianceSh(1)});
              },
              {"probe 1"}),
      gives("RelightSession", "BeforeTheFirstUpdateIsDark",
            [] {
              const auto s = unlit();
              EXPECT_TRUE(s->session.reflected().empty());
              EXPECT_EQ(s->session.emitted(0), sh::RadianceSh(1));
              const auto groups = s->session.emitted_by_group();
              ASSERT_EQ(groups.size(), s->source.light_groups().size());
              EXPECT_EQ(groups[0][2], sh::RadianceSh(1));
              EXPECT_EQ(s->session.reflected_by_group()[0][2], sh::RadianceSh(1));
            }),
  };
}

std::vector<Contract> of_records() {
  using transport::GatherParams;
  const auto kept = [] {
    auto s = lit();
    s->session.keep_records({.points = 16, .rays = 8});
    return s;
  };
  const auto stay = [](Session& s) {
    EXPECT_GT(s.session.record_light().size(), 0u);
    EXPECT_EQ(s.session.gather()->points().size(), s.session.record_light().size());
    is_up_to_date(s);
  };
  const auto refuses_records = [&](const std::string& given, const GatherParams& params,
                                   std::vector<std::string> words) {
    return refuses(
        "KeptRecords", given, kept, [params](Session& s) { s.session.keep_records(params); },
        std::move(words), stay);
  };
  const auto refuses_points = [&](const std::string& given, const std::vector<rays::SurfacePoint>& points,
                                  std::vector<std::string> words) {
    return refuses(
        "KeptRecords", given, kept, [points](Session& s) { s.session.keep_records_at(points, {.rays = 8}); },
        std::move(words), stay);
  };
  return {
      refuses_records("FewerThanNone", {.points = -1}, {"-1 points"}),
      refuses_records("MoreThanCanBeKept", {.points = 65537}, {"65537 points"}),
      refuses_records("OfThreeRays", {.points = 16, .rays = 3}, {"gather rays", "4..65536"}),
      refuses_records("OfNoGroup", {.points = 16, .rays = 8, .baked = {9}}, {"light group"}),
      refuses_points("AtNoPlace", {{vec3(nan), {0, 1, 0}}}, {"finite"}),
      refuses_points("OfNoNormal", {{vec3(0), vec3(nan)}}, {"finite"}),
      refuses_points("AtMorePlacesThanCanBeKept", std::vector<rays::SurfacePoint>(65537), {"at most 65536"}),
  };
}

std::vector<Contract> of_sources() {
  return {
      refuses("TransportSource", "WhoseLightIsOfNoGroup",
              [] { make_session([](UnrulySource& s) { s.strayed_group = 99; }); },
              {"transport source", "group"}),
      refuses("TransportSource", "WithoutDirectLight",
              [] { make_session([](UnrulySource& s) { s.gives_direct_light = false; }); },
              {"transport source", "direct light"}),
      refuses("TransportSource", "WhoseDirectLightIsNoNumber",
              [] { make_session([](UnrulySource& s) { s.dazzles = true; }); },
              {"transport source", "not finite"}),
  };
}

SSPHH_CONTRACTS(RelightSession, of_input());
SSPHH_CONTRACTS(KeptRecords, of_records());
SSPHH_CONTRACTS(TransportSource, of_sources());

/// A source that fails once, in each of the calls that an update makes in turn: the light stays, and the next
/// update makes it what an undisturbed session has, to the bit.
class FailingUpdate : public testing::TestWithParam<probes::LightOperator> {};

TEST_P(FailingUpdate, IsDoneAgainByTheNextOne) {
  Session undisturbed(GetParam());
  undisturbed.update();
  const std::vector<sh::RadianceSh> old = undisturbed.session.reflected();
  scene::LightingState next = undisturbed.session.lighting();
  next.time = 0.5f;
  next.lights[0].color *= vec3(0.5f, 2, 3);
  undisturbed.source.count_anew();
  undisturbed.session.update(next);
  const int calls = undisturbed.source.calls();
  ASSERT_NE(undisturbed.session.reflected(), old);

  constexpr int times = 6;
  for (int i = 0; i < times; ++i) {
    const int succeed = (calls - 1) * i / (times - 1);
    SCOPED_TRACE(testing::Message() << "failing after " << succeed << " of " << calls << " calls");
    Session s(GetParam());
    s.update();
    s.source.count_anew();
    s.source.fails_after = succeed;
    EXPECT_THROW(s.session.update(next), std::runtime_error);
    EXPECT_EQ(s.session.reflected(), old);
    s.source.fails_after = -1;
    EXPECT_FALSE(s.session.update(next).changed_probes.empty());
    EXPECT_EQ(s.session.reflected(), undisturbed.session.reflected());
    EXPECT_EQ(s.session.patch_direct(), undisturbed.session.patch_direct());
  }
}

TEST_P(FailingUpdate, LeavesTheFirstOneToTheNext) {
  Session s(GetParam()), undisturbed(GetParam());
  s.source.count_anew();
  s.source.fails_after = 0;
  EXPECT_THROW(s.update(), std::runtime_error);
  EXPECT_TRUE(s.session.reflected().empty());
  s.source.fails_after = -1;
  s.update();
  undisturbed.update();
  EXPECT_EQ(s.session.reflected(), undisturbed.session.reflected());
}

INSTANTIATE_TEST_SUITE_P(Of, FailingUpdate,
                         testing::Values(probes::LightOperator::surfel, probes::LightOperator::bounce),
                         [](const auto& op) { return std::string(name_of(op.param)); });

}  // namespace
}  // namespace ssphh::test
