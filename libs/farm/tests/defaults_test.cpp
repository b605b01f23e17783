/// What is meant where nobody says anything, and limits that the protocol's page names.

#include <gtest/gtest.h>

#include <ssphh/farm/farm_render.h>
#include <ssphh/farm/local_farm.h>
#include <ssphh/farm/scene_package.h>
#include <ssphh/farm/scene_store.h>
#include <ssphh/farm/worker_pool.h>

#include "farm_fixtures.h"

namespace ssphh::farm {
namespace {

constexpr std::uint64_t gibibyte = std::uint64_t{1} << 30;

TEST(FarmDefaults, OfJobs) {
  const SceneRef scene;
  EXPECT_EQ(scene.package, Hash128());
  EXPECT_EQ(scene.manifest_bytes, 0u);
  EXPECT_EQ(scene.light, Hash128());
  EXPECT_EQ(scene.time, 0);
  const ProbeSphere place;
  EXPECT_EQ(place.position, vec3(0));
  EXPECT_EQ(place.radius, 0.1f);
  const ProbeJob job;
  EXPECT_EQ(job.stage, bake::BakeStage::gen);
  EXPECT_EQ(job.degree, 9);
  EXPECT_EQ(job.face_size, 64);
  const ProbeLighting lighting;
  EXPECT_EQ(lighting.bytes, 0u);
  EXPECT_EQ(lighting.lookup, probes::LookupSpec());
  const RenderProbes probes;
  EXPECT_EQ(probes.set, nullptr);
  EXPECT_EQ(probes.lookup, probes::LookupSpec());
  const ProbeJobResult result;
  EXPECT_EQ(result.stage, bake::BakeStage::gen);
  EXPECT_EQ(result.degree, 9);
  const JobStats stats;
  EXPECT_EQ(stats.seconds, 0);
  EXPECT_EQ(stats.rays, 0u);
}

TEST(FarmDefaults, OfThoseWhoWork) {
  const FarmOptions farm;
  EXPECT_EQ(farm.content, ContentType::binary);
  EXPECT_EQ(farm.job_seconds, 1.5);
  EXPECT_EQ(farm.results, nullptr);
  EXPECT_EQ(farm.patience, 5);
  EXPECT_FALSE(farm.broker.security);
  const WorkerPoolOptions pool;
  EXPECT_EQ(pool.slots, 1);
  EXPECT_EQ(pool.name, "");
  EXPECT_EQ(pool.cache_bytes, 20 * gibibyte);
  EXPECT_EQ(pool.idle_exit, 0);
  const LocalFarmOptions local;
  EXPECT_EQ(local.workers, 2);
  EXPECT_EQ(local.threads, 0);
  EXPECT_EQ(local.cache_bytes, 20 * gibibyte);
  EXPECT_EQ(local.look, std::chrono::milliseconds(100));
}

TEST(FarmDefaults, ReportsBeginAtNothing) {
  const FarmReport report;
  EXPECT_EQ(report.jobs + report.retries + report.units + report.cached, 0u);
  EXPECT_EQ(report.workers, 0);
  EXPECT_EQ(report.compute_seconds, 0);
  EXPECT_EQ(report.seconds, 0);
  const WorkerPoolReport pool;
  EXPECT_EQ(pool.jobs, 0u);
  EXPECT_EQ(pool.busy_seconds, 0);
  EXPECT_EQ(pool.seconds, 0);
  const DiskCache::Counts counts;
  EXPECT_EQ(counts.hits + counts.misses + counts.damaged + counts.evicted, 0u);
}

TEST(FarmDefaults, LimitsAreThoseOfTheProtocol) {
  EXPECT_EQ(job_version, 2);
  EXPECT_EQ(tile_edge, 32);
  EXPECT_EQ(max_json_bytes, 32u << 20);
  EXPECT_EQ(max_manifest_bytes, 256u << 20);
  EXPECT_EQ(max_package_bytes, 16 * gibibyte);
  EXPECT_EQ(job_limits::units, 4096u);
  EXPECT_EQ(job_limits::places, 65536u);
  EXPECT_EQ(job_limits::picture_size, 65536);
  EXPECT_EQ(job_limits::tile_size, 1024);
  EXPECT_EQ(job_limits::samples, std::uint64_t{1} << 40);
}

TEST(FarmDefaults, AStoreKeepsTwoScenes) {
  const test::PackedScene packed("cornell");
  const ssphh::test::TempDir dir;
  DiskCache cache(dir.path(), 1 << 28);
  SceneStore scenes(cache);
  const auto at_time = [&](float time) {
    SceneRef ref = packed.ref();
    ref.time = time;
    return scenes.get(ref, packed.fetch(), {});
  };
  const auto first = at_time(0), second = at_time(1);
  EXPECT_EQ(at_time(0), first);
  EXPECT_EQ(at_time(1), second);
  at_time(2);
  EXPECT_NE(at_time(0), first);
}

}  // namespace
}  // namespace ssphh::farm
