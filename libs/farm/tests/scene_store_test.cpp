#include <gtest/gtest.h>

#include "error_message.h"
#include "farm_fixtures.h"

namespace ssphh::farm {
namespace {

using ssphh::test::TempDir;
using test::PackedScene;

TEST(SceneStore, KeepsTheScenesThatWereUsedLast) {
  const PackedScene packed("cornell");
  const TempDir dir;
  DiskCache cache(dir.path(), 1 << 28);
  SceneStore scenes(cache, 2);
  const auto at_time = [&](float time) {
    SceneRef ref = packed.ref();
    ref.time = time;
    return scenes.get(ref, packed.fetch(), {});
  };
  const auto first = at_time(0), second = at_time(1);
  EXPECT_NE(first, second) << "another pose is another scene";
  EXPECT_EQ(at_time(0), first);
  at_time(2);
  EXPECT_EQ(at_time(0), first) << "used after the second, which made room";
  EXPECT_NE(at_time(1), second);
}

TEST(SceneStore, AsksForNoManifestThatIsLargerThanOneMayBe) {
  const PackedScene packed("cornell");
  const TempDir dir;
  DiskCache cache(dir.path(), max_package_bytes);
  SceneStore scenes(cache);
  const auto said_of_size = [&](std::uint64_t bytes) {
    SceneRef ref = packed.ref();
    ref.manifest_bytes = bytes;
    const FetchChunk none = [](const Hash128&, const Hash128&, std::uint64_t,
                               std::uint64_t) -> std::vector<std::byte> {
      throw Error("manifest", "was asked for");
    };
    return ssphh::test::message_of([&] { scenes.get(ref, none, {}); });
  };
  EXPECT_EQ(said_of_size(max_manifest_bytes), "manifest: was asked for");
  EXPECT_EQ(said_of_size(max_manifest_bytes + 1), "scene manifest: is too large");
}

// The door of the two rooms opens from time 0 to 1.
TEST(SceneStore, AJobIsDoneInThePoseThatItNames) {
  const PackedScene packed("two-rooms");
  const TempDir dir;
  DiskCache cache(dir.path(), 1 << 28);
  SceneStore scenes(cache);
  ProbeJob job = test::gen_job(packed);
  job.probes.resize(1), job.places.resize(1);
  const auto light_at = [&](float time) {
    job.scene.time = time;
    return std::get<ProbeJobResult>(run_job(job, scenes, packed.fetch()).data).probes[0].groups;
  };
  probes::ProbeSet set;
  set.degree = job.degree;
  set.generator.max_depth = job.path.max_depth, set.generator.passes = job.path.passes;
  set.generator.spp = job.path.spp, set.generator.seed = job.path.seed;
  set.generator.face_size = job.face_size;
  set.probes.resize(job.probes[0] + 1);
  set.probes[job.probes[0]].position = job.places[0].position;
  const trace::PathTracer open(packed.scene, 0.75f);
  EXPECT_EQ(light_at(0.75f), bake::bake_stage(open, set, {}, {bake::BakeStage::gen, job.probes[0]}).groups);
  EXPECT_NE(light_at(0.75f), light_at(0));
}

/// Who is killed while it fetches must be able to go on.
TEST(SceneStore, AFileThatIsOnItsWayCanBeWrittenByWhoFetchesIt) {
  const PackedScene packed("cornell");
  const TempDir dir;
  DiskCache cache(dir.path(), max_package_bytes);
  SceneStore scenes(cache);
  const FetchChunk fetch = packed.fetch();
  int seen = 0;
  const FetchChunk looking = [&](const Hash128& package, const Hash128& blob, std::uint64_t at,
                                 std::uint64_t size) {
    for (const auto& file : std::filesystem::directory_iterator(dir.path())) {
      if (file.path().extension() != ".part") continue;
      using enum std::filesystem::perms;
      EXPECT_EQ(file.status().permissions() & (owner_all | others_write | sticky_bit),
                owner_read | owner_write);
      ++seen;
    }
    return fetch(package, blob, at, size);
  };
  scenes.get(packed.ref(), looking, {});
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace ssphh::farm
