#include "model/reference.h"

#include <atomic>
#include <cmath>
#include <thread>

#include <gmock/gmock.h>

#include <ssphh/methods/method_list.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "model/document.h"

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

TEST(BackgroundJob, TellsWhatItIsAt) {
  BackgroundJob job;
  EXPECT_EQ(job.status().name, "");
  EXPECT_EQ(job.status().seconds, 0);
  EXPECT_EQ(job.status().fraction, -1);
  EXPECT_FALSE(job.running());
  EXPECT_TRUE(job.idle());
  std::atomic<int> at = 0;
  std::atomic<bool> go_on = false, end = false, out = false;
  job.start("baking", [&](const Control& control) -> BackgroundJob::Finish {
    {
      ProgressStage first(control, "first", 0, "things");
      at = 1;
      while (!go_on) std::this_thread::sleep_for(1ms);
    }
    {
      ProgressStage second(control, "second", 8, "things");
      second.advance(1), second.advance(1);
      at = 2;
      while (!end) std::this_thread::sleep_for(1ms);
      second.advance(10);
    }
    at = 3;
    while (!out) std::this_thread::sleep_for(1ms);
    return {};
  });
  EXPECT_TRUE(wait_for([&] { return at == 1; }));
  EXPECT_TRUE(job.running());
  EXPECT_FALSE(job.idle());
  EXPECT_EQ(job.status().name, "baking");
  EXPECT_EQ(job.status().stage, "first");
  EXPECT_EQ(job.status().fraction, -1) << "of how many is not known";
  const double early = job.status().seconds;
  EXPECT_GE(early, 0);
  go_on = true;
  EXPECT_TRUE(wait_for([&] { return at == 2; }));
  EXPECT_EQ(job.status().stage, "second");
  EXPECT_EQ(job.status().fraction, 0.25);
  EXPECT_GT(job.status().seconds, early);
  end = true;
  EXPECT_TRUE(wait_for([&] { return at == 3; }));
  EXPECT_EQ(job.status().fraction, -1) << "nobody knows how far what follows is";
  out = true;
  EXPECT_TRUE(wait_for([&] { return !job.running(); }));
  EXPECT_EQ(job.status().fraction, 1) << "never more";
  const double took = job.status().seconds;
  EXPECT_LT(took, 60);
  EXPECT_EQ(job.status().seconds, took) << "the clock has stopped";
  EXPECT_TRUE(job.idle());
}

TEST(BackgroundJob, AnErrorIsTakenOnce) {
  BackgroundJob job;
  EXPECT_EQ(job.take_error(), "");
  job.start("bad", [](const Control&) -> BackgroundJob::Finish { throw Error("a", "b"); });
  EXPECT_TRUE(wait_for([&] { return !job.running(); }));
  EXPECT_TRUE(job.idle());
  EXPECT_EQ(job.take_error(), "a: b");
  EXPECT_EQ(job.take_error(), "");
}

TEST(BackgroundJob, WhatACancelledJobHandsOverIsDropped) {
  BackgroundJob job;
  std::atomic<bool> cancelled = false;
  bool got = false;
  job.start("late", [&](const Control&) -> BackgroundJob::Finish {
    while (!cancelled) std::this_thread::sleep_for(1ms);
    job.hand_over([&] { got = true; });
    throw Error("late", "too late to tell");
  });
  job.cancel();
  cancelled = true;
  EXPECT_TRUE(wait_for([&] { return !job.running(); }));
  EXPECT_FALSE(job.poll());
  EXPECT_FALSE(got);
  EXPECT_EQ(job.take_error(), "");
}

/// Small pictures of builtin:cornell, with another value of everything than the default.
ReferenceParams small_reference(const Document& document) {
  ReferenceParams params;
  params.scene = document.scene;
  params.time = document.time;
  params.camera = pose_of(start_view(document, ""));
  params.width = 12, params.height = 8, params.passes = 3, params.max_depth = 3;
  return params;
}

ReferenceImage reference_image(const ReferenceParams& params) {
  Reference reference;
  reference.start(params);
  EXPECT_TRUE(wait_for([&] { return reference.poll(), reference.image().passes == params.passes; }));
  EXPECT_TRUE(wait_for([&] { return !reference.status().running; }));
  EXPECT_EQ(reference.status().name, params.method == "path" ? "path tracing" : params.method);
  EXPECT_EQ(reference.status().stage, "samples per pixel");
  EXPECT_EQ(reference.status().fraction, 1);
  return reference.image();
}

TEST(Reference, IsTheTracersPictureBitByBit) {
  const Document document = make_document("rooms", scene::make_builtin("two-rooms"), 0.75f);
  for (const bool orthographic : {false, true}) {
    ReferenceParams params = small_reference(document);
    params.camera.camera.orthographic = orthographic;
    trace::RenderParams render;
    render.width = 12, render.height = 8, render.camera = params.camera;
    if (orthographic) render.projection = trace::Projection::orthographic;
    render.path = {.max_depth = 3, .passes = 3, .spp = 1, .seed = 0};
    trace::RenderState state;
    trace::PathTracer(*document.scene, 0.75f).render(render, state);
    const ReferenceImage image = reference_image(params);
    EXPECT_EQ(image.color->pixels, trace::resolve(state.color, 3).pixels);
    EXPECT_EQ(image.indirect->pixels, trace::resolve(state.indirect, 3).pixels);
  }
}

TEST(Reference, OfAMethodIsThePictureWithItsLight) {
  const Document document = make_document("cornell", scene::make_builtin("cornell"), 0);
  ReferenceParams params = small_reference(document);
  params.method = "ambient";
  const trace::TransportScene source(*document.scene);
  const methods::MethodEntry& entry = methods::find_method("ambient");
  const auto method = entry.make({*document.scene, source}, {entry.name, entry.parameters}, {});
  method->update(rays::lighting_at(source, 0), {});
  trace::RenderParams render;
  render.width = 12, render.height = 8, render.camera = params.camera;
  render.path = {.max_depth = 3, .passes = 3, .spp = 1, .seed = 0};
  trace::RenderState state;
  trace::PathTracer(*document.scene, 0).render_with(method->light(), render, state, {});
  EXPECT_EQ(reference_image(params).color->pixels, trace::resolve(state.color, 3).pixels);
}

TEST(Reference, BuildsNothingWhereItIsGivenAGeometry) {
  const Document document = make_document("rooms", scene::make_builtin("two-rooms"), 0.75f);
  for (const char* method : {"path", "ambient"}) {
    ReferenceParams params = small_reference(document);
    params.method = method;
    const std::uint64_t before = trace::SceneGeometry::builds();
    const ReferenceImage alone = reference_image(params);
    EXPECT_EQ(trace::SceneGeometry::builds(), before + 1);
    params.geometry = trace::geometry_of(document.scene);
    EXPECT_EQ(reference_image(params).color->pixels, alone.color->pixels);
    EXPECT_EQ(trace::SceneGeometry::builds(), before + 2);
  }
}

TEST(Reference, StartsWithTheseValues) {
  const ReferenceParams params = {};
  EXPECT_EQ(params.method, "path");
  EXPECT_EQ(params.max_depth, 25);
  EXPECT_EQ(params.passes, 256);
  EXPECT_EQ(params.time, 0);
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

}  // namespace
}  // namespace ssphh::viewer
