/// Contracts of libs/report.

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/report/cache.h>
#include <ssphh/report/expansion.h>
#include <ssphh/report/measure.h>
#include <ssphh/report/packed_image.h>
#include <ssphh/report/report.h>

#include "contract.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

using image::Image;
using report::LayerPicture;

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

/// A plan with one scene and one method of one step.
report::Plan sound_plan() {
  report::Plan plan;
  report::PlanScene& scene = plan.scenes.emplace_back();
  scene.name = scene.title = "room";
  scene.words = {"builtin:cornell"};
  report::PlanMethod& method = plan.methods.emplace_back();
  method.name = "path";
  method.steps.push_back({"render", {"render", "{scene}", "-o", "x.exr"}});
  method.picture = "x.exr";
  method.variants.emplace_back();
  return plan;
}

Contract refuses_plan(const std::string& given, std::function<void(report::Plan&)> spoil,
                      std::vector<std::string> words) {
  return refuses(
      "Expand", given,
      [spoil] {
        report::Plan plan = sound_plan();
        spoil(plan);
        report::ExpandContext context;
        context.scene_hashes["room"] = "1";
        report::expand(plan, context);
      },
      std::move(words));
}

/// A run in its folder, to be kept.
struct Run {
  TempDir dir;
  std::filesystem::path cache = dir.path() / "cache", work = cache / "work";
  report::Job job;

  Run() {
    std::filesystem::create_directories(work);
    write_file(work / "stdout", std::string("{}"));
    job.key = std::string(32, '7');
  }
};

Contract refuses_run(const std::string& given, std::function<void(Run&)> keep,
                     std::vector<std::string> words) {
  return refuses(
      "KeepRun", given, [] { return std::make_unique<Run>(); }, std::move(keep), std::move(words),
      [](Run& run) {
        report::keep_run(run.cache, run.job, run.work, {});
        EXPECT_TRUE(report::find_run(run.cache, run.job.key, ""));
      });
}

report::Report report_with(std::size_t scene, int method) {
  report::Report report;
  report.plan = sound_plan();
  report::ReportCell& cell = report.cells.emplace_back();
  cell.scene = scene, cell.method = method;
  cell.failure = "it failed";
  return report;
}

/// Every way to write a report refuses cells of scenes and methods that the plan does not have.
std::vector<Contract> of_reports() {
  const std::vector<std::pair<std::string, std::function<void(const report::Report&)>>> writers{
      {"ReportJson", [](const auto& r) { report::report_json(r); }},
      {"ReportCsv", [](const auto& r) { report::report_csv(r); }},
      {"ReportMarkdown", [](const auto& r) { report::report_markdown(r); }},
      {"ReportPage", [](const auto& r) { report::report_page(r); }}};
  std::vector<Contract> rows;
  for (const auto& [name, write] : writers) {
    rows.push_back(gives(name, "AsItShouldBe", [write = write] { write(report_with(0, 0)); }));
    rows.push_back(refuses(name, "OfASceneThatIsNotThere", [write = write] { write(report_with(1, 0)); },
                           {"report", "scene 1 of 1"}));
    rows.push_back(refuses(name, "OfAMethodThatIsNotThere", [write = write] { write(report_with(0, 1)); },
                           {"report", "method 1 of 1"}));
  }
  rows.push_back(refuses("ExposureOf", "ASceneThatIsNotThere",
                         [] { report::exposure_of(report_with(0, 0), 1); }, {"report", "scene 1 of 1"}));
  rows.push_back(
      gives("Shown", "ACellWithoutIt", [] { EXPECT_TRUE(std::isnan(report::shown({}, "seconds"))); }));
  rows.push_back(gives("Base32768", "OfNoBytes", [] { EXPECT_TRUE(report::base32768({}).empty()); }));
  rows.push_back(refuses("Unpack", "OfNoChannels",
                         [] {
                           report::PackedImage packed = report::pack_half(Image(2, 2));
                           packed.channels = 0;
                           report::unpack(packed);
                         },
                         {"packed image", "size"}));
  return rows;
}

std::vector<Contract> of_plans() {
  return {
      gives("Expand", "APlanWithoutScenes", [] { EXPECT_TRUE(report::expand({}, {}).cells.empty()); }),
      refuses_plan("OfASceneWithoutWords", [](auto& plan) { plan.scenes[0].words.clear(); },
                   {"scene room", "no words"}),
      refuses_plan("OfAMethodWithoutVariants", [](auto& plan) { plan.methods[0].variants.clear(); },
                   {"method path", "variant"}),
      refuses_plan("OfMinusOneRepetitions", [](auto& plan) { plan.methods[0].repetitions = -1; },
                   {"method path", "repetition"}),
      refuses_plan("OfAPictureThatNoStepWrites", [](auto& plan) { plan.methods[0].picture = "y.exr"; },
                   {"method path", "y.exr"}),
      refuses_plan("OfAnOutputOutside", [](auto& plan) { plan.methods[0].steps[0].words[3] = "../x.exr"; },
                   {"bare name"}),
      refuses("LoadMasks", "OfNoPicture",
              [] {
                report::Plan plan = sound_plan();
                report::Inset& inset = plan.scenes[0].insets.emplace_back();
                inset.mask_file = "nowhere.png";
                report::load_masks(plan, "/nowhere");
              },
              {"nowhere.png"}),
      refuses_run("WithoutAKey", [](Run& run) { report::keep_run(run.cache, {}, run.work, {}); }, {"key"}),
      refuses_run("OfAKeyThatLeadsOut",
                  [](Run& run) {
                    report::Job job;
                    job.key = "../" + std::string(29, '7');
                    report::keep_run(run.cache, job, run.work, {});
                  },
                  {"key"}),
      refuses_run("InNoFolder",
                  [](Run& run) { report::keep_run(run.cache, run.job, run.dir.path() / "nowhere", {}); },
                  {"nowhere"}),
      refuses_run("IntoNoFolder",
                  [](Run& run) { report::keep_run("/dev/null/cache", run.job, run.work, {}); },
                  {"/dev/null/cache"}),
      refuses_run("WithoutItsOutput",
                  [](Run& run) {
                    report::Job job = run.job;
                    job.outputs = {"x.exr"};
                    report::keep_run(run.cache, job, run.work, {});
                  },
                  {"x.exr", "was not written"}),
      gives("FindRun", "WithoutAKey", [] { EXPECT_FALSE(report::find_run("/nowhere", "", "")); }),
      gives("CommandLine", "OfNoWords", [] { EXPECT_TRUE(report::command_line({}, "", "").empty()); }),
  };
}

SSPHH_CONTRACTS(Report, of_report());
SSPHH_CONTRACTS(Reports, of_reports());
SSPHH_CONTRACTS(ReportPlan, of_plans());

}  // namespace
}  // namespace ssphh::test
