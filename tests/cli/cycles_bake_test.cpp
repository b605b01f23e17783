/// `bake --renderer cycles`: which pictures Blender is asked for and what becomes of them, by a script in its
/// place; and that its light is ours, where it is installed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/json.h>
#include <ssphh/image/io.h>
#include <ssphh/sh/reconstruct.h>

#include "commands/bake.h"
#include "commands/bake_watch.h"
#include "commands/child_process.h"
#include "commands/worker.h"
#include "error_message.h"
#include "json_text.h"
#include "stand_in_programs.h"
#include "temp_dir.h"
#include "tool.h"

namespace ssphh::app {
namespace {

using test::message_of;
using test::Path;
using test::TempDir;

constexpr int face = 16;

/// A Blender that "renders" by copying emittedK.exr and reflectedK.exr beside it, and keeps what it was given
/// to render.
void install_blender(const std::filesystem::path& folder) {
  test::write_script(folder / "blender", R"(here=$(dirname "$0")
echo "$@" >> "$here/calls"
script=$4
while [ $# -gt 1 ]; do
  case $1 in
    --output) output=$2 ;;
    --cube) cp "$2" "$here/cube.json" ;;
  esac
  shift
done
cp "$(dirname "$script")/scene.json" "$here/scene.json"
mkdir -p "$output"
for k in 0 1 2 3 4 5; do
  cp "$here/emitted$k.exr" "$output/emitted000$k.exr"
  cp "$here/reflected$k.exr" "$output/reflected000$k.exr"
done
)");
}

/// Light that tells where it comes from.
vec3 sloped(const vec3& d) {
  return vec3(2) + vec3(0.5f * d.x, 0.7f * d.y, -0.9f * d.z) + vec3(0.3f * d.y, 0.2f * d.z, 0.4f * d.x);
}

/// What a camera of 90 degrees with that matrix to the world sees of it.
image::Image picture_of(const json::Value& matrix) {
  const auto entry = [&](int row, int column) { return static_cast<float>(matrix[row][column].number()); };
  image::Image picture(face, face);
  for (int y = 0; y < face; ++y) {
    for (int x = 0; x < face; ++x) {
      const vec3 ray((static_cast<float>(x) + 0.5f) * 2 / face - 1,
                     1 - (static_cast<float>(y) + 0.5f) * 2 / face, -1);
      vec3 direction(0);
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) direction[r] += entry(r, c) * ray[c];
      picture.set_rgb(x, y, sloped(glm::normalize(direction)));
    }
  }
  return picture;
}

BakeOptions of_a_box(const TempDir& dir) {
  write_file(dir / "box.ssphh.json", std::string_view(R"({"scene": "builtin:box",
      "without": {"sphls": ["center", "east", "west", "above", "corner"]},
      "lights": [{"type": "point", "position": [0.2, 0, 0], "intensity": 7, "light_group": "lamp"}],
      "sphls": [{"name": "a", "position": [0.1, 0.2, 0.3]}]})"));
  BakeOptions options;
  options.scene.source = (dir / "box.ssphh.json").string();
  options.output = (dir / "box.sphl").string();
  options.renderer = Renderer::cycles;
  options.viz = probes::VizMethod::none;
  options.params.face_size = face;
  options.params.path = {.max_depth = 3, .passes = 2, .spp = 24};
  return options;
}

TEST(CyclesBake, FacesBecomeTheLightOfEachGroupTheRightWayRound) {
  const TempDir dir;
  install_blender(dir / "bin");
  const Path path((dir / "bin").string() + ":/usr/bin:/bin");
  const BakeOptions options = of_a_box(dir);
  const image::Image black(face, face);
  for (const char* part : {"emitted", "reflected"})
    for (int k = 0; k < 6; ++k) image::write_image(dir / fmt::format("bin/{}{}.exr", part, k), black);
  const BakeResult dark = run_bake(options);
  // The pictures that these cameras would take
  const json::Value cameras = test::parse_json(read_text_file(dir / "bin/cube.json"));
  ASSERT_EQ(cameras.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t r = 0; r < 3; ++r)
      EXPECT_FLOAT_EQ(static_cast<float>(cameras[k][r][3].number()), r == 0 ? 0.1f : r == 1 ? 0.2f : 0.3f);
    image::write_image(dir / fmt::format("bin/reflected{}.exr", k), picture_of(cameras[k]));
  }
  const BakeResult lit = run_bake(options);
  ASSERT_EQ(lit.set.light_groups.size(), dark.set.light_groups.size());
  ASSERT_EQ(lit.set.light_groups.size(), 2u);
  for (const probes::GroupLight& group : lit.set.probes[0].groups) {
    EXPECT_TRUE(group.emitted.values.empty());
    for (const vec3& d : {vec3(1, 0, 0), vec3(0, -1, 0), glm::normalize(vec3(1, 2, -3))}) {
      const vec3 seen = sh::eval(group.reflected, d), truth = sloped(d);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], truth[c], 0.01f);
    }
  }
  EXPECT_FALSE(lit.set.surface) << "records would hold our light";
  EXPECT_FALSE(lit.set.baseline) << "an update would go on with our light";
  const std::string calls = read_text_file(dir / "bin/calls");
  EXPECT_THAT(calls, testing::HasSubstr("--cube"));
  EXPECT_EQ(std::ranges::count(calls, '\n'), 4) << "a run for each group, twice";
}

TEST(CyclesBake, IsNotForWatchAndNeedsBlender) {
  const TempDir dir;
  BakeOptions options = of_a_box(dir);
  EXPECT_THAT(message_of([&] { run_bake_watch(options); }), testing::HasSubstr("is not for --watch"));
  const Path path(dir.path().string());
  EXPECT_THAT(message_of([&] { run_bake(options); }), testing::HasSubstr("no `blender`"));
  WorkerSettings worker;
  worker.broker.endpoint = "ipc://" + (dir / "broker").string();
  worker.pool.other.renderer = Renderer::cycles;
  EXPECT_THAT(message_of([&] { run_worker(worker); }), testing::HasSubstr("no `blender`"));
}

/// Pictures of Blender's that a script hands out.
void install_sloped_blender(const TempDir& dir) {
  install_blender(dir / "bin");
  for (int k = 0; k < 6; ++k) {
    const image::Image grey(face, face);
    image::write_image(dir / fmt::format("bin/emitted{}.exr", k), grey);
    image::Image slope(face, face);
    for (int y = 0; y < face; ++y)
      for (int x = 0; x < face; ++x)
        slope.set_rgb(x, y, vec3(static_cast<float>(x + 7 * k), static_cast<float>(y), 3));
    image::write_image(dir / fmt::format("bin/reflected{}.exr", k), slope);
  }
}

TEST(CyclesBake, AFarmsWorkersThatHaveItGiveTheBitsOfALocalOne) {
  const TempDir dir;
  install_sloped_blender(dir);
  const Path path((dir / "bin").string() + ":/usr/bin:/bin");
  BakeOptions options = of_a_box(dir);
  const probes::ProbeSet here = run_bake(options).set;
  options.farm.local = 1, options.farm.cache = "none", options.farm.tool = test::tool_path();
  const BakeResult there = run_bake(options);
  EXPECT_EQ(there.set, here);
  EXPECT_EQ(there.farm->units, 1u);
  EXPECT_EQ(there.farm->cached, 0u);
}

TEST(CyclesBake, AFarmWithoutSuchAWorkerSaysSo) {
  const TempDir dir;
  install_sloped_blender(dir);
  const Path path((dir / "bin").string() + ":/usr/bin:/bin");
  const std::string endpoint = "ipc://" + (dir / "broker").string();
  test::ToolProcess broker({"broker", "--bind", endpoint}),
      ours({"worker", "--broker", endpoint, "--cache", (dir / "cache").string()});
  EXPECT_TRUE(ours.wait_for_stderr("worker-ready"));
  of_a_box(dir);
  test::ToolProcess bake({"bake", (dir / "box.ssphh.json").string(), "--renderer", "cycles", "--viz", "off",
                          "--face", "16", "--spp", "4", "--broker", endpoint, "--cache", "none", "-o",
                          (dir / "box.sphl").string()});
  EXPECT_TRUE(bake.wait_for_stderr("that was started with --renderer cycles"));
  test::ToolProcess theirs(
      {"worker", "--broker", endpoint, "--renderer", "cycles", "--cache", (dir / "cache2").string()});
  const test::ToolResult done = bake.wait();
  EXPECT_EQ(done.exit_code, 0) << done.err;
  for (test::ToolProcess* process : {&theirs, &ours, &broker}) {
    process->signal(SIGKILL);
    process->wait();
  }
}

/// Σ |a − b|² over all probes' reflected light.
double distance(const probes::ProbeSet& a, const probes::ProbeSet& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.probes.size(); ++i) {
    const auto &x = a.probes[i].groups[0].reflected.values, &y = b.probes[i].groups[0].reflected.values;
    for (std::size_t k = 0; k < x.size(); ++k) sum += static_cast<double>(glm::dot(x[k] - y[k], x[k] - y[k]));
  }
  return sum;
}

// What seeds of one renderer differ by is its noise: renderers may differ by no more.
TEST(CyclesBake, GenIsOursWithinNoise) {
  if (find_program("blender").empty()) GTEST_SKIP() << "no blender: scripts/install-deps --with-blender";
  const TempDir dir;
  const auto baked = [&](Renderer renderer, std::uint64_t seed) {
    BakeOptions options;
    options.scene.source = "builtin:cornell";
    options.output = (dir / "cornell.sphl").string();
    options.renderer = renderer, options.seed = seed;
    options.viz = probes::VizMethod::none, options.records = 0;
    options.params.face_size = face;
    options.params.path = {.max_depth = 3, .passes = 1, .spp = 128};
    return run_bake(options).set;
  };
  const probes::ProbeSet ours = baked(Renderer::path, 1), cycles = baked(Renderer::cycles, 1);
  const double noise =
      0.5 * (distance(ours, baked(Renderer::path, 2)) + distance(cycles, baked(Renderer::cycles, 2)));
  EXPECT_GT(noise, 0);
  EXPECT_LT(distance(ours, cycles), 1.5 * noise);
  RecordProperty("noise", std::to_string(distance(ours, cycles) / noise));
  for (std::size_t i = 0; i < ours.probes.size(); ++i) {
    const vec3 a = ours.probes[i].groups[0].reflected[0], b = cycles.probes[i].groups[0].reflected[0];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(b[c] / a[c], 1, 0.01) << i;
    const vec3 lamp = ours.probes[i].groups[0].emitted[0], theirs = cycles.probes[i].groups[0].emitted[0];
    EXPECT_NEAR(theirs.y / lamp.y, 1, 0.02) << "texels are sampled by area there, by solid angle here";
  }
}

// A ball seen directly fills 2π(1 − √(1 − (r/d)²)); what it lights comes on top, in both alike.
TEST(CyclesBake, VizIsOursWithinNoise) {
  if (find_program("blender").empty()) GTEST_SKIP() << "no blender: scripts/install-deps --with-blender";
  const TempDir dir;
  const auto baked = [&](Renderer renderer) {
    write_file(
        dir / "pair.ssphh.json",
        std::string_view(
            R"({"scene": "builtin:cornell", "without": {"sphls": ["center", "red", "green", "back", "front"]},
        "sphls": [{"name": "a", "position": [-0.4, 1.4, 0.2], "radius": 0.2}, {"name": "b", "position": [0.3, 1.5, 0.4], "radius": 0.2}]})"));
    BakeOptions options;
    options.scene.source = (dir / "pair.ssphh.json").string();
    options.output = (dir / "pair.sphl").string();
    options.renderer = renderer;
    options.viz = probes::VizMethod::path, options.records = 0;
    options.params.face_size = face;
    options.params.path = {.max_depth = 3, .passes = 1, .spp = 256};
    return run_bake(options).set;
  };
  const probes::ProbeSet ours = baked(Renderer::path), cycles = baked(Renderer::cycles);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(cycles.probes[i].edges.size(), 1u);
    EXPECT_NEAR(cycles.probes[i].edges[0].transfer / ours.probes[i].edges[0].transfer, 1, 0.03) << i;
  }
}

}  // namespace
}  // namespace ssphh::app
