/// Which reader a source is given to, what goes with it, and what is said of odd ones.

#include <fstream>

#include <gtest/gtest.h>

#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/load.h>

#include "error_message.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using ssphh::test::memory_dir;
using ssphh::test::message_of;
using ssphh::test::TempDir;

class Loading : public testing::Test {
 protected:
  void SetUp() override {
    set_log_sink([this](LogLevel, const std::string& line) { lines_.push_back(line); });
  }
  void TearDown() override { set_log_sink({}); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(dir_ / name) << text;
    return (dir_ / name).string();
  }
  /// A triangle with legs of `size`, its corner at x.
  std::string triangle(float size, float x = 0) const {
    return write("t.obj", fmt::format("v {0} 0 0\nv {1} 0 0\nv {0} {2} 0\nf 1 2 3\n", x, x + size, size));
  }
  std::string said_of(const std::string& path) const {
    const std::string said = message_of([&] { load_scene(path); });
    return said.starts_with(path) ? said.substr(path.size()) : said;
  }
  std::vector<std::string> warnings_of(const std::string& path, const LoadOptions& options = {}) {
    lines_.clear();
    load_scene(path, options);
    std::vector<std::string> rest;
    for (const std::string& line : lines_)
      rest.push_back(line.starts_with(path) ? line.substr(path.size()) : line);
    return rest;
  }
  TempDir dir_{memory_dir()};
  std::vector<std::string> lines_;
};

using Lines = std::vector<std::string>;

TEST_F(Loading, IsAtTimeZeroAndAddsNothingUnlessSomebodySaysSo) {
  const LoadOptions options;
  EXPECT_EQ(options.overlay + options.unit + options.environment, "");
  EXPECT_EQ(options.time, 0);
  EXPECT_EQ(options.environment_intensity, 1);
  EXPECT_EQ(options.environment_rotation, 0);
  EXPECT_FALSE(options.sun_sky);
}

// The sphere around the box of a right triangle of legs a has the diameter a√2.
TEST_F(Loading, WarnsOfScenesThatAreLargeOrFarAway) {
  EXPECT_EQ(warnings_of(triangle(1414)), Lines{}) << "1999.7 m";
  EXPECT_EQ(
      warnings_of(triangle(1415)),
      Lines{": is 2001 m across; if its unit is no metre, say so: --unit mm, cm, inch or auto, or in an "
            "overlay: {\"unit\": 0.001}"});
  EXPECT_EQ(warnings_of(triangle(1, 140)), Lines{}) << "140.5 m, the size is 1.414 m";
  EXPECT_EQ(warnings_of(triangle(1, 142)), Lines{": lies 143 m from the origin and is 1.41 m across, which "
                                                 "costs precision; move it with \"origin\" in an "
                                                 "overlay"});
  EXPECT_EQ(warnings_of(triangle(0.001f, 0.2f)).size(), 1u) << "as of any size";
}

TEST_F(Loading, TellsFormatsByContentThenByName) {
  EXPECT_EQ(load_scene(write("a.txt", " \n{\"asset\":{\"version\":\"2.0\"}}")).instances.size(), 0u);
  EXPECT_EQ(load_scene(triangle(1)).instances.size(), 1u);
  EXPECT_EQ(load_scene(write("B.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).instances.size(), 1u);
  EXPECT_EQ(said_of(write("a.glb", "none")), ": is no GLB file: it does not begin with \"glTF\"");
  EXPECT_EQ(said_of(write("a.xyz", "none")),
            ": is no scene of a known format (known are glTF 2.0 (.gltf, .glb), "
            "Wavefront OBJ (.obj) and overlays (.ssphh.json))");
  EXPECT_EQ(said_of(write("a.gltf", "none")).substr(0, 20), ": is not valid JSON:");
  EXPECT_EQ(load_scene("builtin:cornell").name, "cornell");
}

TEST_F(Loading, OverlaysNameASceneOrStandBesideIt) {
  triangle(1);
  const std::string named = write("o.json", R"({"scene": "t.obj", "cameras": [{"name": "c"}]})");
  EXPECT_EQ(load_scene(named).cameras.at(0).name, "c");
  EXPECT_EQ(said_of(write("p.json", R"({"scene": "o.json"})")),
            (dir_ / "o.json").string() + ": is an overlay; one cannot stand on another");
  EXPECT_EQ(said_of(write("q.json", "{}")),
            ": \"scene\" is missing (a JSON file is a scene when it names one: {\"scene\": \"FILE.glb\"})");
  write("t.ssphh.json", R"({"cameras": [{"name": "beside"}]})");
  const std::string scene = (dir_ / "t.obj").string();
  EXPECT_EQ(load_scene(scene).cameras.at(0).name, "beside");
  LoadOptions options;
  options.overlay = write("other.json", R"({"cameras": [{"name": "given"}, {}]})");
  EXPECT_EQ(load_scene(scene, options).cameras.size(), 2u) << "in place of that beside it";
}

TEST_F(Loading, EnvironmentsReplaceThatOfTheScene) {
  const LoadOptions defaults;
  EXPECT_EQ(defaults.environment_intensity, 1);
  EXPECT_EQ(defaults.environment_rotation, 0);
  EXPECT_FALSE(defaults.sun_sky);
  const std::string scene = triangle(1);
  image::write_image(dir_ / "e.exr", image::Image(4, 2));
  LoadOptions options;
  options.environment = (dir_ / "e.exr").string();
  options.environment_intensity = 3, options.environment_rotation = 0.5f;
  const auto read = load_scene(scene, options).environment;
  ASSERT_TRUE(read);
  EXPECT_EQ(read->equirect.width, 4);
  EXPECT_EQ(read->color, vec3(3));
  EXPECT_EQ(read->rotation, 0.5f);
  options.environment.clear();
  EXPECT_FALSE(load_scene(scene, options).environment);
  write("t.ssphh.json", R"({"environment": {"rotation_degrees": 90}})");
  EXPECT_FLOAT_EQ(load_scene(scene, options).environment.value().rotation, pi / 2 + 0.5f);
  options.sun_sky.emplace();
  options.sun_sky->width = 8;
  EXPECT_EQ(load_scene(scene, options).environment.value().equirect.width, 8);
  for (const auto& [intensity, rotation] : {std::pair{-1.0f, 0.0f}, {INFINITY, 0.0f}, {1.0f, INFINITY}}) {
    options.environment_intensity = intensity, options.environment_rotation = rotation;
    EXPECT_EQ(message_of([&] { load_scene(scene, options); }),
              "environment: its intensity and rotation must be finite, the first not negative");
  }
}

TEST_F(Loading, SaysWhatIsNotShownOrUsed) {
  EXPECT_EQ(warnings_of(write("a.gltf", R"({"asset":{"version":"2.0"},"extensions":{"X_a":{}}})")),
            (Lines{": shows no triangles", ": ignored: extension X_a (1)"}));
}

}  // namespace
}  // namespace ssphh::scene_io
