// `ssphh render --draw`: marks of the method over the finished picture.

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/image/io.h>

#include "commands/render.h"
#include "error_message.h"
#include "temp_dir.h"

namespace ssphh::app {
namespace {

using testing::HasSubstr;

class RenderDraw : public testing::Test {
 protected:
  RenderOptions options(const std::vector<std::string>& draw) const {
    RenderOptions o;
    o.scene.source = "builtin:box";
    o.method = "vpl", o.parameters = {"photons=16", "check_points=0"};
    o.width = 48, o.height = 32, o.spp = 1;
    o.output = dir_ / "o.exr";
    o.draw = draw;
    return o;
  }
  const test::TempDir dir_;
};

TEST_F(RenderDraw, LiesOverThePictureAndLeavesItsMean) {
  const RenderResult plain = run_render(options({})), drawn = run_render(options({"photons"}));
  EXPECT_EQ(plain.marks, 0u);
  EXPECT_GE(drawn.marks, 16u);
  EXPECT_EQ(drawn.mean, plain.mean);
  int changed = 0;
  for (std::size_t i = 0; i < plain.picture.pixels.size(); ++i)
    changed += plain.picture.pixels[i] != drawn.picture.pixels[i];
  EXPECT_GT(changed, 20);
  EXPECT_LT(changed, static_cast<int>(plain.picture.pixels.size()) / 2);
  EXPECT_EQ(image::read_image(dir_ / "o.exr").width, 48);
}

TEST_F(RenderDraw, ColoursDoNotDependOnTheExposure) {
  RenderOptions o = options({"surfels"});
  o.method = "irradiance-volume", o.parameters = {"probes=8", "directions=64"};
  o.output = dir_ / "a.png";
  o.exposure = 0.0f;
  const image::Image a = run_render(o).picture;
  o.exposure = 3.0f;
  const image::Image b = run_render(o).picture;
  // Where marks cover a pixel wholly, its radiance is what each exposure shows alike.
  int same = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      same += glm::length(a.rgb(x, y)) > 0.1f && glm::length(a.rgb(x, y) - 8.0f * b.rgb(x, y)) < 1e-4f;
  EXPECT_GT(same, 50);
}

TEST_F(RenderDraw, SaysHowManyMarksThereAre) {
  const RenderOptions o = options({"photons"});
  const RenderResult result = run_render(o);
  EXPECT_EQ(to_json(result, o)["marks"].number(), static_cast<double>(result.marks));
  EXPECT_THAT(to_text(result, o), HasSubstr("marks drawn"));
  EXPECT_FALSE(to_json(result, options({})).contains("marks"));
}

TEST_F(RenderDraw, RefusesWhatIsNotThere) {
  EXPECT_THAT(test::message_of([&] { run_render(options({"photon"})); }),
              HasSubstr("--draw photon: is nothing that can be drawn (did you mean \"photons\"?)"));
  EXPECT_THAT(test::message_of([&] {
                run_render(options({"photons", "surfels"}));
              }),
              HasSubstr("--draw surfels: method vpl has none (take --method "));
}

}  // namespace
}  // namespace ssphh::app
