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

TEST_F(Web, StopsWhenAskedAndLeavesNothing) {
  CancelToken stop;
  stop.request();
  EXPECT_THROW(test::run_here(line("builtin:cornell"), {nullptr, &stop}), Cancelled);
  EXPECT_FALSE(fs::exists(out_));
}

}  // namespace
}  // namespace ssphh
