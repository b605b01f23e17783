// What a method made in this process took, as text and as JSON.

#include "commands/live_method.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>

#include "commands/measure.h"
#include "error_message.h"
#include "here.h"

namespace ssphh::app {
namespace {

using testing::HasSubstr;

TEST(LiveMethod, TextAndJsonTellTheSame) {
  const scene::Scene scene = scene::make_builtin("cornell");
  LiveMethod live("ambient", {"factor=0.5"}, std::make_shared<const trace::SceneGeometry>(scene), scene, {});
  live.update(rays::lighting_at(live.source(), 0), {});
  const json::Value object = live.json();
  EXPECT_EQ(object["update_seconds"].number(), live.update_seconds());
  EXPECT_EQ(object["bake_seconds"].number(), live.bake_seconds());
  EXPECT_GT(live.update_seconds(), 0);
  EXPECT_THAT(live.text(),
              HasSubstr(fmt::format("bake {:.2f} s, update {:.3g} ms, {} B to look up, ", live.bake_seconds(),
                                    1e3 * live.update_seconds(), live.method().memory().lookup)));
}

TEST(LiveMethod, MeasureRefusesAMethodOrParameterBeforeItReadsTheScene) {
  const auto said = [](const char* method) {
    MeasureOptions options;
    options.scene.source = "there is no such scene.glb";
    options.methods = {"direct", method};
    return test::message_of([&] { run_measure(options, {}); });
  };
  EXPECT_THAT(said("nobody"), HasSubstr("method nobody: there is no such method"));
  EXPECT_THAT(said("ambient,points=0"), HasSubstr("points"));
  EXPECT_THAT(said("ambient,points=64"), HasSubstr("there is no such scene.glb"));
}

TEST(LiveMethod, MeasureReadsEveryParameterOfItsName) {
  EXPECT_EQ(test::problem_here({"measure", "builtin:cornell", "--method", "ambient,factor=1,", "--points",
                                "4", "--truth-spp", "2"}),
            "parameter \"\": has no value (write NAME=VALUE)");
}

}  // namespace
}  // namespace ssphh::app
