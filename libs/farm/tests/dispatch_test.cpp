#include <thread>

#include <gtest/gtest.h>

#include <ssphh/farm/engine.h>
#include <ssphh/farm/farm_bake.h>
#include <ssphh/farm/farm_render.h>
#include <ssphh/farm/worker_pool.h>
#include <ssphh/majordomo/worker.h>

#include "broker_thread.h"
#include "error_message.h"
#include "farm_fixtures.h"

namespace ssphh::farm {
namespace {

using ssphh::test::message_of;
using ssphh::test::TempDir;
using test::BrokerThread;
using test::Quiet;

/// Workers in this process.
class WorkerThread {
 public:
  WorkerThread(const BrokerAddress& broker, const std::filesystem::path& cache, int slots)
      : thread_([=, this] {
          WorkerPoolOptions options;
          options.broker = broker;
          options.cache = cache;
          options.cache_bytes = 64 << 20;
          options.slots = slots;
          options.name = "w";
          report_ = run_workers(options, {nullptr, &stop_});
        }) {}
  ~WorkerThread() {
    stop_.request();
    thread_.join();
  }

 private:
  CancelToken stop_;
  WorkerPoolReport report_;
  std::thread thread_;
};

bake::BakeParams small_bake() {
  bake::BakeParams params;
  params.face_size = 8;
  params.path = {3, 1, 4, 11};
  params.viz_params.matrix = true;
  return params;
}

probes::ProbeSet bake(const scene::Scene& scene, bake::BakeCrew* crew) {
  const trace::PathTracer tracer(scene);
  bake::BakeReport report;
  return bake::bake(tracer, place::init_from_scene(scene, 3), small_bake(), {}, report, {}, crew);
}

TEST(Dispatch, BakeOverSocketsHasTheBitsOfALocalOne) {
  const Quiet quiet;
  const TempDir dir;
  const scene::Scene scene = scene::make_builtin("gallery1");
  const probes::ProbeSet wanted = bake(scene, nullptr);
  BrokerThread broker;
  WorkerThread worker(broker.address(), dir / "cache", 2);
  for (const ContentType content : {ContentType::binary, ContentType::json}) {
    FarmOptions options;
    options.broker = broker.address();
    options.content = content;
    FarmCrew crew(options, scene, 0);
    EXPECT_EQ(bake(scene, &crew), wanted);
    EXPECT_EQ(crew.report().units, 12u);
    // The first one may have asked the broker before the worker came.
    if (content == ContentType::json) {
      EXPECT_EQ(crew.report().workers, 2) << "one a slot";
    }
  }
}

TEST(Dispatch, KnownResultsAreNotComputedAgain) {
  const Quiet quiet;
  const TempDir dir;
  const scene::Scene scene = scene::make_builtin("gallery1");
  DiskCache results(dir / "results", 64 << 20);
  FarmOptions options;
  options.results = &results;
  probes::ProbeSet first;
  {
    BrokerThread broker;
    WorkerThread worker(broker.address(), dir / "cache", 1);
    options.broker = broker.address();
    FarmCrew crew(options, scene, 0);
    first = bake(scene, &crew);
    EXPECT_EQ(crew.report().cached, 0u);
  }
  FarmCrew crew(options, scene, 0);  // nobody serves any more
  EXPECT_EQ(bake(scene, &crew), first);
  EXPECT_EQ(crew.report().cached, 12u);
  EXPECT_EQ(crew.report().jobs, 0u);
}

TEST(Dispatch, TilesHaveTheBitsOfALocalRenderAndAreNotRenderedAgain) {
  const Quiet quiet;
  const TempDir dir;
  const scene::Scene scene = scene::make_builtin("gallery1");
  trace::RenderParams params;
  params.width = 33, params.height = 33;  // four tiles: a row and a column of one pixel are the least
  params.camera = scene::camera_pose(scene, "", 0);
  params.path = {2, 3, 1, 5};
  trace::RenderState wanted;
  trace::PathTracer(scene).render(params, wanted);
  DiskCache results(dir / "results", 64 << 20);
  FarmOptions options;
  options.results = &results;
  const auto expect_wanted = [&](std::uint64_t cached) {
    using enum trace::RenderLayer;
    FarmReport report;
    const trace::RenderState got =
        render(options, scene, 0, params, std::nullopt, {color, normal, depth}, report);
    EXPECT_EQ(got.color.pixels, wanted.color.pixels);
    EXPECT_EQ(got.normal.pixels, wanted.normal.pixels);
    EXPECT_EQ(got.depth.pixels, wanted.depth.pixels);
    EXPECT_EQ(got.albedo.pixels, std::vector<float>(wanted.albedo.pixels.size())) << "was not asked for";
    EXPECT_EQ(got.passes_done, 3);
    EXPECT_EQ(got.paths, wanted.paths);
    EXPECT_EQ(got.rays, wanted.rays);
    EXPECT_EQ(report.units, 4u);
    EXPECT_EQ(report.cached, cached);
    EXPECT_EQ(report.jobs > 0, cached < 4);
    EXPECT_EQ(report.compute_seconds > 0, cached < 4);
  };
  {
    BrokerThread broker;
    WorkerThread worker(broker.address(), dir / "cache", 1);
    options.broker = broker.address();
    expect_wanted(0);
  }
  expect_wanted(4);  // nobody serves any more
}

TEST(Dispatch, ResultThatAnswersAnotherJobIsRefused) {
  const Quiet quiet;
  const scene::Scene scene = scene::make_builtin("gallery1");
  BrokerThread broker;
  majordomo::WorkerOptions liar;
  liar.endpoint = broker.address().endpoint;
  liar.service = job_service();
  majordomo::Worker worker(liar);
  std::thread thread([&] {
    worker.run([](const majordomo::Job&) {
      ProbeJobResult result{bake::BakeStage::gen, 3, {}};
      return majordomo::Frames{encode_result({result, {}}, ContentType::json)};
    });
  });
  FarmOptions options;
  options.broker = broker.address();
  FarmCrew crew(options, scene, 0);
  EXPECT_EQ(message_of([&] { bake(scene, &crew); }), "worker : its result does not answer the job");
  worker.stop();
  thread.join();
}

TEST(Dispatch, EndsWhereNoJobWillBeDoneAnyMore) {
  const Quiet quiet;
  const BrokerThread broker;
  FarmOptions options{.broker = broker.address()};
  std::string failure;
  options.failure = [&] { return std::exchange(failure, "no worker is left"); };
  FarmReport report;
  UnitGroup group{1, [](auto) { return std::string("job"); }, [](auto, JobResult) {}};
  EXPECT_EQ(
      message_of([&] { dispatch(options, {group}, report, [](std::size_t, const FarmReport&) {}, {}); }),
      "the farm: no worker is left");
}

}  // namespace
}  // namespace ssphh::farm
