// `ssphh web`: the folder that it writes, its manifest, its light, and what it refuses.

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <ssphh/core/file.h>
#include <ssphh/core/json.h>
#include <ssphh/image/io.h>
#include <ssphh/report/packed_image.h>
#include <ssphh/scene_io/load.h>

#include "here.h"
#include "json_schema.h"
#include "places.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

namespace fs = std::filesystem;
using test::joined;
using test::json_here;
using test::problem_here;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// IEEE 754 binary16 without sign.
float of_half(std::uint16_t half) {
  const int exponent = half >> 10 & 31, mantissa = half & 1023;
  return exponent == 0 ? std::ldexp(static_cast<float>(mantissa), -24)
                       : std::ldexp(static_cast<float>(mantissa | 1024), exponent - 25);
}

class Web : public testing::Test {
 protected:
  Web() {
    fs::create_directories(page_ + "/assets");
    write_file(page_ + "/index.html", std::string_view("<!doctype html>"));
    write_file(page_ + "/assets/page.js", std::string_view("export {};"));
  }
  std::vector<std::string> line(const std::string& scene, const std::vector<std::string>& more = {}) const {
    return joined({"web", scene, "--size", "64", "--direct-samples", "4", "--page", page_, "-o", out_}, more);
  }
  /// The command with light that is baked once for all tests, coarse: none of them compares it with a truth.
  std::vector<std::string> lit_line(const std::string& name,
                                    const std::vector<std::string>& more = {}) const {
    static const test::TempDir kept;
    const std::string scene = "builtin:" + name, probes = kept / (name + ".sphl");
    if (!fs::exists(probes)) bake(scene, probes);
    return joined(line(scene, {"--probes", probes}), more);
  }
  static void bake(const std::string& scene, const std::string& probes,
                   const std::vector<std::string>& more = {}) {
    json_here(joined({"bake", scene, "-o", probes, "--operator", "surfel", "--viz", "off", "--degree", "2",
                      "--directions", "64", "--surfel-size", "0.5", "--records", "200"},
                     more));
  }
  json::Value manifest() const { return json::parse(read_text_file(out_ + "/scene.json"), "scene.json"); }
  void expect_files_there() const {
    const json::Value all = manifest();
    for (const json::Value& file : all["files"].elements())
      EXPECT_EQ(fs::file_size(out_ + "/" + file["name"].string()),
                static_cast<std::uintmax_t>(file["bytes"].number()));
  }
  std::vector<float> layer(const json::Value& group, std::size_t pose, const json::Value& map) const {
    report::PackedImage packed{
        static_cast<int>(map["width"].number()), static_cast<int>(map["height"].number()), 3, "half", {}};
    for (const std::byte b : read_file(out_ + "/" + group["textures"][pose].string()))
      packed.bytes.push_back(std::to_integer<std::uint8_t>(b));
    std::vector<float> out;
    for (const std::uint16_t half : report::unpack(packed)) out.push_back(of_half(half));
    return out;
  }

  const test::TempDir dir_;
  const std::string out_ = dir_ / "room", page_ = dir_ / "page", probes_ = dir_ / "room.sphl";
};

TEST_F(Web, WritesAFolderWhoseManifestKeepsToItsSchemaAndNamesEveryFile) {
  const json::Value said =
      json_here(line("builtin:two-rooms", {"--quality", "draft", "--poses", "2", "--truth", "1", "--width",
                                           "32", "--height", "18", "--truth-cameras", "room-a"}));
  const std::string text = read_text_file(out_ + "/scene.json");
  EXPECT_THAT(test::schema_errors(test::source_dir() / "schemas/web-scene.schema.json", text), IsEmpty());
  expect_files_there();
  EXPECT_EQ(read_text_file(out_ + "/assets/page.js"), "export {};");

  const json::Value m = manifest();
  EXPECT_EQ(m["title"].string(), "two-rooms");
  ASSERT_EQ(m["times"].size(), 2u);
  ASSERT_EQ(m["lightmap"]["groups"][0]["textures"].size(), 2u);
  // The door has a place in the lightmaps, too.
  const scene::Scene scene = scene_io::load_scene(out_ + "/" + m["scene"].string());
  for (const scene::Instance& instance : scene.instances) {
    const bool door = scene.nodes[instance.node].name == "door";
    EXPECT_FALSE(door && scene.meshes[instance.mesh].uvs[1].empty());
  }
  EXPECT_NE(layer(m["lightmap"]["groups"][0], 0, m["lightmap"]),
            layer(m["lightmap"]["groups"][0], 1, m["lightmap"]));
  std::size_t truths = 0;
  for (const json::Value& camera : m["cameras"].elements()) {
    if (!camera.contains("truth")) continue;
    ++truths;
    EXPECT_EQ(camera["name"].string(), "room-a");
    EXPECT_EQ(image::read_image(out_ + "/" + camera["truth"]["file"].string()).width, 32);
  }
  EXPECT_EQ(truths, 1u);
  double bytes = 0;
  for (const json::Value& file : said["files"].elements()) bytes += file["bytes"].number();
  EXPECT_EQ(said["bytes"].number(), bytes);
}

TEST_F(Web, GroupsAddUpToAllLight) {
  json_here(lit_line("two-rooms"));
  const json::Value whole = manifest();
  const json::Value& apart = whole["lightmap"];
  std::vector<std::vector<float>> groups;
  for (const json::Value& group : apart["groups"].elements()) groups.push_back(layer(group, 0, apart));
  ASSERT_GE(groups.size(), 1u);
  json_here(lit_line("two-rooms", {"--merge-groups"}));
  const json::Value whole_merged = manifest();
  const json::Value& merged = whole_merged["lightmap"];
  ASSERT_EQ(merged["groups"].size(), 1u);
  const std::vector<float> all = layer(merged["groups"][0], 0, merged);
  float brightest = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    float sum = 0;
    for (const std::vector<float>& group : groups) sum += group[i];
    EXPECT_NEAR(sum, all[i], 0.008f * all[i] + 1e-4f);  // each is rounded to 9 bits
    brightest = std::max(brightest, all[i]);
  }
  EXPECT_GT(brightest, 0.1f);
}

TEST_F(Web, ReplacesItsOwnFolderAndNoOther) {
  const std::vector<std::string> command = lit_line("cornell");
  json_here(command);
  json_here(joined(command, {"--exposure", "2"}));
  EXPECT_EQ(manifest()["cameras"][0]["exposure"].number(), 2);
  expect_files_there();
  write_file(out_ + "/holiday.txt", std::string_view("mine"));
  EXPECT_THAT(problem_here(command), AllOf(HasSubstr("holiday.txt"), HasSubstr("--replace")));
  EXPECT_TRUE(fs::exists(out_ + "/holiday.txt"));
  json_here(joined(command, {"--replace"}));
  EXPECT_FALSE(fs::exists(out_ + "/holiday.txt"));
  for (const fs::directory_entry& entry : fs::directory_iterator(dir_.path()))
    EXPECT_FALSE(entry.path().string().ends_with(".part")) << entry.path();
}

TEST_F(Web, SaysWhatIsWrongBeforeAnyWork) {
  EXPECT_THAT(problem_here({"web", "builtin:cornell", "--page", dir_ / "none", "-o", out_}),
              HasSubstr("web_page"));
  EXPECT_THAT(problem_here({"web", "builtin:cornell", "--page", page_, "-o", dir_ / "no/where"}),
              HasSubstr("is not a folder"));
  write_file(dir_ / "file", std::string_view("x"));
  EXPECT_THAT(problem_here({"web", "builtin:cornell", "--page", page_, "-o", dir_ / "file"}),
              HasSubstr("is a file"));
  EXPECT_THAT(problem_here(line("builtin:two-rooms", {"--truth", "1", "--truth-cameras", "attic"})),
              AllOf(HasSubstr("attic"), HasSubstr("room-a")));
  EXPECT_THAT(problem_here(line("builtin:cornell", {"--texels-per-metre", "5000"})),
              HasSubstr("--texels-per-metre"));
  EXPECT_THAT(problem_here({"web", "builtin:two-rooms", "--page", page_, "-o", out_, "--size", "8192",
                            "--poses", "64"}),
              AllOf(HasSubstr("--size"), HasSubstr("--merge-groups")));
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(Web, AbsentCamerasAndLightsAreMadeUp) {
  write_file(dir_ / "box.obj", std::string_view("v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 4 3 2 1\n"));
  bake(dir_ / "box.obj", probes_);
  json_here(line(dir_ / "box.obj", {"--probes", probes_}));
  const json::Value m = manifest();
  EXPECT_EQ(m["cameras"].size(), 1u);
  ASSERT_EQ(m["lightmap"]["groups"].size(), 1u);
  EXPECT_EQ(m["environment_group"].string(), m["lightmap"]["groups"][0]["light_groups"][0].string());
}

TEST_F(Web, FlatLampsAreSeenAsMeshesOfTheirGroup) {
  const std::string lit = dir_ / "lit.ssphh.json";
  write_file(
      lit, std::string_view(R"({"scene": "builtin:cornell", "lights": [{"name": "panel", "type": "rectangle",
      "position": [0, 0.5, 0], "direction": [0, -1, 0], "width": 0.4, "height": 0.2, "intensity": 5}]})"));
  bake(lit, probes_);
  json_here(line(lit, {"--probes", probes_}));
  const scene::Scene page = scene_io::load_scene(out_ + "/" + manifest()["scene"].string());
  EXPECT_TRUE(page.lights.empty());
  ASSERT_FALSE(page.instances.empty());
  const scene::Instance& panel = page.instances.back();
  EXPECT_EQ(scene::light_group(page, panel), "panel");
  EXPECT_EQ(page.materials[static_cast<std::size_t>(scene::instance_material(page, panel))].emission,
            vec3(5));
}

TEST_F(Web, SmoothMetalsDoNotHoldLightThatTheyMirrorAtOneSpot) {
  write_file(dir_ / "floor.obj",
             std::string_view("mtllib floor.mtl\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nusemtl m\nf 4 3 2 1\n"));
  write_file(dir_ / "lamp.json",
             std::string_view(R"({"lights": [{"name": "lamp", "type": "sphere", "position": [0.5, 1, 0.5],
                                              "radius": 0.1, "intensity": 100}]})"));
  const auto brightest = [&](std::string_view material) {
    write_file(dir_ / "floor.mtl", material);
    const std::vector<std::string> lamp = {"--overlay", dir_ / "lamp.json"};
    bake(dir_ / "floor.obj", probes_, lamp);
    json_here(joined(line(dir_ / "floor.obj", {"--probes", probes_}), lamp));
    const json::Value m = manifest();
    return std::ranges::max(layer(m["lightmap"]["groups"][0], 0, m["lightmap"]));
  };
  const float plain = brightest("newmtl m\nKd 0.5 0.5 0.5\n");
  EXPECT_GT(plain, 1);
  // Of roughness 0.1 a hundredth stays; nothing else lights the floor.
  EXPECT_NEAR(brightest("newmtl m\nKd 0.5 0.5 0.5\nPm 1\nPr 0.1\n"), 0.01f * plain, 1e-3f * plain);
}

TEST_F(Web, LampsThatAreDraggedHaveTheirLightAtPlacesAroundThem) {
  const json::Value said =
      json_here(lit_line("two-rooms", {"--movable", "lamp", "--movable-step", "2", "--movable-size", "64"}));
  EXPECT_THAT(test::schema_errors(test::source_dir() / "schemas/web-scene.schema.json",
                                  read_text_file(out_ + "/scene.json")),
              IsEmpty());
  expect_files_there();
  const json::Value m = manifest();
  const json::Value &movable = m["movable"], &lamp = movable["lamps"][0], &lattice = lamp["lattice"];
  const auto places = static_cast<std::size_t>(lattice["places"].number());
  EXPECT_EQ(said["movable"][0]["name"].string(), "lamp");
  EXPECT_EQ(said["movable"][0]["places"].number(), lattice["places"].number());
  EXPECT_GT(places, 8u);
  EXPECT_EQ(lamp["power"][0].number(), 4);

  std::size_t crossings = 1, boxes = 1;
  for (const json::Value& planes : lattice["planes"].elements()) {
    crossings *= planes.size();
    boxes *= static_cast<std::size_t>(planes[planes.size() - 1].number());
  }
  EXPECT_EQ(lattice["place_of"].size(), crossings);
  EXPECT_EQ(fs::file_size(out_ + "/" + lattice["boxes"].string()), boxes);

  // Each chart's texels, without gutters.
  const std::vector<std::byte> charts = read_file(out_ + "/" + movable["charts"].string());
  const auto number = [&](std::size_t i) {
    return std::to_integer<std::size_t>(charts[2 * i]) +
           256 * std::to_integer<std::size_t>(charts[2 * i + 1]);
  };
  std::size_t texels = 0;
  for (std::size_t c = 0; c < charts.size() / 16; ++c) {
    EXPECT_LE(number(8 * c + 4) + number(8 * c + 6), 64u);
    texels += number(8 * c + 6) * number(8 * c + 7);
  }
  const json::Value size = {{"width", texels}, {"height", places}};
  const std::vector<float> light = layer(lamp, 0, size);
  ASSERT_EQ(light.size(), 3 * texels * places);

  // At the lamp's own place it is the lightmap's less direct light: of the mean of all, some.
  double darkest = INFINITY, brightest = 0;
  for (std::size_t p = 0; p < places; ++p) {
    double sum = 0;
    for (std::size_t i = 0; i < 3 * texels; ++i) sum += light[3 * texels * p + i];
    darkest = std::min(darkest, sum), brightest = std::max(brightest, sum);
  }
  EXPECT_GT(darkest, 0);
  EXPECT_GT(brightest, 1.05 * darkest);  // places differ
}

TEST_F(Web, SaysWhichLampsCannotBeDragged) {
  const auto problem = [&](const std::string& scene, const std::vector<std::string>& more) {
    return problem_here(line(scene, more));
  };
  EXPECT_THAT(problem("builtin:two-rooms", {"--movable", "lanp"}),
              AllOf(HasSubstr("lanp"), HasSubstr("did you mean \"lamp\"")));
  EXPECT_THAT(problem("builtin:two-rooms", {"--movable", "lamp", "--movable-step", "0.001"}),
              AllOf(HasSubstr("--movable lamp"), HasSubstr("4096 is the most"), HasSubstr("farther apart")));
  EXPECT_THAT(problem("builtin:two-rooms", {"--movable", "lamp", "--movable-size", "16"}),
              HasSubstr("--movable-size 16"));
  EXPECT_THAT(problem("builtin:cornell", {"--movable", "lamp"}), HasSubstr("shining surfaces"));
  write_file(dir_ / "lamps.json", std::string_view(R"({"lights": [
    {"name": "sun", "type": "directional", "direction": [0, -1, 0], "intensity": 1},
    {"name": "left", "type": "point", "light_group": "pair", "position": [-2, 1, 0], "intensity": 1},
    {"name": "right", "type": "point", "light_group": "pair", "position": [-1, 1, 0], "intensity": 1}]})"));
  const auto overlaid = [&](const std::string& lamp) {
    return problem("builtin:two-rooms", {"--overlay", dir_ / "lamps.json", "--movable", lamp});
  };
  EXPECT_THAT(overlaid("sun"), HasSubstr("is at infinity"));
  EXPECT_THAT(overlaid("left"),
              AllOf(HasSubstr("shares the light group \"pair\""), HasSubstr("--movable all")));
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(Web, StopsWhenAskedAndLeavesNothing) {
  CancelToken stop;
  stop.request();
  EXPECT_THROW(test::run_here(line("builtin:cornell"), {nullptr, &stop}), Cancelled);
  EXPECT_FALSE(fs::exists(out_));
}

}  // namespace
}  // namespace ssphh
