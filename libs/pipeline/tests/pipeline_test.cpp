// Scenes, places and methods by words; a bake decides by the number of probes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/exposure.h>
#include <ssphh/image/resample.h>
#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/exposure.h>
#include <ssphh/pipeline/relit.h>
#include <ssphh/pipeline/render_scene.h>
#include <ssphh/pipeline/scene_options.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/pipeline/sky_options.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>

#include "error_message.h"
#include "temp_dir.h"

namespace ssphh::pipeline {
namespace {

using testing::HasSubstr;

TEST(Places, AreAskedForInWords) {
  for (const char* good : {"scene", "auto", "auto:0.7", "12"}) EXPECT_EQ(places_problem(good), "") << good;
  for (const char* bad : {"auto:", "auto:-1", "0", "-3", "many"}) EXPECT_NE(places_problem(bad), "") << bad;
  EXPECT_TRUE(is_probe_file({.probes = "a.sphl"}));
  EXPECT_FALSE(is_probe_file({.probes = "auto"}));
  const scene::Scene scene = scene::make_builtin("box");
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  EXPECT_THAT(test::message_of([&] { place_for(geometry, scene, 0, {.probes = "many"}, "", {}); }),
              HasSubstr("is none of: scene, auto"));
}

TEST(LoadScene, GivesASceneWithoutLightsAStudio) {
  const test::TempDir dir;
  const std::string file = dir / "triangle.obj";
  write_file(file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  SceneOptions options;
  options.source = file;
  EXPECT_TRUE(scene::light_groups(load_scene(options)).empty());
  EXPECT_FALSE(scene::light_groups(load_lit_scene(options)).empty());
}

TEST(LoadScene, KnowsTheModesOfLightGroups) {
  SceneOptions options;
  options.source = "builtin:box";
  const std::string group = scene::light_groups(load_scene(options)).front();
  options.light_modes = {group + "=mixed"};
  EXPECT_EQ(scene::light_modes(load_scene(options)).front(), scene::LightMode::mixed);
  options.light_modes = {"nobody=baked"};
  EXPECT_THAT(test::message_of([&] { load_scene(options); }), HasSubstr("nobody"));
  options.light_modes = {"nobody"};
  EXPECT_THAT(test::message_of([&] { load_scene(options); }), HasSubstr("is not GROUP=MODE"));
}

TEST(Aimed, TurnsWhereALampShinesAndLeavesItsPlace) {
  mat4 world(1);
  world[3] = vec4(1, 2, 3, 1);
  for (const auto& [type, direction] : {std::pair(scene::LightType::spot, vec3(0, -2, 0)),
                                        {scene::LightType::spot, vec3(0, 0, -1)},
                                        {scene::LightType::directional, vec3(1, 2, -2)},
                                        {scene::LightType::rectangle, vec3(1, 2, -2)}}) {
    const mat4 turned = aimed(type, world, direction);
    EXPECT_LT(glm::length(-vec3(turned[2]) - glm::normalize(direction)), 1e-6f);
    EXPECT_NEAR(glm::determinant(turned), 1, 1e-6f);
    EXPECT_EQ(turned[3], world[3]);
  }
}

TEST(Places, AreFewEnoughUnlessMoreAreAskedFor) {
  EXPECT_EQ(PlaceOptions().max_probes, 65536);
  EXPECT_EQ(PlaceOptions().levels, 1);
}

TEST(SceneDifference, NamesTheTimeWhereSomethingMoves) {
  for (const char* name : {"two-rooms", "box"}) {
    const scene::Scene scene = scene::make_builtin(name);
    const std::vector<std::string> groups = scene::light_groups(scene);
    probes::ProbeSet set;
    set.generator.scene = scene.name, set.generator.scene_hash = scene::light_hash(scene);
    EXPECT_EQ(scene_difference(set, scene, groups, std::nullopt), "") << name;
    EXPECT_EQ(scene_difference(set, scene, groups, 0), "") << name;
    EXPECT_EQ(scene_difference(set, scene, groups, 0.5f),
              scene::animation_duration(scene) > 0 ? "time 0 s, now 0.5 s" : "")
        << name;
  }
}

TEST(SunSky, SaysWhichWordItCannotRead) {
  const auto said_of = [](const std::string& date, const std::string& time, const std::string& place) {
    SkyOptions options;
    options.date = date, options.time_of_day = time, options.place = place;
    return test::message_of([&] { sun_sky_of(options); });
  };
  EXPECT_EQ(said_of("2026-06-21", "17:30", "48.1,11.6"), "no error");
  EXPECT_THAT(said_of("June", "17:30", "48.1,11.6"), testing::AllOf(HasSubstr("--date"), HasSubstr("June")));
  EXPECT_THAT(said_of("2026-06-21", "late", "48.1,11.6"),
              testing::AllOf(HasSubstr("--time-of-day"), HasSubstr("late")));
  EXPECT_THAT(said_of("2026-06-21", "17:30", "Munich"),
              testing::AllOf(testing::StartsWith("--place"), HasSubstr("Munich")));
}

TEST(SuitableExposure, LooksAtALargePictureMadeSmall) {
  // One pixel of nine is lit: as many as suit a picture of 160 show their mean alone.
  image::Image noisy(480, 240);
  for (int y = 0; y < noisy.height; ++y)
    for (int x = 0; x < noisy.width; ++x) noisy.set_rgb(x, y, vec3(x % 3 == 1 && y % 3 == 1 ? 9 : 0));
  const float plain = image::automatic_exposure(image::resize(noisy, 160, 80));
  EXPECT_EQ(suitable_exposure(noisy), plain);
  EXPECT_NE(image::automatic_exposure(noisy), plain);
}

class BakeOfABox : public testing::Test {
 protected:
  static BakeSettings small() {
    BakeSettings settings;
    settings.degree = 1;
    settings.params.path = {.max_depth = 2, .passes = 1, .spp = 1, .seed = 0};
    settings.params.face_size = 2;
    settings.records = 0;
    return settings;
  }
  SceneBake bake(const BakeSettings& settings, const PlaceOptions& places = {}) const {
    return bake_scene(geometry_, scene_, 0, places, settings, {});
  }

  const scene::Scene scene_ = scene::make_builtin("box");
  const trace::SharedGeometry geometry_ = std::make_shared<const trace::SceneGeometry>(scene_);
};

TEST_F(BakeOfABox, TracesFewProbes) {
  const SceneBake baked = bake(small());
  EXPECT_EQ(baked.set.generator.op, probes::LightOperator::path);
  EXPECT_EQ(baked.viz, probes::VizMethod::path);
  EXPECT_EQ(baked.set.probes.size(), scene_.sphls.size());
  EXPECT_FALSE(baked.place);
  EXPECT_EQ(scene_difference(baked.set, scene_, scene::light_groups(scene_), 0.0f), "");
}

TEST_F(BakeOfABox, LightsManyProbesByTransport) {
  BakeSettings settings = small();
  settings.transport.transport.directions = 16;
  settings.transport.transport.link_rays = 4;
  settings.transport.transport.surfel_size = 0.5f;
  const SceneBake baked = bake(settings, {.probes = "65"});
  EXPECT_EQ(baked.set.probes.size(), most_probes_for_paths + 1);
  EXPECT_EQ(baked.set.generator.op, probes::LightOperator::surfel);
  EXPECT_EQ(baked.viz, probes::VizMethod::links);
  ASSERT_TRUE(baked.place);
}

TEST_F(BakeOfABox, RefusesWhatWouldHaveNoEffect) {
  BakeSettings settings = small();
  settings.viz = probes::VizMethod::none;
  settings.of_viz = {"--threshold"};
  EXPECT_THAT(test::message_of([&] { bake(settings); }), HasSubstr("--threshold: is of VIZ"));
  settings.of_viz = {};
  settings.op = probes::LightOperator::surfel;
  settings.of_paths = {"--spp"};
  EXPECT_THAT(test::message_of([&] { bake(settings); }), HasSubstr("--spp: is of path tracing"));
}

TEST_F(BakeOfABox, LightsAPictureAsItsProbesDo) {
  const SceneBake baked = bake(small());
  trace::RenderParams params;
  params.width = 8, params.height = 8;
  params.path.spp = 4;
  params.camera = camera_of(scene_, "", 0, geometry_);
  const auto mean = [&](const LightFinder& finder) {
    trace::RenderState state;
    render_scene(geometry_, scene_, 0, finder, params, state);
    const image::Image picture = trace::resolve(state.indirect, state.passes_done);
    double sum = 0;
    for (const float x : picture.pixels) sum += static_cast<double>(x);
    return sum / static_cast<double>(picture.pixels.size());
  };
  EXPECT_GT(mean({.method = "ssphh", .probes = &baked.set, .probes_name = "these"}), 0);
  EXPECT_EQ(mean({.method = "direct"}), 0);
  const auto said = [&](const LightFinder& finder) { return test::message_of([&] { mean(finder); }); };
  EXPECT_THAT(said({.method = "path", .probes = &baked.set}), HasSubstr("is of method ssphh, not of path"));
  EXPECT_THAT(said({.method = "path", .parameters = {"a=1"}}), HasSubstr("method path has none"));
  EXPECT_THAT(said({.method = "ssphh",
                    .probes = &baked.set,
                    .probes_name = "these",
                    .lookup = {.weights = probes::WeightMethod::fitted}}),
              HasSubstr("these: has no fitted weights"));
}

}  // namespace
}  // namespace ssphh::pipeline
