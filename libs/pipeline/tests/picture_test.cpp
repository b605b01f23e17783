// Pictures pixel by pixel: by paths, by probes, by a method that is made for them; cameras, marks and what it
// took.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/image/exposure.h>
#include <ssphh/image/resample.h>
#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/exposure.h>
#include <ssphh/pipeline/method_figures.h>
#include <ssphh/pipeline/relit.h>
#include <ssphh/pipeline/render_scene.h>
#include <ssphh/probes/hier.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

#include "error_message.h"
#include "logged.h"
#include "number_list.h"

namespace ssphh::pipeline {
namespace {

using testing::HasSubstr;

class PictureTest : public testing::Test {
 protected:
  PictureTest() {
    params_.width = 4, params_.height = 3;
    params_.path = {.max_depth = 3, .passes = 2, .spp = 2, .seed = 11};
    params_.camera = camera_of(scene_, "", 0, geometry_);
  }
  std::string lit(const std::string& name, const LightFinder& finder,
                  std::span<const methods::Drawing> drawings = {}) {
    trace::RenderState state;
    sketch::Sketch drawn;
    int passes = 0;
    test::Logged logged;
    const auto figures = render_scene(geometry_, scene_, 0.5f, finder, params_, state, {}, drawings, &drawn,
                                      [&](const trace::RenderState&) { ++passes; });
    list_.add(name, passes, state.passes_done, drawn.size(), figures.has_value());
    list_.add("  color", state.color.pixels);
    list_.add("  indirect", state.indirect.pixels);
    return logged.take();
  }

  const scene::Scene scene_ = scene::make_builtin("two-rooms");  // its door is half open at half a second
  const trace::SharedGeometry geometry_ = std::make_shared<const trace::SceneGeometry>(scene_);
  trace::RenderParams params_;
  test::NumberList list_;
};

TEST_F(PictureTest, HasThePixelsThatItHad) {
  EXPECT_EQ(lit("path", {}), "");
  const methods::Drawing hierarchy[] = {methods::Drawing::hierarchy};
  BakeSettings settings;
  settings.degree = 1, settings.op = probes::LightOperator::surfel, settings.viz = probes::VizMethod::links;
  settings.records = 16, settings.transport.records.rays = 16;
  transport::TransportParams& network = settings.transport.transport;
  network.directions = 32, network.link_rays = 8, network.surfel_size = 0.5f;
  probes::ProbeSet set = bake_scene(geometry_, scene_, 0.5f, {.probes = "scene"}, settings, {}).set;
  EXPECT_EQ(lit("probes", {.method = "ssphh", .probes = &set}, hierarchy), "");
  EXPECT_EQ(lit("probes by light",
                {.method = "ssphh", .probes = &set, .lookup = {.method = probes::LookupMethod::light}}),
            "");
  EXPECT_EQ(lit("probes by trilinear weights",
                {.method = "ssphh", .probes = &set, .lookup = {.weights = probes::WeightMethod::trilinear}}),
            "");
  const methods::Drawing surfels[] = {methods::Drawing::surfels};
  EXPECT_THAT(lit("ambient", {.method = "ambient", .parameters = {"factor=0.5"}}),
              testing::StartsWith("info: ambient: bake "));
  EXPECT_THAT(
      lit("made probes",
          {.method = "ssphh", .parameters = {"probes=8", "directions=32", "surfel_size=0.5", "records=16"}},
          surfels),
      testing::StartsWith("info: ssphh: bake "));
  list_.expect("libs/pipeline/tests/expected/pictures.txt");
}

TEST_F(PictureTest, IsSeenByTheCameraThatIsNamed) {
  EXPECT_EQ(camera_of(scene_, scene_.cameras[1].name, 0).camera.name, scene_.cameras[1].name);
  EXPECT_EQ(camera_of(scene_, "", 0).camera.name, scene_.cameras[0].name);
  EXPECT_THAT(test::message_of([&] { camera_of(scene_, "nobody", 0); }), HasSubstr("nobody"));
  EXPECT_EQ(test::message_of([&] { camera_of(scene_, "", NAN); }),
            "time: it must be a finite number of seconds");
  scene::Scene blind = scene_;
  blind.cameras.clear();
  const scene::CameraPose with = camera_of(blind, "", 0, geometry_), without = camera_of(blind, "", 0);
  EXPECT_EQ(with.world, without.world);
  EXPECT_THAT(test::message_of([&] { camera_of(blind, "nobody", 0); }), HasSubstr("nobody"));
}

TEST_F(PictureTest, IsProjectedAsAskedFor) {
  scene::Camera camera;
  EXPECT_EQ(projection_of(PictureProjection::camera, camera), trace::Projection::pinhole);
  EXPECT_EQ(projection_of(PictureProjection::equirect, camera), trace::Projection::equirect);
  EXPECT_EQ(projection_of(PictureProjection::cube, camera), trace::Projection::cube_strip);
  camera.orthographic = true;
  EXPECT_EQ(projection_of(PictureProjection::camera, camera), trace::Projection::orthographic);
  EXPECT_EQ(projection_of(PictureProjection::equirect, camera), trace::Projection::equirect);
}

TEST_F(PictureTest, RefusesWhatItsMethodDoesNotTake) {
  const auto said = [](const char* method, bool parameters, bool probes) {
    return test::message_of([&] { check_method(method, parameters, probes); });
  };
  EXPECT_EQ(said("path", false, false), "no error");
  EXPECT_EQ(said("vct", true, false), "no error");
  EXPECT_EQ(said("ssphh", false, true), "no error");
  EXPECT_EQ(said("vct", false, true), "--probes: is of method ssphh, not of vct");
  EXPECT_EQ(said("path", true, false), "--param: method path has none (see --max-depth, --spp and --passes)");
  EXPECT_EQ(said("ssphh", true, true),
            "--param: tells how probes are made, and --probes gives made ones (leave out one of them)");
}

TEST(MethodFiguresTest, AreToldInSuitableUnits) {
  const MethodFigures figures{1.234, 0.0123456, {9999, 10000}, {{"probes", 12}, {"share", 0.12345678}}};
  EXPECT_EQ(to_text(figures),
            "bake 1.23 s, update 12.3 ms, 9999 B to look up, 10.0 KB more to follow changes, "
            "probes 12, share 0.123457");
  EXPECT_THAT(to_text({0, 0, {999'949, 1'000'000}, {}}), HasSubstr("999.9 KB to look up, 1.0 MB more"));
  EXPECT_THAT(to_text({0, 0, {0, 12'345'678}, {}}), HasSubstr("0 B to look up, 12.3 MB more"));
  const json::Value object = to_json(figures);
  EXPECT_EQ(object["bake_seconds"].number(), 1.234);
  EXPECT_EQ(object["update_seconds"].number(), 0.0123456);
  EXPECT_EQ(object["lookup_bytes"].number(), 9999);
  EXPECT_EQ(object["update_bytes"].number(), 10000);
  EXPECT_EQ(object["probes"].number(), 12);
  EXPECT_EQ(object["share"].number(), 0.12345678);
}

TEST(SuitableExposure, ShrinksByWholeNumbersAndNeverToNothing) {
  const auto striped = [](int width, int height) {
    image::Image picture(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        picture.set_rgb(x, y, vec3(0.01f * static_cast<float>(1 + (x * 7 + y * 13) % 50)));
    return picture;
  };
  const auto shrunk = [](const image::Image& picture, int width, int height) {
    return image::automatic_exposure(image::resize(picture, width, height));
  };
  const image::Image small = striped(319, 4), twice = striped(320, 5), high = striped(3, 330),
                     thin = striped(480, 2);
  EXPECT_EQ(suitable_exposure(small), image::automatic_exposure(small));
  EXPECT_NE(suitable_exposure(twice), image::automatic_exposure(twice));
  EXPECT_EQ(suitable_exposure(twice), shrunk(twice, 160, 2));
  EXPECT_EQ(suitable_exposure(high), shrunk(high, 1, 165));
  EXPECT_EQ(suitable_exposure(thin), shrunk(thin, 160, 1));
  EXPECT_EQ(suitable_exposure(small, image::ToneCurve::clip), suitable_exposure(small));
}

TEST(BakedSession, TellsOfTheSceneAsItIsLitAtFullStrength) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.degree = 1;
  params.transport.directions = 16, params.transport.link_rays = 4, params.transport.surfel_size = 0.5f;
  transport::RelightSession session(source, {{"p", vec3(-2, 1.5f, 0), 0.1f}}, params);
  scene::LightingState state = rays::lighting_at(source, 0);
  for (vec3& scale : state.group_scales) scale = vec3(0.5f);
  session.update(state);
  const probes::ProbeSet set =
      baked_session(session, scene, scene::light_groups(scene), probes::LightOperator::surfel);
  EXPECT_EQ(set.generator.op, probes::LightOperator::surfel);
  EXPECT_EQ(set.generator.scene, "two-rooms");
  EXPECT_EQ(set.generator.scene_hash, scene::light_hash(scene)) << "factors of groups are no part of a bake";
  ASSERT_EQ(set.light_groups.size(), state.group_scales.size());
  EXPECT_EQ(set.light_groups[0].scale, vec3(0.5f));
  state.lights[0].intensity *= 2;
  session.update(state);
  EXPECT_NE(baked_session(session, scene, scene::light_groups(scene), probes::LightOperator::surfel)
                .generator.scene_hash,
            scene::light_hash(scene));
}

TEST(Aimed, AsTheListHasItAndNowhereNot) {
  mat4 world = glm::mat4_cast(glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, -1))));
  world[3] = vec4(4, 5, 6, 1);
  test::NumberList list;
  for (const scene::LightType type : {scene::LightType::spot, scene::LightType::directional,
                                      scene::LightType::rectangle, scene::LightType::disc}) {
    const mat4 turned = aimed(type, world, vec3(0.5f, -2, 1));
    list.add(name_of(type), turned[0], turned[1], turned[2], turned[3]);
  }
  list.expect("libs/pipeline/tests/expected/aimed.txt");
  for (const vec3& nowhere : {vec3(0), vec3(NAN, 1, 0), vec3(INFINITY, 0, 0)})
    EXPECT_EQ(test::message_of([&] { aimed(scene::LightType::spot, world, nowhere); }),
              "aim of a light: its direction leads nowhere");
}

}  // namespace
}  // namespace ssphh::pipeline
