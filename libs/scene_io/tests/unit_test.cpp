/// Units of length: told, guessed, and what scales with them.

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/overlay.h>
#include <ssphh/scene_io/unit.h>

#include "error_message.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using scene::Scene;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

vec3 size_of(const Scene& scene) {
  const auto bounds = scene::world_bounds(scene, scene::world_matrices(scene));
  return bounds.max - bounds.min;
}

/// A builtin scene as a file of that unit holds it.
Scene in_units_of(const std::string& name, float metres) {
  Scene scene = scene::make_builtin(name);
  set_unit(scene, 1 / metres);
  return scene;
}

TEST(Units, AreNamedOrNumbers) {
  const Scene scene;
  const auto metres = [&](const std::string& unit) { return metres_per_unit(unit, scene, "s"); };
  EXPECT_EQ(metres("mm"), 0.001f);
  EXPECT_EQ(metres("cm"), 0.01f);
  EXPECT_EQ(metres("m"), 1);
  EXPECT_EQ(metres("inch"), 0.0254f);
  EXPECT_EQ(metres("0.3048"), 0.3048f);
  EXPECT_EQ(metres("1e-3"), 0.001f);
  EXPECT_EQ(metres("auto"), 1) << "of a scene that shows nothing";
  for (const char* good : {"mm", "auto", "2"}) EXPECT_EQ(unit_problem(good), "") << good;
  for (const char* bad : {"", "0", "-1", "nan", "inf", "1 m", "MM", "1e-60", "0x1"}) {
    EXPECT_EQ(test::message_of([&] { metres(bad); }),
              std::string("s: \"") + bad +
                  "\" is no unit of length: mm, cm, m, inch, auto, or metres per unit as a number above 0");
    EXPECT_NE(unit_problem(bad), "");
  }
}

TEST(Units, BuiltinScenesAreInMetres) {
  for (const auto& builtin : scene::builtin_scenes())
    EXPECT_EQ(guess_unit(scene::make_builtin(std::string(builtin.name))), 1) << builtin.name;
}

// house stands on a plain of 250 m, whose four corners do not count.
TEST(Units, OfRoomsAndHousesAreGuessed) {
  for (const char* name : {"house", "two-rooms", "gallery1", "gallery3"}) {
    EXPECT_EQ(guess_unit(in_units_of(name, 0.01f)), 0.01f) << name;
    EXPECT_EQ(guess_unit(in_units_of(name, 0.001f)), 0.001f) << name;
  }
}

/// A box of vertices.
Scene box(vec3 size) {
  Scene scene;
  scene.nodes.emplace_back();
  auto& mesh = scene.meshes.emplace_back();
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(
        size * vec3(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)));
  auto& instance = scene.instances.emplace_back();
  instance.mesh = 0, instance.node = 0;
  return scene;
}

TEST(Units, AreMetresWhereThatCanBe) {
  EXPECT_EQ(guess_unit(box({5, 3, 4})), 1);
  EXPECT_EQ(guess_unit(box({100, 80, 90})), 1) << "a house, or a toy in millimetres";
  EXPECT_EQ(guess_unit(box({870, 6, 8})), 1) << "a tunnel; 6 cm are no room";
  EXPECT_EQ(guess_unit(box({300, 12, 400})), 1) << "a street";
  EXPECT_EQ(guess_unit(box({500, 260, 400})), 0.01f);
  EXPECT_EQ(guess_unit(box({5000, 2600, 4000})), 0.001f);
  EXPECT_EQ(guess_unit(box({3700, 1660, 1500})), 0.01f) << "an atrium of 37 m, not one of 1.66 m in height";
  EXPECT_EQ(guess_unit(box({500, 0, 400})), 0.01f) << "a floor";
  EXPECT_EQ(guess_unit(box({0, 0, 0})), 1);
}

// A dome of few vertices around a room of many.
TEST(Units, AreNotGuessedFromWhatLiesFarAround) {
  Scene scene = box({10'000, 10'000, 10'000});
  EXPECT_EQ(guess_unit(scene), 0.001f);
  scene.meshes.push_back(box({5, 3, 4}).meshes[0]);
  auto& vertices = scene.meshes[1].positions;
  for (int doubled = 0; doubled < 7; ++doubled) {
    const auto copy = vertices;
    vertices.insert(vertices.end(), copy.begin(), copy.end());
  }
  scene.instances.push_back(scene.instances[0]);
  scene.instances[1].mesh = 1;
  EXPECT_EQ(guess_unit(scene), 1);
}

TEST(Units, ScalePositionsAndTheLengthsOutsideOfNodes) {
  Scene scene = scene::make_builtin("cornell");
  const vec3 size = size_of(scene);
  const auto nodes = scene.nodes.size();
  scene.lights.resize(1);
  scene.lights[0].node = 0, scene.lights[0].range = 3000, scene.lights[0].intensity = 7,
  scene.lights[0].radius = 0.1f;
  scene.cameras.resize(1);
  scene.cameras[0].node = 0, scene.cameras[0].orthographic = true, scene.cameras[0].yheight = 2000;
  scene.sphls.resize(1);
  scene.sphls[0].node = 0, scene.sphls[0].radius = 0.1f;
  set_unit(scene, 0.001f, vec3(1000, 0, 0));
  EXPECT_EQ(scene.nodes.size(), nodes + 1);
  EXPECT_LE(glm::length(size_of(scene) - 0.001f * size), 1e-6f);
  EXPECT_EQ(vec3(scene::world_matrices(scene)[0][3]), vec3(-1, 0, 0));
  EXPECT_FLOAT_EQ(scene.lights[0].range, 3);
  EXPECT_FLOAT_EQ(scene.cameras[0].yheight, 2);
  EXPECT_EQ(scene.lights[0].intensity, 7) << "candela, whatever the unit of length";
  EXPECT_EQ(scene.lights[0].radius, 0.1f) << "is in metres in every file";
  EXPECT_EQ(scene.sphls[0].radius, 0.1f);
}

class UnitOptions : public testing::Test {
 protected:
  UnitOptions() {
    set_log_sink([this](LogLevel, const std::string& line) { lines_.push_back(line); });
    write_file(dir_ / "t.obj", "v 0 0 0\nv 5000 0 0\nv 0 2600 4000\nf 1 2 3\n");
  }
  ~UnitOptions() override { set_log_sink({}); }

  Scene load(const std::string& unit, const std::string& file = "t.obj") {
    lines_.clear();
    LoadOptions options;
    options.unit = unit;
    return load_scene((dir_ / file).string(), options);
  }
  float width(const std::string& unit, const std::string& file = "t.obj") {
    return size_of(load(unit, file)).x;
  }
  std::string place(const std::string& file) const { return (dir_ / file).string(); }

  test::TempDir dir_{test::memory_dir()};
  std::vector<std::string> lines_;
};

TEST_F(UnitOptions, AreToldOrGuessedAloud) {
  EXPECT_FLOAT_EQ(width("mm"), 5);
  EXPECT_THAT(lines_, IsEmpty());
  EXPECT_FLOAT_EQ(width("inch"), 127);
  EXPECT_FLOAT_EQ(width(""), 5000);
  EXPECT_THAT(lines_, ElementsAre(HasSubstr("--unit mm, cm, inch or auto")));
  EXPECT_FLOAT_EQ(width("auto"), 5);
  EXPECT_THAT(lines_, ElementsAre(place("t.obj") +
                                  ": would be 5e+03 m wide and 2.6e+03 m high: its unit is taken for the "
                                  "millimetre (--unit m, or another, overrules this)"));
  EXPECT_EQ(
      test::message_of([&] { load("yard"); }),
      "unit: \"yard\" is no unit of length: mm, cm, m, inch, auto, or metres per unit as a number above 0");
}

// The overlay's own positions are metres in every case.
TEST_F(UnitOptions, TakeThePlaceOfAnOverlays) {
  const std::string camera = R"("cameras": [{"name": "c", "position": [1, 2, 3]}])";
  const auto camera_of = [](const Scene& scene) { return vec3(scene::camera_pose(scene, "c").world[3]); };
  write_file(dir_ / "t.ssphh.json", R"({"unit": 0.01, "origin": [1000, 0, 0], )" + camera + "}");
  EXPECT_FLOAT_EQ(width(""), 50);
  const Scene scene = load("mm");
  EXPECT_FLOAT_EQ(size_of(scene).x, 5);
  EXPECT_EQ(camera_of(scene), vec3(1, 2, 3));
  EXPECT_FLOAT_EQ(scene::world_bounds(scene, scene::world_matrices(scene)).min.x, -1);
  write_file(dir_ / "t.ssphh.json", R"({"unit": "auto", )" + camera + "}");
  EXPECT_FLOAT_EQ(width(""), 5);
  EXPECT_THAT(lines_, ElementsAre(HasSubstr("t.ssphh.json: would be 5e+03 m wide")));
  EXPECT_FLOAT_EQ(width("cm"), 50);
  write_file(dir_ / "t.ssphh.json", "{" + camera + "}");
  EXPECT_EQ(camera_of(load("mm")), vec3(1, 2, 3));
}

TEST_F(UnitOptions, CountOnceWhereOverlaysLieOnEachOther) {
  write_file(dir_ / "a.ssphh.json", R"({"scene": "t.obj", "unit": "cm"})");
  write_file(dir_ / "b.json", R"({"sphls": [{"position": [1, 1, 1]}]})");
  LoadOptions options;
  options.overlay = place("b.json"), options.unit = "mm";
  const Scene scene = load_scene(place("a.ssphh.json"), options);
  EXPECT_FLOAT_EQ(size_of(scene).x, 5);
  EXPECT_EQ(scene.sphls.size(), 1u);
}

}  // namespace
}  // namespace ssphh::scene_io
