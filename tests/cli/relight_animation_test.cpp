// What `--animate` and `--event` say: which values a frame has.

#include "commands/relight_animation.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/turn_surroundings.h>
#include <ssphh/trace/transport_scene.h>

#include "error_message.h"
#include "stage.h"

namespace ssphh::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A stage with lamps of every kind, two of one name, in two groups, under a sky.
scene::Scene lit_stage() {
  scene::Scene scene = test::stage(test::matte(vec3(0.5f)));
  const auto add = [&](const char* name, scene::LightType type, const char* group) {
    scene::Light light;
    light.name = name, light.type = type, light.group = group;
    if (type == scene::LightType::sphere) light.radius = 0.1f;
    if (type == scene::LightType::rectangle) light.size = {0.4f, 0.2f};
    test::add_stage_lamp(scene, light);
  };
  add("bulb", scene::LightType::point, "warm");
  add("spot", scene::LightType::spot, "cold");
  add("sun", scene::LightType::directional, "cold");
  add("globe", scene::LightType::sphere, "cold");
  add("twin", scene::LightType::point, "cold");
  add("twin", scene::LightType::point, "cold");
  add("panel", scene::LightType::rectangle, "cold");
  scene.environment.emplace().equirect = image::Image(8, 4);
  scene.environment->equirect.set_rgb(2, 1, vec3(9));
  return scene;
}

class Animation : public testing::Test {
 protected:
  RelightAnimation read(const std::vector<std::string>& specs, float time = 0) const {
    return {source_, scene_, time, specs};
  }
  scene::LightingState frame(const std::string& spec, float u) const { return read({spec}).frame(u); }
  std::string problem(const std::vector<std::string>& specs) const {
    return test::message_of([&] { read(specs); });
  }

  const scene::Scene scene_ = lit_stage();
  const trace::TransportScene source_{scene_};
  const scene::LightingState still_ = rays::lighting_at(source_, 0);
};

TEST(Track, KeysAreSpreadEvenlyAndMixedBetween) {
  const Track track{TrackProperty::position, 0, {vec3(0), vec3(1, 2, 3), vec3(5, 2, -1)}};
  EXPECT_EQ(track.at(0), vec3(0));
  EXPECT_EQ(track.at(0.25f), vec3(0.5f, 1, 1.5f));
  EXPECT_EQ(track.at(0.5f), vec3(1, 2, 3));
  EXPECT_EQ(track.at(0.875f), vec3(4, 2, 0));
  EXPECT_EQ(track.at(1), vec3(5, 2, -1));
  EXPECT_EQ((Track{TrackProperty::scale, 0, {vec3(7)}}.at(0.7f)), vec3(7)) << "one key stays";
}

TEST_F(Animation, EachTrackSetsItsPropertyOfItsLightAlone) {
  scene::LightingState wanted = still_;
  wanted.lights[0].world[3] = vec4(1, -2, 3, 1);
  EXPECT_EQ(frame("bulb.position=0,0,0:2,-4,6", 0.5f), wanted);
  wanted = still_, wanted.lights[1].intensity = 3;
  EXPECT_EQ(frame("spot.intensity=2:4", 0.5f), wanted);
  wanted = still_, wanted.lights[3].color = {0.5f, 0.25f, 1};
  EXPECT_EQ(frame("globe.color=1,0.5,0:0,0,2", 0.5f), wanted);
  wanted = still_, scene::turn_surroundings(wanted, scene_, pi / 2);
  EXPECT_EQ(frame("environment.rotation=-90:90", 1), wanted) << "degrees";
}

TEST_F(Animation, ASunWithADirectionOfItsOwnDoesNotTurnWithTheSky) {
  const scene::LightingState state = read({"environment.rotation=90", "sun.direction=0,-1,0"}).frame(0.5f);
  EXPECT_FLOAT_EQ(state.environment_rotation, pi / 2);
  EXPECT_LT(glm::distance(vec3(state.lights[2].world[2]), vec3(0, 1, 0)), 1e-6f);
}

TEST_F(Animation, AGroupTakesOneFactorOrOneForEachChannel) {
  const auto& groups = source_.light_groups();
  const auto warm = static_cast<std::size_t>(std::ranges::find(groups, "warm") - groups.begin());
  scene::LightingState wanted = still_;
  wanted.group_scales.at(warm) = vec3(2);
  EXPECT_EQ(frame("warm.scale=1:3", 0.5f), wanted);
  wanted.group_scales.at(warm) = {1, 2, 3};
  EXPECT_EQ(frame("warm.scale=1,2,3", 0.3f), wanted);
}

TEST_F(Animation, ADirectionTurnsALampWhereItStands) {
  for (const char* lamp : {"spot", "sun"}) {
    const std::size_t i = lamp == std::string("spot") ? 1 : 2;
    const scene::LightingState state = frame(std::string(lamp) + ".direction=0,-3,4", 0);
    const mat4& world = state.lights[i].world;
    EXPECT_LT(glm::distance(-vec3(world[2]), vec3(0, -0.6f, 0.8f)), 1e-6f) << lamp;
    EXPECT_EQ(world[3], still_.lights[i].world[3]) << lamp;
    EXPECT_NEAR(glm::determinant(mat3(world)), 1, 1e-6f) << lamp;
    EXPECT_LT(glm::distance(glm::cross(vec3(world[0]), vec3(world[1])), vec3(world[2])), 1e-6f) << lamp;
  }
}

TEST_F(Animation, ARectangleIsAimedTheShortestWay) {
  const mat4& before = still_.lights.back().world;
  const vec3 aim = -vec3(before[2]) + 0.1f * vec3(before[1]);  // about its x axis
  const mat4 after =
      frame(fmt::format("panel.direction={},{},{}", aim.x, aim.y, aim.z), 0).lights.back().world;
  EXPECT_LT(glm::distance(-vec3(after[2]), glm::normalize(aim)), 1e-5f);
  EXPECT_LT(glm::distance(vec3(after[0]), vec3(before[0])), 1e-5f);
  EXPECT_EQ(after[3], before[3]);
}

TEST_F(Animation, SeveralTracksGoTogether) {
  const RelightAnimation both = read({"bulb.intensity=0:8", "bulb.color=1,0,0", "sun.intensity=1"});
  const scene::LightingState state = both.frame(0.25f);
  EXPECT_EQ(state.lights[0].intensity, 2);
  EXPECT_EQ(state.lights[0].color, vec3(1, 0, 0));
  EXPECT_EQ(state.lights[2].intensity, 1);
  EXPECT_FALSE(both.moves_time());
  EXPECT_TRUE(read({"bulb.intensity=1", "time=0:1"}).moves_time());
}

TEST_F(Animation, TheTimeIsThatOfTheOptionUnlessATrackMovesIt) {
  EXPECT_EQ(read({"bulb.intensity=1"}, 2.5f).frame(1).time, 2.5f);
  EXPECT_EQ(read({"time=1:2"}, 2.5f).frame(0.5f).time, 1.5f);
}

TEST_F(Animation, ASceneThatMovesDoesSoUnasked) {
  const scene::Scene rooms = scene::make_builtin("two-rooms");
  const trace::TransportScene source(rooms);
  const RelightAnimation own(source, rooms, 0.25f, {});
  EXPECT_TRUE(own.moves_time());
  EXPECT_EQ(own.frame(0).time, 0);
  EXPECT_EQ(own.frame(1).time, source.duration());
  EXPECT_THAT(problem({}), AllOf(HasSubstr("nothing moves"), HasSubstr("\"bulb.intensity=0:4\"")));
}

TEST_F(Animation, ChangesWhatMovesAndNothingElse) {
  const RelightAnimation animation =
      read({"bulb.intensity=0:8", "cold.scale=0.5", "environment.rotation=90"});
  scene::LightingState by_hand = still_;
  by_hand.lights[0].intensity = 4;
  const auto& groups = source_.light_groups();
  by_hand.group_scales[std::ranges::find(groups, "cold") - groups.begin()] = vec3(0.5f);
  scene::turn_surroundings(by_hand, scene_, pi / 2);
  EXPECT_EQ(animation.frame(0.5f), by_hand);
}

TEST_F(Animation, MistakesAreToldWithWhatWouldBeRight) {
  EXPECT_THAT(problem({"blub.intensity=1"}),
              HasSubstr("no light \"blub\" (its lights: bulb, spot, sun, globe, twin, twin, panel)"));
  EXPECT_THAT(problem({"twin.intensity=1"}), HasSubstr("several lights are named \"twin\""));
  EXPECT_THAT(problem({"hot.scale=1"}), AllOf(HasSubstr("no light group \"hot\""), HasSubstr("warm")));
  EXPECT_THAT(problem({"sun.position=1,2,3"}), HasSubstr("a directional light has no position"));
  for (const char* lamp : {"bulb", "globe"})
    EXPECT_THAT(problem({lamp + std::string(".direction=0,1,0")}), HasSubstr("into all directions alike"));
  EXPECT_THAT(problem({"spot.direction=0,0,0"}), HasSubstr("length 0"));
  for (const char* dark : {"spot.intensity=-1", "spot.color=1,-1,1", "warm.scale=-1"})
    EXPECT_THAT(problem({dark}), HasSubstr("light cannot be negative")) << dark;
  for (const char* right : {"time=-1:1", "environment.rotation=-1", "bulb.position=-1,-1,-1",
                            "spot.direction=-1,-1,-1", "spot.intensity=0"})
    EXPECT_EQ(problem({right}), "no error") << right;
  EXPECT_THAT(problem({"bulb.intensity=1,2,3"}), HasSubstr("\"1,2,3\" is not a number"));
  EXPECT_THAT(problem({"warm.scale=1,2"}), HasSubstr("\"1,2\" is not a number"));
  EXPECT_THAT(problem({"bulb.color=1"}), HasSubstr("\"1\" is not three numbers x,y,z"));
  EXPECT_THAT(problem({"bulb.intensity=1:"}), HasSubstr("\"\" is not a number"));
  EXPECT_THAT(problem({"bulb.intensity=1:2x"}), HasSubstr("\"2x\" is not a number"));
  EXPECT_THAT(problem({"bulb=1"}), HasSubstr("\"bulb\" cannot be animated"));
  EXPECT_THAT(problem({"bulb.intensity=1", "spot.intensity=1", "bulb.intensity=2"}),
              HasSubstr("\"bulb.intensity=2\": is animated twice"));
}

}  // namespace
}  // namespace ssphh::app
