// Skies and scenes as options ask for them: every option reaches the scene, and what is said of it.

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/pipeline/scene_options.h>
#include <ssphh/pipeline/sky_options.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>

#include "error_message.h"
#include "expected_text.h"
#include "logged.h"
#include "temp_dir.h"

namespace ssphh::pipeline {
namespace {

SkyOptions spring_in_munich() {
  SkyOptions options;
  options.date = "2026-03-21", options.time_of_day = "09:30", options.place = "48.1,11.6";
  return options;
}

std::string sky_text(const SkyOptions& options) {
  std::string text;
  const std::string error = test::message_of([&] {
    const auto sky = sun_sky_of(options);
    if (!sky) return void(text = "none");
    text = fmt::format("{} elevation {:.6g} azimuth {:.6g} turbidity {:g}", name_of(sky->model),
                       glm::degrees(sky->elevation), glm::degrees(sky->azimuth), sky->turbidity);
    if (const auto& t = sky->time)
      text += fmt::format(" at {}-{}-{} {:g} h, UTC {:g}, {:g}, {:g}, north {:g}", t->year, t->month, t->day,
                          t->hour, t->utc_offset, t->latitude, t->longitude, t->north);
  });
  return error == "no error" ? text : error;
}

TEST(SkyOptionsTest, AreASkyOrARefusal) {
  std::string text;
  using Change = std::function<void(SkyOptions&)>;
  const auto add = [&](const char* name, const Change& change, SkyOptions options = {}) {
    change(options);
    text += fmt::format("{}: {}\n", name, sky_text(options));
  };
  const auto add_dated = [&](const char* name, const Change& change) {
    add(name, change, spring_in_munich());
  };
  using enum scene::SkyModel;
  const auto at = [](SkyOptions& o) { o.elevation = 10, o.azimuth = 20, o.turbidity = 5; };
  add("nothing", [](SkyOptions&) {});
  add("angles alone", at);
  add("physical", [&](SkyOptions& o) { at(o), o.model = physical; });
  add("preetham", [&](SkyOptions& o) { o.model = preetham, o.elevation = 12, o.azimuth = 200; });
  add("sun-sky", [](SkyOptions& o) { o.preetham = true; });
  add("sun-sky and preetham", [](SkyOptions& o) { o.model = preetham, o.preetham = true; });
  add("sun-sky and physical", [](SkyOptions& o) { o.model = physical, o.preetham = true; });
  add_dated("a time", [](SkyOptions&) {});
  add_dated("a time, preetham", [](SkyOptions& o) { o.preetham = true; });
  add_dated("a time, clocks", [](SkyOptions& o) { o.utc_offset = 2; });
  add_dated("a time, north", [](SkyOptions& o) { o.north = 30; });
  add_dated("a time, hazy", [](SkyOptions& o) { o.turbidity = 7; });
  add_dated("no date", [](SkyOptions& o) { o.date.clear(); });
  add_dated("no hour", [](SkyOptions& o) { o.time_of_day.clear(); });
  add_dated("no place", [](SkyOptions& o) { o.place.clear(); });
  add("a place alone", [](SkyOptions& o) { o.place = "1,2"; });
  add("an hour alone", [](SkyOptions& o) { o.time_of_day = "09:30"; });
  add("a date alone", [](SkyOptions& o) { o.date = "2026-03-21"; });
  add("clocks alone", [](SkyOptions& o) { o.utc_offset = 1; });
  add("clocks and a sky", [](SkyOptions& o) { o.model = physical, o.utc_offset = 0; });
  add("north alone", [](SkyOptions& o) { o.north = 5; });
  test::expect_text_of("libs/pipeline/tests/expected/skies.txt", text);
}

TEST(SkyOptionsTest, TheSunIsToldOfWhereItIsLowOrOfADate) {
  std::string text;
  test::Logged logged;
  for (const float elevation : {30.0f, -0.26f, -0.28f, -5.99f, -6.01f, -17.99f, -18.01f, -60.0f}) {
    scene::Scene scene;
    scene.environment.emplace().sun_sky.emplace().elevation = glm::radians(elevation);
    tell_of_sun(scene);
    text += fmt::format("{:g}\n", elevation) + logged.take();
  }
  scene::Scene dated;
  dated.environment.emplace().sun_sky = sun_sky_of(spring_in_munich());
  tell_of_sun(dated);
  text += "dated\n" + logged.take();
  scene::Scene plain;
  tell_of_sun(plain);
  plain.environment.emplace();
  tell_of_sun(plain);
  text += "none\n" + logged.take();
  test::expect_text_of("libs/pipeline/tests/expected/suns.txt", text);
}

/// A triangle as a file, an overlay and a picture of a sky beside it.
class SceneOptionsTest : public testing::Test {
 protected:
  SceneOptionsTest() {
    write_file(dir_ / "one.obj", "mtllib one.mtl\nusemtl shiny\nv 0 0 0\nv 3 0 0\nv 0 2 0\nf 1 2 3\n");
    write_file(dir_ / "one.mtl", "newmtl shiny\nKd 0.5 0.4 0.3\nKs 1 1 1\nNs 200\n");
    write_file(dir_ / "lamps.json",
               R"({"lights": [{"name": "lamp", "type": "point", "position": [0, 1, 2], "intensity": 3}]})");
    image::Image sky(4, 2, 3);
    for (int i = 0; i < 8; ++i) sky.set_rgb(i % 4, i / 4, vec3(1 + i, 2, 3));
    image::write_image(dir_ / "sky.exr", sky);
    options_.source = dir_ / "one.obj";
  }
  static std::string text_of(const scene::Scene& scene) {
    const scene::Bounds b = scene::world_bounds(scene, scene::world_matrices(scene));
    std::string text = fmt::format("  to {:g} {:g} {:g}, specular {:g}, lights", b.max.x, b.max.y, b.max.z,
                                   scene.materials.empty() ? -1 : scene.materials[0].specular);
    const auto groups = scene::light_groups(scene);
    const auto modes = scene::light_modes(scene);
    for (std::size_t i = 0; i < groups.size(); ++i)
      text += fmt::format(" {} ({})", groups[i], name_of(modes[i]));
    if (const auto& e = scene.environment) {
      text += fmt::format("; environment {}×{} colour {:g}, turned {:g}°", e->equirect.width,
                          e->equirect.height, e->color.x, glm::degrees(e->rotation));
      if (e->sun_sky) text += fmt::format(", {}", name_of(e->sun_sky->model));
    }
    return text + "\n";
  }
  template <class Change>
  void add(const char* name, const Change& change) {
    SceneOptions options = options_;
    change(options);
    for (const bool lit : {false, true}) {
      test::Logged logged;
      std::string told;
      const std::string error =
          test::message_of([&] { told = text_of(lit ? load_lit_scene(options) : load_scene(options)); });
      const std::string said = logged.take();
      if (lit && told == before_ && said == said_before_) continue;
      text_ += fmt::format("{}{}\n{}", name, lit ? ", to be lit" : "", told);
      for (const std::string& line : test::lines_of(said)) text_ += "  " + line + "\n";
      if (error != "no error") text_ += "  " + error + "\n";
      before_ = told, said_before_ = said;
    }
  }
  /// What was written, without the folder's name, which differs from run to run.
  std::string told() const {
    std::string text = text_;
    for (std::size_t at; (at = text.find(dir_.path().string())) != std::string::npos;)
      text.replace(at, dir_.path().string().size(), "DIR");
    return text;
  }

  const test::TempDir dir_;
  SceneOptions options_;
  std::string text_, before_, said_before_;
};

TEST_F(SceneOptionsTest, EachReachesTheScene) {
  add("nothing", [](SceneOptions&) {});
  add("overlay", [&](SceneOptions& o) { o.overlay = dir_ / "lamps.json"; });
  add("unit", [](SceneOptions& o) { o.unit = "cm"; });
  add("lambert", [](SceneOptions& o) { o.lambert = true; });
  add("environment", [&](SceneOptions& o) { o.environment = dir_ / "sky.exr"; });
  add("environment, dim and turned", [&](SceneOptions& o) {
    o.environment = dir_ / "sky.exr", o.environment_intensity = 0.25f, o.environment_rotation = 40;
  });
  add("sky", [](SceneOptions& o) { o.sky.model = scene::SkyModel::physical; });
  add("night", [](SceneOptions& o) { o.sky.model = scene::SkyModel::physical, o.sky.elevation = -30; });
  add("modes", [&](SceneOptions& o) {
    o.overlay = dir_ / "lamps.json", o.light_modes = {"lamp=realtime", "lamp=baked"};
  });
  add("modes of a sky",
      [&](SceneOptions& o) { o.environment = dir_ / "sky.exr", o.light_modes = {"environment=mixed"}; });
  add("modes of nobody", [](SceneOptions& o) { o.light_modes = {"nobody=baked"}; });
  add("modes of the studio", [](SceneOptions& o) { o.light_modes = {"studio=baked"}; });
  test::expect_text_of("libs/pipeline/tests/expected/scene-options.txt", told());
}

TEST_F(SceneOptionsTest, AskForNothingUnlessTold) {
  const SceneOptions o;
  EXPECT_EQ(o.time, 0);
  EXPECT_EQ(o.environment_intensity, 1);
  EXPECT_EQ(o.environment_rotation, 0);
  EXPECT_FALSE(o.lambert || o.sky.preetham || o.sky.model || o.sky.utc_offset);
  EXPECT_EQ(o.sky.elevation, 45);
  EXPECT_EQ(o.sky.azimuth, 120);
  EXPECT_EQ(o.sky.turbidity, 3);
  EXPECT_EQ(o.sky.north, 0);
}

TEST_F(SceneOptionsTest, ModesAreReadFromTheLastSign) {
  const scene::GroupMode mode = read_light_mode("a=b=mixed");
  EXPECT_EQ(mode.group, "a=b");
  EXPECT_EQ(mode.mode, scene::LightMode::mixed);
  EXPECT_EQ(read_light_mode("a=baked").group, "a");
  const auto said = [](const char* text) { return test::message_of([&] { read_light_mode(text); }); };
  EXPECT_EQ(said("=baked"), "--light-mode =baked: is not GROUP=MODE (write sky=baked, for instance)");
  EXPECT_EQ(said("baked"), "--light-mode baked: is not GROUP=MODE (write sky=baked, for instance)");
  EXPECT_THAT(said("a=no"), testing::StartsWith("--light-mode a=no: "));
}

TEST_F(SceneOptionsTest, FilesAreThoseReadAndTheOverlayBeside) {
  const auto names = [&](const std::vector<FileStamp>& files) {
    std::string text;
    for (const FileStamp& file : files)
      text += file.path.filename().string() + (file.exists ? " " : " (missing) ");
    return text;
  };
  std::vector<FileStamp> files;
  load_lit_scene(options_, files);
  EXPECT_EQ(names(files), "one.mtl one.obj one.ssphh.json (missing) ");
  write_file(dir_ / "one.ssphh.json", R"({"lights": [{"name": "l", "type": "point", "intensity": 1}]})");
  load_lit_scene(options_, files);
  EXPECT_EQ(names(files), "one.mtl one.obj one.ssphh.json ");
  options_.overlay = dir_ / "absent.json";
  EXPECT_THAT(test::message_of([&] { load_lit_scene(options_, files); }), testing::HasSubstr("absent.json"));
  EXPECT_THAT(names(files), testing::HasSubstr("absent.json (missing) "));
  EXPECT_THAT(names(files), testing::HasSubstr("one.ssphh.json "));
}

TEST(WarnAboutLamps, ThatShineFromInsideOfABody) {
  scene::Scene scene = scene::make_builtin("furnace");  // a ball of radius 1 at the origin
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const auto said = [&](scene::LightType type, const vec3& at) {
    scene::Scene lit = scene;
    lit.nodes.emplace_back().local.translation = at;
    scene::Light& light = lit.lights.emplace_back();
    light.name = "glow", light.type = type, light.radius = 0.1f;
    light.node = static_cast<int>(lit.nodes.size()) - 1;
    if (type == scene::LightType::sphl) light.emission.frames = {sh::IntensitySh(0)};
    test::Logged logged;
    warn_about_lamps(geometry, lit, 0);
    return logged.take();
  };
  EXPECT_THAT(said(scene::LightType::sphl, vec3(0.1f, 0.2f, 0)),
              testing::HasSubstr("SPHL \"glow\" seems to shine from inside of a body"));
  EXPECT_EQ(said(scene::LightType::sphl, vec3(0, 3, 0)), "");
  EXPECT_EQ(said(scene::LightType::point, vec3(0.1f, 0.2f, 0)), "");
}

}  // namespace
}  // namespace ssphh::pipeline
