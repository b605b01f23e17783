// Methods that `measure` is asked for.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>

#include "commands/measure.h"
#include "error_message.h"
#include "here.h"

namespace ssphh::app {
namespace {

using testing::HasSubstr;

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
