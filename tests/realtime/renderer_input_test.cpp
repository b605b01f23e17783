/// What a renderer refuses and in which words, shaders from a directory, and light that a probe sends out.

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include <ssphh/core/log.h>
#include <ssphh/sh/evaluate.h>

#include "change_lighting.h"
#include "error_message.h"
#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"
#include "stage.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

using realtime::FrameSettings;
using realtime::Renderer;
using realtime::View;
using testing::ElementsAre;
using testing::HasSubstr;

class RendererInput : public WithGl {
 protected:
  void SetUp() override {
    WithGl::SetUp();
    if (IsSkipped()) return;
    add_stage_lamp(scene_, {});
  }
  image::Image draw(Renderer& renderer, View view = View::lit) {
    FrameSettings settings;
    settings.view = view;
    renderer.draw(scene::camera_pose(scene_, ""), settings, {.width = 32, .height = 20});
    return renderer.read_back();
  }
  scene::Scene scene_ = stage(matte({0.9f, 0.3f, 0.5f}));
};

TEST_F(RendererInput, RefusalsNameTheObjectAndHowManyThereAre) {
  Renderer renderer(gl(), scene_);
  renderer.set_probes(made_up_probes({{0, 1, 1}, {1, 1, 1}}));
  for (const int index : {-1, 99}) {
    const std::string n = std::to_string(index);
    EXPECT_EQ(message_of([&] { renderer.set_material(index, {}); }), "material " + n + ": the scene has 4");
    EXPECT_EQ(message_of([&] { change_lighting(renderer, [&](auto& s) {
                                 s.emission = {{index, {}}};
                               }); }),
              "emission of probe " + n + ": there are 2 probes");
    EXPECT_EQ(message_of([&] { renderer.update_probes(std::array{index}, std::vector{sh::RadianceSh(4)}); }),
              "probe " + n + ": there are 2");
  }
  EXPECT_EQ(message_of([&] { renderer.update_probes(std::array{0}, std::vector{sh::RadianceSh(3)}); }),
            "probe 0: has 16 RGB coefficients; the set's degree has 25");
  const scene::LightingState sound = renderer.lighting();
  EXPECT_THAT(message_of([&] { renderer.set({}); }), HasSubstr("0 lights and 0 groups"));
  EXPECT_THAT(message_of([&] {
                change_lighting(renderer, [](auto& s) { s.time = 1, s.group_scales[0].y = -0.1f; });
              }),
              HasSubstr("not negative"));
  EXPECT_THAT(
      message_of([&] { change_lighting(renderer, [](auto& s) { s.lights[0].world[3].y = INFINITY; }); }),
      HasSubstr("light 0: its place"));
  EXPECT_EQ(renderer.lighting(), sound) << "what is refused changes nothing";
  for (const PictureSize& size : {PictureSize{0, 4}, {4, 0}, {-1, 4}})
    EXPECT_EQ(message_of([&] { renderer.draw({}, {}, {.width = size.width, .height = size.height}); }),
              "frame size: width and height must be positive");
  scene::CameraPose pose = scene::camera_pose(scene_, "");
  pose.world[0] = vec4(0);
  EXPECT_EQ(message_of([&] { renderer.draw(pose, {}, {.width = 4, .height = 4}); }),
            "camera \"eye\": its pose is not finite or has no extent");
}

TEST_F(RendererInput, LightsThatNeedMoreMapsThanThereAreAreRefused) {
  scene::Light sun = scene_.lights[0];
  sun.type = scene::LightType::directional;
  scene_.lights.assign(32, sun);
  const realtime::RendererParams small{.sun_map_size = 16, .environment_map_size = 16};
  EXPECT_NO_THROW(Renderer(gl(), scene_, small)) << "six cascades each";
  scene_.lights.push_back(sun);
  EXPECT_EQ(message_of([&] { Renderer(gl(), scene_, small); }),
            "real-time renderer: the lights need 198 parallel shadow maps, 192 is the most");
}

TEST_F(RendererInput, BeginsWithTheScenesOwnLighting) {
  EXPECT_EQ(Renderer(gl(), scene_, {}, 2).lighting(), scene::lighting_at(scene_, 2));
}

TEST_F(RendererInput, ShadersOfADirectoryAreReloadedWhenTheyChangeAndKeptWhenTheyAreWrong) {
  const TempDir directory;
  std::vector<std::string> logged;
  const LogSink before =
      set_log_sink([&](LogLevel, const std::string& message) { logged.push_back(message); });
  const auto write = [&](const std::string& body, int age) {
    std::ofstream(directory / "view.frag") << "#version 450 core\nlayout(location = 0) out vec4 color;\n"
                                           << "void main() { color = vec4(" << body << "); }\n";
    std::filesystem::last_write_time(directory / "view.frag",
                                     std::filesystem::file_time_type::clock::now() - std::chrono::hours(age));
  };
  // What takes long to compile and is not asked for
  for (const char* name : {"direct.frag", "indirect.glsl", "method.glsl"})
    std::ofstream(directory / name)
        << "#version 450 core\n#ifdef LISTED\nlayout(local_size_x = 1) in;\n#endif\n"
        << "void main() {}\n";
  for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
    std::filesystem::last_write_time(entry,
                                     std::filesystem::file_time_type::clock::now() - std::chrono::hours(20));
  write("0.25, 0, 0, 1", 9);
  Renderer renderer(gl(), scene_, {.shader_directory = directory.path()});
  const auto red = [&] { return draw(renderer, View::normal).rgb(16, 18).x; };
  EXPECT_EQ(red(), 0.25f);
  EXPECT_THAT(logged, testing::IsEmpty());
  write("0.5, 0, 0, 1", 8);
  EXPECT_EQ(red(), 0.5f);
  EXPECT_THAT(logged, ElementsAre("shaders reloaded from " + directory.path().string()));
  write("no_such_thing, 0, 0, 1", 7);
  EXPECT_EQ(red(), 0.5f);
  EXPECT_EQ(red(), 0.5f);
  set_log_sink(before);
  ASSERT_EQ(logged.size(), 2u) << "once for each change";
  EXPECT_THAT(logged[1], HasSubstr("the shaders from before stay in use: shader view.frag: "));
  EXPECT_THAT(logged[1], HasSubstr("no_such_thing"));
}

TEST_F(RendererInput, ProbeSendsOutWhatItsFunctionSaysInEveryDirection) {
  // Before a wall, from a sphere of 0.2 m: L(w) pi r² cos / d² / pi times the albedo
  scene::Scene s;
  s.materials = {matte({0.8f, 0.5f, 0.3f})};
  add_mesh(s, scene::make_quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}), 0);
  s.nodes.emplace_back().local.translation = {0, 0, 3};
  s.cameras.emplace_back().node = 1;
  s.cameras[0].orthographic = true, s.cameras[0].yheight = 3;
  scene::validate(s);
  const vec3 place(0.3f, -0.2f, 0.8f);
  for (const int degree : {0, 2, 5, 10}) {
    sh::RadianceSh leaving(degree);
    for (int k = 0; k < sh::coefficient_count(degree); ++k)
      leaving[k] = k == 0 ? vec3(9, 7, 8)
                          : vec3(std::sin(3.0f * static_cast<float>(k)),
                                 std::cos(5.0f * static_cast<float>(k)), 0.5f) /
                                static_cast<float>(degree);
    Renderer renderer(gl(), s);
    probes::ProbeSet set = made_up_probes({place, {-1, 0, 1}});
    set.probes[0].radius = 0.2f;
    renderer.set_probes(set);
    change_lighting(renderer, [&](auto& state) { state.emission = {{0, leaving}}; });
    FrameSettings settings;
    settings.view = View::direct;
    const PictureSize size{24, 24};
    const scene::CameraPose pose = scene::camera_pose(s, "");
    renderer.draw(pose, settings, {.width = size.width, .height = size.height});
    image::Image expected(size.width, size.height, 3);
    const std::vector<rays::RayQuery> rays = pixel_rays(pose, size);
    std::vector<float> y(static_cast<std::size_t>(sh::coefficient_count(degree)));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const vec3 way = vec3(vec2(rays[i].origin), 0) - place, w = glm::normalize(way);
      sh::eval_basis(degree, w, y);
      vec3 radiance(0);
      for (std::size_t k = 0; k < y.size(); ++k) radiance += y[k] * leaving.values[k];
      const vec3 e = glm::max(radiance, vec3(0)) * pi * 0.04f * -w.z / glm::dot(way, way);
      expected.set_rgb(static_cast<int>(i) % size.width, static_cast<int>(i) / size.width,
                       vec3(0.8f, 0.5f, 0.3f) / pi * e);
    }
    // 10 bits of a colour's root, and a recurrence in single precision
    EXPECT_TRUE(picture_is(renderer.read_back(), PictureBounds::around(expected, 0.005f, 1e-5f))) << degree;
    change_lighting(renderer, [&](auto& state) { state.emission = {{0, {}}}; });
    renderer.draw(pose, settings, {.width = size.width, .height = size.height});
    EXPECT_THAT(renderer.read_back().pixels, testing::Each(0.0f));
  }
}

TEST_F(RendererInput, ProbesThatAreGoneSendOutNothing) {
  Renderer renderer(gl(), scene_);
  const image::Image dark = draw(renderer, View::direct);
  renderer.set_probes(made_up_probes({{0, 1, 1}, {1, 1, 1}}));
  sh::RadianceSh leaving(0);
  leaving[0] = vec3(100);
  change_lighting(renderer, [&](auto& state) { state.emission = {{1, leaving}}; });
  EXPECT_NE(draw(renderer, View::direct).pixels, dark.pixels);
  renderer.set_probes(made_up_probes({{0, 1, 1}, {1, 1, 1}}));
  EXPECT_EQ(draw(renderer, View::direct).pixels, dark.pixels);
  change_lighting(renderer, [&](auto& state) { state.emission = {{1, leaving}}; });
  renderer.clear_probes();
  EXPECT_EQ(draw(renderer, View::direct).pixels, dark.pixels);
}

}  // namespace
}  // namespace ssphh::test
