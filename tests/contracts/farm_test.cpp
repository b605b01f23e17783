/// Contracts of libs/farm: jobs, scenes and values on their way.

#include <ssphh/farm/disk_cache.h>
#include <ssphh/farm/farm_render.h>
#include <ssphh/farm/job_codec.h>
#include <ssphh/farm/job_cutter.h>
#include <ssphh/farm/run_job.h>
#include <ssphh/farm/scene_package.h>

#include "contract.h"
#include "spoilt_scenes.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

farm::ProbeJob sound_job() {
  farm::ProbeJob job;
  job.degree = 2;
  job.face_size = 4;
  job.probes = {0};
  job.places = {{}};
  return job;
}

/// A row for a job that neither client nor worker may take.
Contract refuses_job(const std::string& given, std::function<void(farm::ProbeJob&)> spoil,
                     std::vector<std::string> words) {
  return refuses(
      "Job", given,
      [spoil] {
        farm::ProbeJob job = sound_job();
        spoil(job);
        farm::validate(job);
      },
      std::move(words));
}

struct Cache {
  TempDir dir;
  farm::DiskCache cache{dir.path() / "cache", 100};
};

std::vector<std::byte> no_blob(const Hash128&, std::uint64_t) {
  return {};
}

std::vector<Contract> of_farm() {
  return {
      refuses_job("OfDegreeEleven", [](auto& job) { job.degree = 11; }, {"job: degree", "0..10"}),
      refuses_job("WithoutProbes", [](auto& job) { job.probes.clear(); }, {"job: probes"}),
      refuses_job("OfAPlaceThatIsNone", [](auto& job) { job.places[0].position.y = nan; },
                  {"job: places", "finite"}),
      refuses_job("AtNoTime", [](auto& job) { job.scene.time = infinity; }, {"job: scene/time"}),
      refuses_job("OfMinusOneSamples", [](auto& job) { job.path.spp = -1; }, {"job: spp"}),
      refuses("Job", "OfNoTiles", [] { farm::validate(farm::TileJob()); }, {"job: "}),
      refuses("DecodeJob", "OfNoBytes", [] { farm::decode_job(""); }, {"job"}),
      refuses("DecodeJob", "OfAnotherDocument", [] { farm::decode_job("{}"); }, {"job"}),
      refuses("DecodeResult", "OfNoBytes", [] { farm::decode_result(""); }, {"result"}),
      refuses("JobCutter", "OfATimeThatIsNone", [] { farm::JobCutter(double(nan)).next(5, 1); },
              {"job cutter"}),
      refuses("JobCutter", "OfNoUnits", [] { farm::JobCutter(1, 0).next(5, 1); }, {"job cutter"}),
      gives("JobCutter", "WithoutWorkers", [] { EXPECT_EQ(farm::JobCutter(1).next(5, 0), 1u); }),
      gives("JobCutter", "ThatLearnsNothing",
            [] {
              farm::JobCutter cutter(1);
              cutter.learn(0, 1);
              cutter.learn(3, double(nan));
              EXPECT_EQ(cutter.seconds_per_unit(), 0);
            }),
      refuses(
          "DiskCache", "OfAValueOverTheBound", [] { return std::make_unique<Cache>(); },
          [](Cache& c) {
            c.cache.put({1, 2}, std::vector<std::byte>(101));
          },
          {"at most 100 bytes"},
          [](Cache& c) {
            EXPECT_FALSE(c.cache.get({1, 2}));
            c.cache.put({1, 2}, std::vector<std::byte>(7));
            EXPECT_EQ(c.cache.get({1, 2})->size(), 7u);
          }),
      refuses("DiskCache", "WithinAFile", [] { farm::DiskCache("/dev/null/cache", 100); },
              {"/dev/null/cache"}),
      refuses("UnpackScene", "OfNoBytes", [] { farm::unpack_scene({}, no_blob); }, {"cut off"}),
      refuses("UnpackScene", "WhoseBlobsAreOfAnotherSize",
              [] {
                scene::Scene scene = sound_scene();
                scene.meshes.push_back(scene::make_sphere(1));  // large enough for a blob of its own
                farm::unpack_scene(farm::pack_scene(scene).manifest, no_blob);
              },
              {"blob", "another size"}),
      refuses("UnpackScene", "OfAMeshThatIsNotThere",
              [] {
                scene::Scene scene = sound_scene();
                scene.instances[0].mesh = 9;
                const farm::ScenePackage package = farm::pack_scene(scene);
                farm::unpack_scene(package.manifest, [&](const Hash128& hash, std::uint64_t) {
                  for (const farm::Blob& blob : package.blobs)
                    if (blob.hash == hash) return blob.bytes;
                  return std::vector<std::byte>();
                });
              },
              {"mesh 9 of 1"}),
  };
}

SSPHH_CONTRACTS(Farm, of_farm());

}  // namespace
}  // namespace ssphh::test
