// What a method made in this process took, as text and as JSON.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/pipeline/live_method.h>
#include <ssphh/scene/builtin.h>

namespace ssphh::pipeline {
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

}  // namespace
}  // namespace ssphh::pipeline
