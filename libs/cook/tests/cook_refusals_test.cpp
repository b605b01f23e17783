/// What cannot be cooked, and what is said of what is lost.

#include <gmock/gmock.h>

#include <ssphh/core/parallel.h>

#include "cooked_room.h"
#include "error_message.h"
#include "expected_text.h"

namespace ssphh::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(Cook, RefusesWhatItCannotCook) {
  const scene::Scene scene = two_rooms_with_a_wall();
  const TriangleSource source(scene);
  const cook::CookScene cook_scene{scene, source};
  const probes::ProbeSet set = set_of_two_rooms(OnSurfaces::records, 2);
  std::string told;  // whole, with advice
  const auto problem = [&](const probes::ProbeSet& s, const cook::CookParams& params, bool posed = true) {
    const std::string said = message_of([&] { cook::cook(s, posed ? &cook_scene : nullptr, params); });
    if (said != "no error") told += said + "\n";
    return said;
  };
  for (const int texels : {0, 8, 256}) EXPECT_EQ(problem(set, {texels}, false), "no error") << texels;
  for (const int texels : {-1, 7, 257})
    EXPECT_THAT(problem(set, {texels}), HasSubstr("0 or 8 to 256")) << texels;
  EXPECT_THAT(problem({}, {}), HasSubstr("empty"));
  probes::ProbeSet unmerged = set;
  for (probes::Probe& probe : unmerged.probes) probe.reflected = {};
  EXPECT_THAT(problem(unmerged, {}), HasSubstr("merge_groups"));
  probes::ProbeSet many = set;
  many.probes.resize(65536);
  EXPECT_THAT(problem(many, {}), HasSubstr("at most 65535"));

  EXPECT_THAT(problem(set, {16, &set}, false), HasSubstr("need a scene"));
  probes::ProbeSet other = set;
  other.probes[0].position.x += 0.1f;
  EXPECT_THAT(problem(set, {16, &other}), HasSubstr("of other probes"));
  EXPECT_THAT(problem(set, {16, &many}), HasSubstr("of other probes"));
  const probes::ProbeSet without = set_of_two_rooms(OnSurfaces::nothing, 2);
  EXPECT_THAT(problem(without, {16, &set}), HasSubstr("only one of the two"));
  EXPECT_EQ(problem(set, {16, &set}), "no error");
  expect_text_of("libs/cook/tests/expected/refusals.txt", told);
}

TEST(Cook, IsTheSameWhateverTheNumberOfThreads) {
  const probes::ProbeSet set = set_of_two_rooms(OnSurfaces::records);
  const std::vector<std::byte> all = cook_two_rooms(set);
  set_thread_count(1);
  const std::vector<std::byte> one = cook_two_rooms(set);
  set_thread_count(0);
  EXPECT_EQ(all, one);
}

TEST(Cook, ItsOwnPlacesAreNothingNew) {
  for (const OnSurfaces kind : {OnSurfaces::records, OnSurfaces::fitted, OnSurfaces::nothing}) {
    const probes::ProbeSet set = set_of_two_rooms(kind, 2);
    const scene::Scene scene = two_rooms_with_a_wall();
    const TriangleSource source(scene);
    const cook::CookScene cook_scene{scene, source};
    const std::vector<std::byte> own = cook::cook(set, &cook_scene, {8}).bytes,
                                 same = cook::cook(set, &cook_scene, {8, &set}).bytes;
    const OpenedFile a(own), b(same);
    ASSERT_EQ(ssphh_runtime_swap_light(a.runtime, same.data(), same.size()), SSPHH_RUNTIME_OK);
    for (const rays::SurfacePoint& at : places_on_surfaces(50, 3))
      EXPECT_EQ(a.irradiance(at), b.irradiance(at));
  }
}

TEST(Cook, AnEnvironmentWhoseDirectLightRecordsKeepIsBaked) {
  for (const bool kept : {true, false}) {
    probes::ProbeSet set = set_of_two_rooms(OnSurfaces::records, 2);
    set.light_groups[1].mode = scene::LightMode::diffuse;
    if (kept) {
      set.surface->direct.resize(3);
      set.surface->direct[1] = set.surface->groups[1];
    }
    probes::merge_groups(set);
    const OpenedFile file(cook_two_rooms(set, 8));
    ASSERT_EQ(file.result, SSPHH_RUNTIME_OK) << ssphh_runtime_message(file.result);
    ssphh_runtime_group group;
    ASSERT_EQ(ssphh_runtime_describe_group(file.runtime, 1, &group), SSPHH_RUNTIME_OK);
    EXPECT_EQ(group.baked, kept);
  }
}

TEST(Cook, DirectLightThatRecordsKeepIsInTheirLightAndInThatOfThingsThatMove) {
  probes::ProbeSet set = set_of_two_rooms(OnSurfaces::records, 2);
  const OpenedFile without(cook_two_rooms(set, 8));
  // As much direct light of one group as it reflects
  set.light_groups[1].mode = scene::LightMode::diffuse;
  set.surface->direct.resize(3);
  set.surface->direct[1] = set.surface->groups[1];
  for (probes::Probe& probe : set.probes) probe.groups[1].emitted = probe.groups[1].reflected;
  probes::merge_groups(set);
  const OpenedFile with(cook_two_rooms(set, 8));
  const vec3 off(0), one(1);
  for (const OpenedFile* file : {&without, &with}) {
    for (std::uint32_t g = 0; g < 3; ++g)
      ssphh_runtime_set_group_scale(file->runtime, g, g == 1 ? &one.x : &off.x);
  }
  for (const bool open : {false, true}) {
    int doubled = 0;
    for (const rays::SurfacePoint& at : open ? places_in_the_open(500, 8) : places_on_surfaces(500, 8)) {
      const vec3 once = without.irradiance(at), twice = with.irradiance(at);
      // Records add to rounding; probes' windows are of other sums
      doubled += glm::distance(twice, 2.0f * once) <= (open ? 0.3f : 1e-5f) * glm::length(twice);
    }
    EXPECT_GT(doubled, 475) << "of 500" << (open ? " in the open" : "");
  }
}

TEST(Cook, TellsWhatIsLost) {
  probes::ProbeSet set = set_of_two_rooms(OnSurfaces::records, 6);
  set.fitted = set_of_two_rooms(OnSurfaces::fitted).fitted;
  set.baseline.emplace();
  const cook::Cooked without = cook::cook(set, nullptr);
  EXPECT_EQ(without.points, 0u);
  EXPECT_THAT(without.lost, Contains(HasSubstr("without --scene")));
  EXPECT_THAT(without.lost, Contains(HasSubstr("they need --scene")));
  EXPECT_THAT(without.lost, Contains(HasSubstr("bands 5 to 6")));
  EXPECT_THAT(without.lost, Contains(HasSubstr("--update")));
  const scene::Scene scene = two_rooms_with_a_wall();
  const TriangleSource source(scene);
  const cook::CookScene cook_scene{scene, source};
  const cook::Cooked with = cook::cook(set, &cook_scene);
  EXPECT_EQ(with.points, 300u);
  EXPECT_EQ(with.sight_bytes, 27u * 6 * 32 * 32 * 2) << "as many texels as usual";
  EXPECT_THAT(with.lost, Contains(HasSubstr("fitted weights")));
  EXPECT_THAT(with.lost, Not(Contains(HasSubstr("--scene"))));
}

TEST(Cook, LightThatIsTheSameAllOverIsSoAtOtherPlaces) {
  probes::ProbeSet set = set_of_two_rooms(OnSurfaces::records, 2), places = set;
  probes::RecordLight even(0);
  even[3] = {1, 2, 3};
  for (std::vector<probes::PackedRecordLight>& group : set.surface->groups)
    for (std::size_t i = 0; i < group.size(); ++i)
      group[i] = probes::pack(even, set.surface->points[i].normal);
  probes::merge_groups(set);
  places.surface->points = places_on_surfaces(300, 6);
  const scene::Scene scene = two_rooms_with_a_wall();
  const TriangleSource source(scene);
  const cook::CookScene cook_scene{scene, source};
  const OpenedFile own(cook::cook(set, &cook_scene, {8}).bytes),
      moved(cook::cook(set, &cook_scene, {8, &places}).bytes);
  int same = 0;
  for (const rays::SurfacePoint& at : places_on_surfaces(50, 3)) {
    const vec3 expected = own.irradiance(at);
    EXPECT_GT(expected.x, 0);
    if (glm::length(moved.irradiance(at) - expected) < 0.02f * glm::length(expected)) ++same;
  }
  EXPECT_GE(same, 45) << "the others look up probes";
}

TEST(Cook, LightOfPointsThatStandElsewhereIsNotSwappedIn) {
  const probes::ProbeSet set = set_of_two_rooms(OnSurfaces::records, 2);
  probes::ProbeSet shifted = set;
  shifted.surface->points[0].position.x += 1e-5f;
  const OpenedFile file(cook_two_rooms(set, 8));
  const std::vector<std::byte> other = cook_two_rooms(shifted, 8);
  EXPECT_EQ(ssphh_runtime_swap_light(file.runtime, other.data(), other.size()), SSPHH_RUNTIME_OTHER_GEOMETRY);
}

}  // namespace
}  // namespace ssphh::test
