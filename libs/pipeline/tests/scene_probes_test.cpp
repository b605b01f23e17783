// Probe sets held against scenes: what differs, by every word; files and keys; viewpoints; lookups that a set
// cannot give.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/trace/transport_scene.h>

#include "error_message.h"
#include "logged.h"
#include "number_list.h"
#include "temp_dir.h"

namespace ssphh::pipeline {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

/// A set of a probe without light that says to be of the scene.
probes::ProbeSet set_of(const scene::Scene& scene, float time = 0) {
  probes::ProbeSet set =
      probes::dark_set(std::vector<scene::ProbePlace>{{"p", vec3(0.5f, 1, 0.25f), 0.1f}}, 1);
  set.generator.scene = scene.name, set.generator.scene_hash = scene::light_hash(scene);
  set.generator.time = time;
  for (const std::string& name : scene::light_groups(scene)) set.light_groups.push_back({.name = name});
  for (const probes::LightGroup& group : set.light_groups) {
    static_cast<void>(group);
    set.probes[0].groups.push_back({sh::RadianceSh(1), sh::RadianceSh(1)});
  }
  probes::merge_groups(set);
  return set;
}

TEST(SceneDifference, SaysWhatIsOtherInOneLine) {
  scene::Scene scene = scene::make_builtin("two-rooms");
  const std::vector<std::string> groups = scene::light_groups(scene);
  probes::ProbeSet set = set_of(scene);
  EXPECT_EQ(scene_difference(set, scene, groups, 0.0f), "");
  scene::Scene renamed = scene;
  renamed.name = "flat";
  EXPECT_EQ(scene_difference(set, renamed, groups, 0.0f), "") << "a name alone is no difference";
  renamed.lights[0].intensity += 1;
  EXPECT_THAT(scene_difference(set, renamed, groups, 0.5f),
              MatchesRegex("scene \"two-rooms\", now \"flat\"; geometry, materials or lights \\(hash "
                           "[0-9a-f]{8}, now [0-9a-f]{8}\\); time 0 s, now 0.5 s"));
  scene.lights[0].intensity += 1;
  EXPECT_THAT(scene_difference(set, scene, groups, {}),
              MatchesRegex("geometry, materials or lights \\(hash [0-9a-f]{8}, now [0-9a-f]{8}\\)"));
  set.light_groups = {{.name = "a"}, {.name = "b"}, {.name = "c"},
                      {.name = "d"}, {.name = "e"}, {.name = "f"}};
  EXPECT_THAT(scene_difference(set, scene, {"x"}, {}),
              HasSubstr("; light groups: 6 (a, b, c, d, e, f), now 1 (x)"));
  set.light_groups.push_back({.name = "g"});
  EXPECT_THAT(scene_difference(set, scene, {"x"}, {}),
              HasSubstr("; light groups: 7 (a, b, c, d, e, f, ...), now 1 (x)"));
}

TEST(SceneDifference, HoldsTheModesThatTheSceneAsksFor) {
  scene::Scene scene = scene::make_builtin("two-rooms");
  const std::string group = scene::light_groups(scene).front();
  scene::set_light_mode(scene, group, scene::LightMode::baked);
  const probes::ProbeSet set = set_of(scene);
  EXPECT_EQ(scene_difference(set, scene, scene::light_groups(scene), {}),
            "light group \"" + group + "\" as realtime, asked for as baked");
}

TEST(RequireSameScene, RefusesOrWarns) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const probes::ProbeSet set = set_of(scene, 0.25f);
  const auto said = [&](std::optional<float> time, bool force) {
    test::Logged logged;
    const std::string error = test::message_of(
        [&] { require_same_scene("a.sphl", set, scene, scene::light_groups(scene), time, force); });
    return error + "|" + logged.take();
  };
  const std::string problem = "was baked in another scene or pose: time 0.25 s, now 0.5 s";
  EXPECT_EQ(said(0.25f, false), "no error|");
  EXPECT_EQ(said(0.5f, false),
            "a.sphl: " + problem + " (bake it anew, give the options of its bake, or go on with --force)|");
  EXPECT_THAT(said(0.5f, true),
              testing::AllOf(testing::StartsWith("no error|"), HasSubstr("a.sphl: " + problem)));
}

TEST(ReadProbesOf, BlendsKeysAndHoldsEachAgainstTheScene) {
  const test::TempDir dir;
  const scene::Scene scene = scene::make_builtin("two-rooms");
  probes::ProbeSet dark = set_of(scene, 0), bright = set_of(scene, 1);
  for (probes::GroupLight& light : dark.probes[0].groups) light.reflected.values[0] = vec3(1);
  for (probes::GroupLight& light : bright.probes[0].groups) light.reflected.values[0] = vec3(5);
  probes::merge_groups(dark), probes::merge_groups(bright);
  const std::string a = dir / "a.sphl", b = dir / "b.sphl";
  probes::write_probe_file(dark, a), probes::write_probe_file(bright, b);
  const auto light = [&](const std::string& file, std::optional<float> time) {
    return read_probes_of(scene, file, time, false).probes[0].groups[0].reflected.values[0].x;
  };
  EXPECT_EQ(light(a, 0.0f), 1);
  EXPECT_EQ(light(b, {}), 5);
  EXPECT_THAT(test::message_of([&] { light(b, 0.0f); }), HasSubstr("time 1 s, now 0 s"));
  EXPECT_NEAR(light(a + "," + b, 0.25f), 2, 1e-5f);
  EXPECT_NEAR(light(a + "," + b, {}), 1, 1e-5f);
  EXPECT_NEAR(light(a + "@2," + b + "@4", 3.0f), 3, 1e-5f);
  bright.generator.scene_hash = {};
  probes::write_probe_file(bright, b);
  EXPECT_THAT(test::message_of([&] { light(a + "," + b, 0.25f); }), HasSubstr("was baked in another scene"));
}

TEST(Viewpoints, AreCamerasAndProbesElseLampsElseAView) {
  test::NumberList list;
  const scene::Scene rooms = scene::make_builtin("two-rooms");
  const trace::TransportScene source(rooms);
  const std::vector<probes::ProbeSet> sets(2, set_of(rooms));
  list.add("with sets", viewpoints(rooms, source, sets, 0));
  list.add("without", viewpoints(rooms, source, {}, 0));
  scene::Scene box = scene::make_builtin("box");
  list.add("box", viewpoints(box, trace::TransportScene(box), {}, 0));
  box.cameras.clear(), box.sphls.clear();
  list.add("bare box", viewpoints(box, trace::TransportScene(box), {}, 0));
  list.expect("libs/pipeline/tests/expected/viewpoints.txt");
}

TEST(LookupParams, OfASetThatHasNotWhatTheyNeedAreRefused) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const probes::ProbeSet set = set_of(scene);
  const auto said = [&](std::optional<probes::WeightMethod> weights) {
    return test::message_of([&] { lookup_params("a.sphl", set, {.weights = weights}); });
  };
  EXPECT_EQ(said({}), "no error");
  EXPECT_EQ(said(probes::WeightMethod::trilinear), "no error");
  EXPECT_EQ(said(probes::WeightMethod::fitted),
            "a.sphl: has no fitted weights (bake it with --fit, or choose other --weights)");
  EXPECT_EQ(
      said(probes::WeightMethod::surface),
      "a.sphl: has no surface records of this light (bake it with --records, or choose other --weights)");
  EXPECT_EQ(lookup_params("", set, {.weights = probes::WeightMethod::mls}).weights.method,
            probes::WeightMethod::mls);
}

}  // namespace
}  // namespace ssphh::pipeline
