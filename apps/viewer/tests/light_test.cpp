#include <cmath>
#include <thread>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <ssphh/scene/builtin.h>

#include "model/document.h"
#include "model/frame_times.h"
#include "model/pick.h"
#include "model/reference.h"

namespace ssphh::viewer {
namespace {

using namespace std::chrono_literals;

template <class Condition>
bool wait_for(const Condition& condition) {
  for (int i = 0; i < 4000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

TEST(BackgroundJob, HandsOverOnTheCallersThreadInOrder) {
  BackgroundJob job;
  std::vector<int> got;
  const auto window = std::this_thread::get_id();
  const auto step = [&](int i) {
    return [&, i] {
      EXPECT_EQ(std::this_thread::get_id(), window);
      got.push_back(i);
    };
  };
  job.start("count", [&](const Control& control) -> BackgroundJob::Finish {
    ProgressStage stage(control, "counting", 3, "numbers");
    for (int i = 0; i < 3; ++i) job.hand_over(step(i)), stage.advance(1);
    return step(3);
  });
  EXPECT_TRUE(wait_for([&] { return !job.running(); }));
  EXPECT_TRUE(got.empty()) << "nothing happens behind the window's back";
  EXPECT_FALSE(job.idle()) << "a result waits";
  EXPECT_TRUE(job.poll());
  EXPECT_THAT(got, testing::ElementsAre(0, 1, 2, 3));
  EXPECT_FALSE(job.poll());
  EXPECT_TRUE(job.idle());
  EXPECT_EQ(job.status().stage, "counting");
  EXPECT_EQ(job.status().fraction, 1);
}

TEST(BackgroundJob, CancelStopsItAndDropsTheResult) {
  BackgroundJob job;
  bool handed = false;
  job.start("forever", [&](const Control& control) -> BackgroundJob::Finish {
    job.hand_over([&] { handed = true; });
    for (;;) control.check(), std::this_thread::sleep_for(1ms);
  });
  job.cancel();
  EXPECT_TRUE(wait_for([&] { return !job.running(); }));
  EXPECT_FALSE(job.poll());
  EXPECT_FALSE(handed);
  EXPECT_EQ(job.status().error, "");
}

TEST(BackgroundJob, TellsWhyItFailedAndStartsAnew) {
  BackgroundJob job;
  job.start("bad", [](const Control&) -> BackgroundJob::Finish { throw Error("probes", "there are none"); });
  EXPECT_TRUE(wait_for([&] { return !job.running(); }));
  EXPECT_EQ(job.status().error, "probes: there are none");
  bool done = false;
  job.start("good", [&](const Control&) -> BackgroundJob::Finish { return [&] { done = true; }; });
  EXPECT_TRUE(wait_for([&] { return job.poll(); }));
  EXPECT_TRUE(done);
  EXPECT_EQ(job.status().error, "");
}

TEST(BackgroundJob, AnewWhileOneRunsDropsTheOld) {
  BackgroundJob job;
  std::vector<int> got;
  for (int i = 0; i < 20; ++i) {
    job.start("racing", [&, i](const Control&) -> BackgroundJob::Finish {
      job.hand_over([&, i] { got.push_back(i); });
      return [] {};
    });
  }
  EXPECT_TRUE(wait_for([&] { return !job.running(); }));
  job.poll();
  EXPECT_THAT(got, testing::ElementsAre(19));
}

TEST(Reference, AddsPassesUntilItsLimit) {
  const Document document = make_document("cornell", scene::make_builtin("cornell"), 0);
  Reference reference;
  ReferenceParams params;
  params.scene = document.scene;
  params.camera = pose_of(start_view(document, ""));
  params.width = 24, params.height = 16, params.passes = 4;
  reference.start(params);
  EXPECT_TRUE(wait_for([&] { return reference.poll(), reference.image().passes == 4; }));
  const image::Image& picture = *reference.image().color;
  EXPECT_EQ(picture.width, 24);
  EXPECT_EQ(picture.height, 16);
  float sum = 0;
  for (const float v : picture.pixels) sum += v;
  EXPECT_GT(sum, 0);
  reference.clear();
  EXPECT_FALSE(reference.image().color);
}

TEST(Reference, TakesIndirectLightFromAnotherMethod) {
  const Document document = make_document("cornell", scene::make_builtin("cornell"), 0);
  const auto indirect = [&](const char* method) {
    Reference reference;
    ReferenceParams params;
    params.scene = document.scene;
    params.camera = pose_of(start_view(document, ""));
    params.width = 24, params.height = 16, params.passes = 4;
    params.method = method;
    reference.start(params);
    EXPECT_TRUE(wait_for([&] { return reference.poll(), reference.image().passes == 4; })) << method;
    float sum = 0;
    for (const float v : reference.image().indirect->pixels) sum += v;
    return sum;
  };
  EXPECT_EQ(indirect("direct"), 0);
  EXPECT_GT(indirect("ambient"), 0);
}

TEST(LiveLight, AnOpenedDoorLightsRoomB) {
  const Document document = make_document("rooms", scene::make_builtin("two-rooms"), 0);
  LiveLightParams params;
  for (const scene::SphlPlace& place : scene::sphl_places(*document.scene, 0))
    params.places.push_back({place.name, place.position, place.radius});
  LiveLight light(document.scene, params, 0);
  const auto update = [&](float time) {
    light.update(light_states(*document.scene, document.edits(), time),
                 group_scales(*document.scene, document.edits()), time);
  };
  update(0);
  gi::ProbeSet set = light.probes();
  ASSERT_EQ(set.probes.size(), 6u);
  const auto mean = [&](std::size_t probe) { return set.probes[probe].self.values[0].x; };
  const float west_shut = mean(3), lamp_room = mean(0);
  EXPECT_GT(lamp_room, 0);
  EXPECT_LT(west_shut, 1e-3f * lamp_room);
  update(1);
  light.refresh(set);
  EXPECT_GT(mean(3), 0.02f * mean(0));
  EXPECT_EQ(set, light.probes()) << "refreshing equals making anew";
}

TEST(Pick, TakesTheNearestSphereInFront) {
  const std::vector<vec3> centers{{0, 0, -9}, {0, 0.05f, -4}, {0, 0, 3}, {2, 0, -4}};
  const scene::RayQuery ray{{0, 0, 0}, {0, 0, -1}, 100};
  EXPECT_EQ(pick_sphere(ray, centers, 0.1f, 100), 1);
  EXPECT_EQ(pick_sphere(ray, centers, 0.1f, 3), -1) << "a surface is nearer";
  EXPECT_EQ(pick_sphere(ray, centers, 0.01f, 100), 0);
}

TEST(Pick, FindsTheDoorWhereItStandsAtThatTime) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  const scene::RayQuery ray{{-2, 1, 0}, {1, 0, 0}, 100};
  const auto shut = pick_surface(source, 0, ray);
  ASSERT_TRUE(shut);
  EXPECT_NEAR(shut->position.x, 0.075f, 0.01f);
  EXPECT_NEAR(shut->normal.x, -1, 1e-4f);
  const auto open = pick_surface(source, 1, ray);
  ASSERT_TRUE(open);
  EXPECT_NEAR(open->position.x, 4.075f, 1e-3f) << "through the doorway to the far wall";
}

TEST(Pick, DragsAlongAnAxisAndOnAPlane) {
  const scene::RayQuery ray{{2, 3, 10}, {0, 0, -1}, 100};
  EXPECT_FLOAT_EQ(*along_axis(ray, {0, 3, 0}, {1, 0, 0}), 2);
  EXPECT_FALSE(along_axis(ray, {0, 0, 0}, {0, 0, 1}));
  EXPECT_EQ(*on_plane(ray, {0, 0, 1}, {0, 0, 1}), vec3(2, 3, 1));
  EXPECT_FALSE(on_plane(ray, {0, 0, 11}, {0, 0, 1}));
}

TEST(FrameTimes, QuantilesAreOfTheLastFramesOnly) {
  History1d times;
  EXPECT_EQ(times.quantile(0.5), 0);
  for (int i = 1; i <= 5; ++i) times.add(static_cast<float>(i));
  EXPECT_EQ(times.median(), 3);
  EXPECT_EQ(times.quantile(0.99), 5);
  EXPECT_EQ(times.at(0), 1);
  for (int i = 1; i <= History1d::length; ++i) times.add(100 + static_cast<float>(i));
  EXPECT_EQ(times.count(), History1d::length);
  EXPECT_EQ(times.at(0), 101);
  EXPECT_EQ(times.median(), 100 + History1d::length / 2);
}

TEST(FrameTimes, AreWrittenAsJsonAndCsv) {
  FrameTimes times;
  times.add("frame", 2), times.add("frame", 4), times.add("shadow", 1);
  const auto json = nlohmann::json::parse(times.to_json({{"renderer", "x"}}));
  EXPECT_EQ(json["renderer"], "x");
  EXPECT_EQ(json["stages"][0]["median_ms"], 2);
  EXPECT_EQ(json["stages"][1]["frames"], 1);
  EXPECT_EQ(times.to_csv(), "frame,frame [ms],shadow [ms]\n0,2.0000,\n1,4.0000,1.0000\n");
}

}  // namespace
}  // namespace ssphh::viewer
