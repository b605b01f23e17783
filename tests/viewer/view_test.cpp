// `ssphh view` in a window without a screen (Xvfb): it opens, answers the mouse and the keyboard, a door that
// opens brightens the room behind it, pictures and scenes are written. Without a display it says so.

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>

#include "joined.h"
#include "temp_dir.h"
#include "tev_listener.h"
#include "tool_checks.h"
#include "variable.h"
#include "xvfb.h"

namespace ssphh {
namespace {

using test::expect_failure;
using test::expect_keys;
using test::joined;
using test::run_json;
using test::TempDir;
using testing::HasSubstr;

class View : public testing::Test {
 protected:
  void SetUp() override {
    if (!display_.running()) GTEST_SKIP() << "Xvfb is not installed: the viewer's window is not tested";
  }

  std::string script(const std::string& text) {
    const std::string file = dir_ / "script.txt";
    std::ofstream(file) << text;
    return file;
  }
  std::string path(const std::string& name) const { return dir_ / name; }
  bool exists(const std::string& name) const { return std::filesystem::exists(dir_ / name); }

  /// Mean linear light of a picture.
  double brightness(const std::string& name) const {
    const image::Image picture = image::read_image(dir_ / name);
    double sum = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) sum += static_cast<double>(luminance(picture.rgb(x, y)));
    }
    return sum / (static_cast<double>(picture.width) * picture.height);
  }

  test::Xvfb display_;
  TempDir dir_;
};

const std::vector<std::string> two_rooms = {"view",        "builtin:two-rooms", "--size", "160x100",
                                            "--no-panels", "--exposure",        "0",      "--tonemap",
                                            "clip",        "--records",         "256"};

TEST_F(View, AnOpenedDoorBrightensTheRoomBehindIt) {
  const json::Value run = run_json(joined(
      two_rooms,
      {"--camera", "room-b", "--stats", path("times.json"), "--script",
       script("settle\nscreenshot " + path("shut.png") + "\ntime 1\nsettle\nscreenshot " + path("open.png") +
              "\nlight lamp off\nsettle\nscreenshot " + path("off.png") + "\nquit\n")}));
  expect_keys(run, {"frames", "renderer", "probes", "median_ms", "p99_ms", "geometry_builds", "written"});
  EXPECT_EQ(run["probes"], 6);
  ASSERT_TRUE(exists("shut.png") && exists("open.png") && exists("off.png"));
  // 8-bit pictures: a dark room has at most a step or two of light in it.
  EXPECT_LT(brightness("shut.png"), 2.0 / 255 / 12.92);
  EXPECT_GT(brightness("open.png"), 0.005);
  EXPECT_EQ(brightness("off.png"), 0);
  const json::Value times = test::parse_json(read_text_file(path("times.json")));
  EXPECT_THAT(print(times["stages"]), testing::AllOf(HasSubstr("relight"), HasSubstr("frame")));
}

TEST_F(View, MouseAndKeysChangeWhatIsShown) {
  // A drag turns the view, a key shows the probes, Tab hides the panels, undo takes an edit back.
  run_json({"view", "builtin:two-rooms", "--size", "480x300", "--tonemap", "clip", "--records", "0",
            "--antialias", "off", "--script",
            script("settle\nscreenshot " + path("a.png") + "\nsettle\nscreenshot " + path("same.png") +
                   "\ndrag 400 150 460 170\nsettle\nscreenshot " + path("turned.png") +
                   "\nkey P\nsettle\nscreenshot " + path("balls.png") +
                   "\nkey P\nlight lamp color 1 0 0\nsettle\nscreenshot " + path("red.png") +
                   "\nkey Ctrl+Z\nsettle\nscreenshot " + path("undone.png") + "\nscreenshot " +
                   path("panels.png") + " panels\nkey Tab\nwait 3\nscreenshot " + path("bare.png") +
                   " panels\nquit\n")});
  const auto bytes = [&](const std::string& name) {
    std::ifstream file(path(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_TRUE(bytes("a.png") == bytes("same.png")) << "nothing changed";
  EXPECT_FALSE(bytes("turned.png") == bytes("a.png"));
  EXPECT_FALSE(bytes("balls.png") == bytes("turned.png"));
  EXPECT_FALSE(bytes("red.png") == bytes("turned.png"));
  // Light settles to within a tolerance that leaves the last bits to where it came from.
  EXPECT_NEAR(brightness("undone.png"), brightness("turned.png"), 0.002);
  EXPECT_GT(std::abs(brightness("red.png") - brightness("turned.png")), 0.02);
  const image::Image panels = image::read_image(path("panels.png"));
  EXPECT_EQ(panels.width, 480);
  EXPECT_EQ(panels.height, 300);
  EXPECT_FALSE(bytes("bare.png") == bytes("panels.png"));
}

TEST_F(View, SavesWhatWasEdited) {
  run_json(joined(
      two_rooms, {"--script",
                  script("settle\nlight lamp intensity 7\nsphl 2 1.5 0.5\nsettle\nsave " + path("rooms.glb") +
                         "\nsave " + path("rooms.sphl") + "\nbookmark\nview 1 1 1 2 1 0\nbookmark\nsave " +
                         path("path.json") + "\nquit\n")}));
  const json::Value scene = run_json({"scene", "info", path("rooms.glb")});
  EXPECT_EQ(scene["sphls"], 7);
  EXPECT_EQ(scene["lights"], 1);
  // The saved probes are those of the saved scene: the viewer takes them without --force.
  const json::Value again = run_json({"view", path("rooms.glb"), "--probes", path("rooms.sphl"), "--size",
                                      "160x100", "--no-panels", "--screenshot", path("again.png")});
  EXPECT_EQ(again["probes"], 7);
  // An export replaces the frames of an older, longer one.
  std::filesystem::create_directory(path("frames"));
  std::ofstream(path("frames/frame-0003.png")) << "old";
  std::ofstream(path("frames/notes.txt")) << "mine";
  const json::Value frames = run_json(joined(
      two_rooms, {"--probes", "off", "--path", path("path.json"), "--export", path("frames"), "--fps", "1"}));
  EXPECT_EQ(frames["written"].size(), 3u);
  EXPECT_TRUE(exists("frames/frame-0002.png"));
  EXPECT_FALSE(exists("frames/frame-0003.png"));
  EXPECT_TRUE(exists("frames/notes.txt"));
}

TEST_F(View, ALampAndACameraOfAnOverlayAreThoseOfRender) {
  run_json(
      joined(two_rooms, {"--probes", "off", "--script",
                         script("camera room-b\nadd-light spot desk 2 2.3 0.5\nlight desk aim 2.5 0 0.5\n"
                                "light desk intensity 9\nadd-camera corner\nsettle\nscreenshot " +
                                path("view.png") + "\nsave " + path("mine.ssphh.json") + "\nquit\n")}));
  for (const std::vector<std::string>& scene :
       {std::vector<std::string>{path("mine.ssphh.json")},
        {"builtin:two-rooms", "--overlay", path("mine.ssphh.json")}}) {
    run_json(joined(joined({"render"}, scene),
                    {"--camera", "corner", "--method", "direct", "--width", "160", "--height", "100", "--spp",
                     "16", "--exposure", "0", "-o", path("render.png")}));
    EXPECT_GT(brightness("view.png"), 0.01);
    EXPECT_NEAR(brightness("render.png"), brightness("view.png"), 0.05 * brightness("view.png"));
  }
}

TEST_F(View, AnExrHasTheLightOfRender) {
  run_json({"view", "builtin:cornell", "--size", "96x96", "--no-panels", "--probes", "off", "--exposure", "2",
            "--screenshot", path("view.exr")});
  run_json({"render", "builtin:cornell", "--backend", "gl", "--method", "direct", "--width", "96", "--height",
            "96", "--spp", "16", "-o", path("render.exr")});
  const image::Image view = image::read_image(dir_ / "view.exr"),
                     render = image::read_image(dir_ / "render.exr");
  ASSERT_EQ(view.pixels.size(), render.pixels.size());
  double difference = 0, all = 0;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    const float a = std::min(view.pixels[i], 1.0f), b = std::min(render.pixels[i], 1.0f);
    difference += std::abs(a - b), all += b;
  }
  EXPECT_GT(all, 0);
  EXPECT_LT(difference, 0.03 * all) << "samples at edges stand elsewhere in their pixels";
}

TEST_F(View, FramesOfAPathGlideToWhatSuitsThemAlike) {
  const auto view = [](float time, float x) {
    return fmt::format(
        R"({{"time": {}, "position": [{}, 1.6, 0.5], "look_at": [6, 1.2, 0.5], "yfov_degrees": 50}})", time,
        x);
  };
  std::ofstream(dir_ / "walk.json") << R"({"keys": [)" << view(0, -3) << ", " << view(1, 3) << "]}";
  const auto drawn = [&](const std::string& folder, const std::string& exposure) {
    run_json({"view", "builtin:two-rooms", "--time", "1", "--size", "64x64", "--no-panels", "--records", "0",
              "--tonemap", "clip", "--exposure", exposure, "--path", path("walk.json"), "--export",
              path(folder), "--fps", "3"});
    std::vector<double> light;
    for (int i = 0; i < 4; ++i) light.push_back(brightness(fmt::format("{}/frame-{:04}.png", folder, i)));
    return light;
  };
  const std::vector<double> followed = drawn("a", "auto"), fixed = drawn("b", "0");
  EXPECT_EQ(drawn("c", "auto"), followed) << "however many turns the light took";
  EXPECT_GT(followed[3], 2 * fixed[3]) << "on the way to what the dark room needs";
  EXPECT_GT(followed[0] / fixed[0], 0.7);
  EXPECT_LT(followed[0] / fixed[0], 4) << "the bright one";
}

/// Runs an xdotool command until `file` exists: the window may not be ready for input at once.
bool repeat_until(const test::ToolProcess& viewer, const std::string& command, const std::string& file) {
  for (int i = 0; i < 20 && viewer.running() && !std::filesystem::exists(file); ++i) {
    if (std::system(("timeout 10 xdotool " + command + " > /dev/null 2>&1").c_str()) != 0) continue;
    for (int k = 0; k < 40 && !std::filesystem::exists(file); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(25));
  }
  return std::filesystem::exists(file);
}

TEST_F(View, AnswersTheWindowSystemsMouseAndKeys) {
  if (std::system("command -v xdotool > /dev/null") != 0) GTEST_SKIP() << "xdotool is not installed";
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(dir_.path());  // F12 writes into the current folder
  test::ToolProcess viewer(
      {"view", "builtin:two-rooms", "--size", "480x300", "--probes", "off", "--no-panels"});
  std::filesystem::current_path(before);
  const std::string window = "search --sync --onlyvisible --name two-rooms windowfocus ";
  EXPECT_TRUE(repeat_until(viewer, window + "key --delay 200 F12", path("two-rooms-01.png")));
  EXPECT_TRUE(
      repeat_until(viewer,
                   window + "mousemove --window %1 240 150 mousedown 1 sleep 0.3 "
                            "mousemove --window %1 300 170 sleep 0.3 mouseup 1 sleep 0.2 key --delay 200 F12",
                   path("two-rooms-02.png")));
  viewer.signal(SIGINT);
  const test::ToolResult result = viewer.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto a = image::read_image(path("two-rooms-01.png")), b = image::read_image(path("two-rooms-02.png"));
  EXPECT_NE(a.pixels, b.pixels) << "the drag turned the view";
}

TEST_F(View, ADisplayThatGoesAwayTakesNoEditsAlong) {
  if (std::system("command -v xdotool > /dev/null") != 0) GTEST_SKIP() << "xdotool is not installed";
  const test::Variable state("XDG_STATE_HOME", path("state").c_str());
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(dir_.path());
  auto screen = std::make_unique<test::Xvfb>();
  test::ToolProcess viewer(
      {"view", "builtin:two-rooms", "--size", "480x300", "--probes", "off", "--no-panels"});
  std::filesystem::current_path(before);
  const std::string window = "search --sync --onlyvisible --name two-rooms windowfocus ";
  EXPECT_TRUE(repeat_until(viewer,
                           window + "key --delay 200 N sleep 0.3 mousemove --window %1 240 150 click 1 sleep "
                                    "0.5 key --delay 200 F12",
                           path("two-rooms-01.png")));
  screen.reset();
  EXPECT_EQ(viewer.wait().exit_code, 1);
  const std::filesystem::path kept = path("state") + "/ssphh/autosave";
  ASSERT_TRUE(std::filesystem::exists(kept));
  EXPECT_FALSE(std::filesystem::is_empty(kept));
}

/// Process ids of workers that a process has started.
std::vector<pid_t> workers_of(pid_t parent) {
  std::vector<pid_t> workers;
  for (const auto& task : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", parent))) {
    std::ifstream children(task.path() / "children");
    for (pid_t child = 0; children >> child;) {
      std::ifstream line(fmt::format("/proc/{}/cmdline", child));
      const std::string arguments(std::istreambuf_iterator<char>(line), {});
      if (arguments.find(std::string("\0worker\0", 8)) != std::string::npos) workers.push_back(child);
    }
  }
  return workers;
}

/// Polls until a process has written `text` to its log, or a minute has passed.
bool wait_for_log(pid_t process, const std::string& text) {
  for (int i = 0; i < 6000; ++i) {
    std::ifstream log(fmt::format("/proc/{}/fd/2", process));
    if (std::string(std::istreambuf_iterator<char>(log), {}).find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST_F(View, AKilledWorkerOfItsFarmCostsARetryAndNoBit) {
  const auto bake = [&](const std::string& name) {
    return script("settle\ngen\nsettle\nsave " + path(name) + "\nquit\n");
  };
  const std::vector<std::string> small = {"view",    "builtin:two-rooms", "--size", "64x64",  "--probes",
                                          "auto:6",  "--records",         "0",      "--json", "--no-panels",
                                          "--script"};
  test::ToolProcess viewer(
      joined(small, {bake("farm.sphl"), "--local", "2", "--cache", "none", "--progress", "plain"}));
  ASSERT_TRUE(viewer.wait_for_stderr("2 workers")) << viewer.stderr_so_far();
  const std::vector<pid_t> workers = workers_of(viewer.pid());
  ASSERT_EQ(workers.size(), 2u);
  ASSERT_TRUE(wait_for_log(workers[0], "kind=gen"));
  ::kill(workers[0], SIGSTOP);  // the broker gives it another job
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  ::kill(workers[0], SIGKILL);
  const test::ToolResult result = viewer.wait();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json::Value run = test::parse_json(result.out);
  EXPECT_THAT(result.err, HasSubstr("has ended (signal 9, Killed); it is started again"));
  EXPECT_GE(run["farm"]["retries"].integer(), 1) << result.err;
  run_json(joined(small, {bake("here.sphl")}));
  EXPECT_TRUE(read_file(path("farm.sphl")) == read_file(path("here.sphl")));
}

TEST_F(View, ShowsItsPictureInTev) {
  test::TevListener listener;
  run_json(joined(two_rooms, {"--probes", "off", "--tev", listener.address(), "--script",
                              script("settle\nkey Shift+F12\nsettle\nset truth-spp 2\nset show wipe\n"
                                     "settle\nquit\n")}));
  const test::TevImages& shown = listener.shown();
  ASSERT_EQ(shown.images.count("two-rooms"), 1u);
  ASSERT_EQ(shown.images.count("two-rooms path"), 1u);
  EXPECT_EQ(shown.images.at("two-rooms").width, 160);
  EXPECT_EQ(shown.images.at("two-rooms path").height, 100);
}

TEST_F(View, BuildsAccelerationStructuresOnce) {
  const json::Value run =
      run_json({"view", "builtin:two-rooms", "--size", "64x64", "--no-panels", "--records", "0", "--show",
                "truth", "--truth-spp", "1", "--screenshot", path("truth.png")});
  EXPECT_EQ(run["geometry_builds"], 1) << "for light that follows, what is picked and traced truth";
}

TEST_F(View, SaysWhatIsWrongWithItsInput) {
  expect_failure({"view", "builtin:nothing"}, "nothing");
  expect_failure({"view", "builtin:cornell", "--camera", "behind"}, "behind");
  expect_failure({"view", "builtin:cornell", "--exposure", "bright"}, "not a number", 2);
  expect_failure({"view", "builtin:cornell", "--size", "wide"}, "WIDTHxHEIGHT");
  expect_failure({"view", "builtin:cornell", "--export", path("f")}, "--path");
  expect_failure({"view", "builtin:cornell", "--broker", "tcp://farm.example:5555"}, "--keys");
  expect_failure({"view", "builtin:cornell", "--broker", "nonsense"}, "nonsense");
  expect_failure(joined(two_rooms, {"--script", script("time 1\nfly away\n")}),
                 {"line 2", "no command \"fly\""});
  expect_failure(joined(two_rooms, {"--script", script("light lamb off\n")}), {"line 1", "there are: lamp"});
}

TEST(ViewWithoutADisplay, SaysSo) {
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  expect_failure({"view", "builtin:cornell"}, {"no display", "xvfb-run"});
}

}  // namespace
}  // namespace ssphh
