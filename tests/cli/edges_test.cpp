// Corners of commands that no other test passes: paths beside an output, pictures for screens, input that is
// piped, output that cannot be written.

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>

#include "commands/command.h"
#include "error_message.h"
#include "here.h"
#include "options/scene_options.h"
#include "places.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::json_here;
using test::text_here;
using testing::HasSubstr;

TEST(SceneOptions, TheSunStandsWhereTheCompassSays) {
  app::SceneOptions options;
  options.source = "builtin:cornell", options.sky.preetham = true;
  options.sky.elevation = 30, options.sky.azimuth = 90, options.sky.turbidity = 6;
  scene::Scene expected = scene::make_builtin("cornell");
  const scene::SunSkyParams east = {.elevation = pi / 6, .azimuth = 0, .turbidity = 6};
  EXPECT_NEAR(scene::sun_direction(east).x, std::cos(pi / 6), 1e-6);
  scene::add_sun_sky(expected, east);
  EXPECT_EQ(scene::light_hash(pipeline::load_scene(options)), scene::light_hash(expected));
  options.sky.turbidity = 3;
  EXPECT_NE(scene::light_hash(pipeline::load_scene(options)), scene::light_hash(expected));
}

// The problem of the first probe has its name, as any other's.
TEST(Lint, NamesTheProbeThatHasAProblem) {
  const test::TempDir dir;
  probes::ProbeSet set = place::init_from_scene(scene::make_builtin("cornell"), 1, 0);
  set.probes.resize(1);
  set.probes[0].edges.clear();
  set.probes[0].name = "first";
  set.probes[0].position = vec3(0.25f, 0.5f, 0.125f);
  const std::string file = dir / "a.sphl";
  probes::write_probe_file(set, file);
  const std::vector<std::string> command = {"probe", "lint", file, "--scene", "builtin:cornell", "--force"};
  const json::Value found = json_here(command, 1);
  const json::Value& problems = found["problems"];
  ASSERT_EQ(problems.size(), 3u) << print(found);
  EXPECT_EQ(problems[0]["kind"], "inside");
  EXPECT_EQ(problems[1]["kind"], "unlit");
  EXPECT_EQ(problems[2]["kind"], "unseen-room");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(problems[i]["probe"], "first");
    EXPECT_EQ(problems[i]["position"], (json::Value{0.25, 0.5, 0.125}));
  }
  EXPECT_EQ(problems[2]["probe"], nullptr) << "of no single one";
  const auto message = [&](std::size_t i) { return problems[i]["message"].string(); };
  const json::Value& room = problems[2]["position"];
  EXPECT_EQ(found["probes"], 1);
  EXPECT_EQ(text_here(command), fmt::format("inside: probe \"first\" at (0.25, 0.5, 0.125) m: {}\n"
                                            "unlit: probe \"first\" at (0.25, 0.5, 0.125) m: {}\n"
                                            "unseen-room: at ({:.6g}, {:.6g}, {:.6g}) m: {}\n"
                                            "{}: 1 probe, 3 problems",
                                            message(0), message(1), room[0].number(), room[1].number(),
                                            room[2].number(), message(2), file));
}

class Placed : public testing::Test {
 protected:
  Placed() {
    std::filesystem::create_directories(dir_ / "in");
    std::filesystem::create_directories(dir_ / "out/deep");
    write_file(dir_ / "in/a.obj",  // a room of two metres, seen from within
               "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
               "f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 5 6 2 1\nf 4 3 7 8\n");
    image::Image sky(4, 2);
    std::ranges::fill(sky.pixels, 1.0f);
    image::write_image(dir_ / "in/sky.exr", sky);
  }
  json::Value place(const std::string& scene, const std::string& probes = "1") const {
    const std::string output = dir_ / "out/deep/x.ssphh.json";
    json_here({"place", scene, "-o", output, "--probes", probes});
    return json::parse(read_text_file(output), output);
  }
  const std::string lit = R"({"$schema": "x", "environment": {"image": "sky.exr"}, "sphls": [)"
                          R"({"name": "own", "position": [0.2, 0.5, 0.2]}]})";
  const test::TempDir dir_;
};

TEST_F(Placed, OverlayNamesFilesAsItsOwnFolderSeesThem) {
  const json::Value plain = place(dir_ / "in/a.obj");
  EXPECT_EQ(plain["scene"], "../../in/a.obj");
  write_file(dir_ / "in/a.ssphh.json", lit);
  const json::Value beside = place(dir_ / "in/a.obj");
  EXPECT_EQ(beside["scene"], "../../in/a.obj");
  EXPECT_EQ(beside["environment"]["image"], "../../in/sky.exr");
  EXPECT_EQ(beside["sphls"][0]["name"], "own");
  EXPECT_EQ(beside["sphls"].size(), 1u) << "the one that was asked for is there already";
  EXPECT_FALSE(beside.contains("$schema"));
  write_file(dir_ / "in/whole.ssphh.json",
             fmt::format(R"({{"scene": "a.obj", "environment": {{"image": "{}"}}}})",
                         (dir_ / "in/sky.exr").string()));
  const json::Value whole = place(dir_ / "in/whole.ssphh.json");
  EXPECT_EQ(whole["scene"], "../../in/a.obj");
  EXPECT_EQ(whole["environment"]["image"], "../../in/sky.exr");
  EXPECT_EQ(whole["sphls"].size(), 1u);
  EXPECT_EQ(place("builtin:box", "6")["scene"], "builtin:box");
}

TEST(ComparedForScreens, AreMeasuredAsDisplayedAndTheirBlocksKeepTheirSize) {
  const test::TempDir dir;
  image::Image a(5, 3), b(5, 3);
  b.set_rgb(4, 2, vec3(1));  // alone in the last, cut block
  image::write_image(dir / "a.png", image::tone_map(a, {})),
      image::write_image(dir / "b.png", image::tone_map(b, {}));
  const std::vector<std::string> command = {"compare", dir / "a.png", dir / "b.png", "--block",    "2",
                                            "--map",   "pixelated",   "-o",          dir / "m.png"};
  const json::Value result = json_here(command);
  EXPECT_EQ(result["flip"]["kind"], "ldr");
  EXPECT_FALSE(result["flip"].contains("exposures"));
  EXPECT_EQ(result["map"]["kind"], "pixelated");
  EXPECT_EQ(result["blocks"]["max_block"], (json::Value{2, 1}));
  EXPECT_THAT(text_here(command), HasSubstr("   (as displayed)\n"));
  const image::Image map = image::read_image(dir / "m.png");
  ASSERT_EQ(map.width, 5);
  ASSERT_EQ(map.height, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_EQ(map.rgb(x, y) == map.rgb(0, 0), x < 4 || y < 2) << x << " " << y;
}

TEST(Piped, CoefficientsAreReadFromStdin) {
  std::istringstream in(R"({"degree": 0, "coefficients": [[1, 2, 3]]})");
  std::streambuf* const before = std::cin.rdbuf(in.rdbuf());
  const json::Value result = json_here({"sh", "irradiance", "-", "--normal", "0", "0", "1"});
  std::cin.rdbuf(before);
  const test::TempDir dir;
  write_file(dir / "a.json", in.str());
  EXPECT_EQ(result, json_here({"sh", "irradiance", dir / "a.json", "--normal", "0", "0", "1"}));
  std::cin.clear();
}

TEST(Piped, AReaderThatHasGoneEndsTheToolQuietly) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ::close(ends[0]);
  const int kept = ::dup(STDOUT_FILENO), errors = ::dup(STDERR_FILENO);
  const test::TempDir dir;
  const int err = ::open((dir / "err").c_str(), O_WRONLY | O_CREAT, 0600);
  ::dup2(ends[1], STDOUT_FILENO), ::dup2(err, STDERR_FILENO);
  const int status = std::system((test::tool_path() + " methods").c_str());
  ::dup2(kept, STDOUT_FILENO), ::dup2(errors, STDERR_FILENO);
  for (const int file : {ends[1], kept, errors, err}) ::close(file);
  EXPECT_EQ(read_text_file(dir / "err"), "");
  const bool of_pipe =
      WIFSIGNALED(status) ? WTERMSIG(status) == SIGPIPE : WEXITSTATUS(status) == 128 + SIGPIPE;
  EXPECT_TRUE(of_pipe) << status;
}

TEST(Piped, AResultThatCannotBeWrittenIsAnError) {
  std::fflush(stdout);
  const int kept = ::dup(STDOUT_FILENO), full = ::open("/dev/full", O_WRONLY);
  ::dup2(full, STDOUT_FILENO);
  const std::string said = test::message_of([] { app::Context().result({}, "text"); });
  ::dup2(kept, STDOUT_FILENO);
  ::close(kept), ::close(full);
  std::clearerr(stdout);
  EXPECT_EQ(said, "stdout: cannot write the result");
}

}  // namespace
}  // namespace ssphh
