/// Contracts of libs/farm and libs/report.

#include <ssphh/farm/disk_cache.h>
#include <ssphh/farm/farm_render.h>
#include <ssphh/farm/job_codec.h>
#include <ssphh/farm/job_cutter.h>
#include <ssphh/farm/run_job.h>
#include <ssphh/farm/scene_package.h>
#include <ssphh/image/io.h>
#include <ssphh/report/cache.h>
#include <ssphh/report/expansion.h>
#include <ssphh/report/measure.h>
#include <ssphh/report/packed_image.h>
#include <ssphh/report/report.h>

#include "contract.h"
#include "spoilt_scenes.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

using image::Image;
using report::LayerPicture;

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

LayerPicture picture(int width, int height, int channels = 3) {
  return {Image(width, height, channels), {}};
}

std::vector<Contract> of_report() {
  return {
      refuses("PackHalf", "OfATornImage",
              [] {
                Image image(4, 4);
                image.pixels.resize(5);
                report::pack_half(image);
              },
              {"packed image"}),
      refuses("PackBytes", "OfAnEmptyImage", [] { report::pack_bytes(Image()); }, {"packed image", "empty"}),
      refuses("Unpack", "OfANegativeSize",
              [] {
                report::PackedImage packed = report::pack_half(Image(2, 2));
                packed.width = -2, packed.height = -2;
                report::unpack(packed);
              },
              {"packed image", "size"}),
      refuses("Unpack", "OfAnotherSize",
              [] {
                report::PackedImage packed = report::pack_half(Image(2, 2));
                packed.width = 3;
                report::unpack(packed);
              },
              {"packed image", "broken"}),
      refuses("LoadLayer", "OfNoPictures", [] { report::load_layer({}, ""); }, {"layer", "no picture"}),
      refuses("LoadLayer", "OfAPictureThatIsNotThere", [] { report::load_layer({"/nowhere/x.exr"}, ""); },
              {"/nowhere/x.exr"}),
      refuses("LoadLayer", "OfIrradianceWhoseAlbedoLiesAcross",
              [] {
                const TempDir dir;
                image::write_image(dir / "x.indirect.exr", Image(4, 2));
                image::write_image(dir / "x.albedo.exr", Image(2, 4));
                report::load_layer({dir / "x.exr"}, "irradiance");
              },
              {"x.exr", "one size"}),
      refuses("LoadLayer", "OfGreyIrradiance",
              [] {
                const TempDir dir;
                image::write_image(dir / "x.indirect.exr", Image(4, 2, 1));
                image::write_image(dir / "x.albedo.exr", Image(4, 2, 1));
                report::load_layer({dir / "x.exr"}, "irradiance");
              },
              {"x.exr", "in colour"}),
      refuses("LoadLayer", "OfHalvesOfTwoShapes",
              [] {
                const TempDir dir;
                image::write_image(dir / "a.exr", Image(4, 2));
                image::write_image(dir / "b.exr", Image(2, 4));
                report::load_layer({dir / "a.exr", dir / "b.exr"}, "");
              },
              {"b.exr", "differ in size"}),
      refuses("MeasureLayer", "WithoutRuns", [] { report::measure_layer(picture(8, 8), {}, {}); },
              {"no run"}),
      refuses("MeasureLayer", "OfTwoSizes", [] { report::measure_layer(picture(8, 4), {picture(4, 8)}, {}); },
              {"sizes differ"}),
      refuses("MeasureLayer", "OfAVarianceOfAnotherSize",
              [] {
                LayerPicture run = picture(8, 8);
                run.variance = Image(2, 2);
                report::measure_layer(picture(8, 8), {run}, {});
              },
              {"variance"}),
      refuses("MeasureLayer", "OfAnInsetOutside",
              [] {
                report::MeasureParams params;
                params.insets.push_back({"corner", 0.5, 0.5, 1.5, 1});
                report::measure_layer(picture(8, 8), {picture(8, 8)}, params);
              },
              {"inset corner", "0..1"}),
      refuses("MeasureLayer", "OfAnInsetThatIsNoNumber",
              [] {
                report::MeasureParams params;
                params.insets.push_back({"corner", double(nan), 0, 1, 1});
                report::measure_layer(picture(8, 8), {picture(8, 8)}, params);
              },
              {"inset corner"}),
      refuses("MeasureLayer", "OfBlocksWithoutPixels",
              [] {
                report::measure_layer(picture(8, 8), {picture(8, 8)}, {0, {}});
              },
              {"blocks of 0"}),
      gives("ValueOf", "NoNumbers", [] { EXPECT_EQ(report::value_of({}).count, 0); }),
      gives("ValueOf", "NumbersOfWhichOneIsNone",
            [] {
              std::vector<double> numbers(40, 1.0);
              numbers[7] = numbers[31] = double(nan);
              EXPECT_TRUE(std::isnan(report::value_of(numbers).median));
              EXPECT_EQ(report::value_of(numbers).count, 40);
            }),
      gives("AddNumbers", "OfNoJson",
            [] {
              std::map<std::string, std::vector<double>> values;
              report::add_numbers("bake", "no json", values);
              EXPECT_TRUE(values.empty());
            }),
      gives("IdentityOf", "NoReport", [] { EXPECT_EQ(report::identity_of("no json"), ""); }),
      refuses("ParsePlan", "OfNoText", [] { report::parse_plan("", "x.json", {}); }, {"x.json"}),
      refuses("SetVariable", "WithoutAValue",
              [] {
                report::Plan plan;
                report::set_variable(plan, "spp");
              },
              {"spp", "NAME=VALUE"}),
      refuses("SetVariable", "ThatThePlanDoesNotHave",
              [] {
                report::Plan plan;
                report::set_variable(plan, "spp=4");
              },
              {"spp"}),
      gives("FindRun", "InNoFolder", [] { EXPECT_FALSE(report::find_run("/nowhere", "key", "")); }),
  };
}

SSPHH_CONTRACTS(Farm, of_farm());
SSPHH_CONTRACTS(Report, of_report());

}  // namespace
}  // namespace ssphh::test
