/// `ssphh sphl sample`: the light of a thing as a file that lights other scenes.

#include "commands/sphl.h"

#include <gtest/gtest.h>

#include <ssphh/core/file.h>

#include "commands/render.h"
#include "error_message.h"
#include "temp_dir.h"

namespace ssphh::app {
namespace {

using test::message_of;

SphlSampleOptions of_the_lamp(const test::TempDir& dir) {
  SphlSampleOptions options;
  options.scene.source = "builtin:cornell";
  options.node = "lamp";
  options.output = (dir / "lamp.sphl").string();
  options.params.degree = 4;
  options.params.image_size = 8;
  return options;
}

TEST(SphlSample, WritesAFileThatAnOverlayShinesWith) {
  const test::TempDir dir;
  const SphlSampleOptions options = of_the_lamp(dir);
  const SphlSampleResult result = run_sphl_sample(options);
  EXPECT_EQ(result.file.emission.frames[0].degree(), 4);
  EXPECT_EQ(scene_io::read_emission_file(options.output).emission, result.file.emission);
  EXPECT_GT(result.flux, 1);
  EXPECT_LT(result.least, 0.1f);
  EXPECT_GT(result.file.radius, 0.1f);
  EXPECT_EQ(to_json(result, options)["degree"].number(), 4);
  EXPECT_NE(to_text(result, options).find("\"emission\": {\"file\": \"lamp.sphl\"}"), std::string::npos);

  write_file(dir / "room.ssphh.json",
             std::string_view(R"({"scene": "builtin:furnace", "environment": {"color": [0, 0, 0]},
                "sphls": [{"position": [0, 3, 0], "emission": {"file": "lamp.sphl"}}]})"));
  SceneOptions scene;
  scene.source = (dir / "room.ssphh.json").string();
  const scene::Scene lit = load_scene(scene);
  ASSERT_EQ(lit.lights.size(), 1u);
  EXPECT_EQ(lit.lights[0].emission, result.file.emission);
}

TEST(SphlSample, IsTheSameEveryTimeAndHasAFrameForEachMoment) {
  const test::TempDir dir;
  SphlSampleOptions options = of_the_lamp(dir);
  const SphlSampleResult one = run_sphl_sample(options);
  options.frames = 3, options.rate = 2, options.repeat = true, options.scene.time = 0.5f;
  const SphlSampleResult three = run_sphl_sample(options);
  ASSERT_EQ(three.file.emission.frames.size(), 3u);
  for (const sh::IntensitySh& frame : three.file.emission.frames)
    EXPECT_EQ(frame, one.file.emission.frames[0]) << "it does not move";
  EXPECT_EQ(three.file.emission.rate, 2);
  EXPECT_EQ(three.file.emission.start, 0.5f);
  EXPECT_TRUE(three.file.emission.repeat);
}

TEST(SphlSample, SaysWhatThereIsForAnUnknownNode) {
  const test::TempDir dir;
  SphlSampleOptions options = of_the_lamp(dir);
  options.node = "torch";
  EXPECT_EQ(
      message_of([&] { run_sphl_sample(options); }),
      "node \"torch\": the scene has none of that name (there are: floor, ceiling, back wall, left wall, "
      "right wall, tall box, short box, lamp)");
  EXPECT_FALSE(std::filesystem::exists(options.output));
}

}  // namespace
}  // namespace ssphh::app
