// Commands as the functions that they are: called with structs, without a process or a command line, and held
// against what the library says of the same.

#include <cmath>
#include <thread>

#include <gmock/gmock.h>

#include <ssphh/bake/update.h>
#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/security.h>
#include <ssphh/majordomo/worker.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/scene_items.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/bake.h"
#include "commands/compare.h"
#include "commands/farm.h"
#include "commands/hier.h"
#include "commands/leak.h"
#include "commands/measure.h"
#include "commands/place.h"
#include "commands/relight.h"
#include "commands/respond.h"
#include "error_message.h"
#include "options/probe_options.h"
#include "temp_dir.h"

namespace ssphh::app {
namespace {

using test::message_of;
using testing::HasSubstr;

/// builtin:two-rooms with the probes of a small bake.
class BakedRooms : public testing::Test {
 protected:
  static BakeOptions small_bake(const std::string& output) {
    BakeOptions o;
    o.scene.source = "builtin:two-rooms";
    o.scene.time = 0.5f;
    o.output = output;
    o.degree = 1;
    o.seed = 7;
    o.params.face_size = 2;
    o.params.path.spp = 2;
    o.records = 0;
    return o;
  }
  /// What the library bakes by these options, in one go and without files.
  probes::ProbeSet baked(const BakeOptions& o) const {
    bake::BakeParams params = o.params;
    params.path.seed = o.seed;
    params.viz_params.neighbors = o.neighbors.value_or(-1);
    bake::BakeReport report;
    probes::ProbeSet set =
        bake::bake(tracer_, place::init_from_scene(scene_, o.degree, o.scene.time), params, "", report);
    set.baseline = probes::Baseline{params.viz_params.neighbors,
                                    params.viz_params.threshold,
                                    0,
                                    bake::Effort().most_surfels,
                                    scene::scene_items(scene_, o.scene.time),
                                    bake::make_trials(tracer_, set)};
    return set;
  }
  std::vector<rays::SurfacePoint> points(const probes::ProbeSet& set, int count, float clearance,
                                         const std::optional<scene::Bounds>& box = {}) const {
    return study::reachable_points(source_, viewpoints(scene_, source_, {&set, 1}, 0.5f), 0.5f,
                                   {count, 7, clearance, box});
  }

  const test::TempDir dir_;
  const std::string file_ = dir_ / "a.sphl";
  const scene::Scene scene_ = scene::make_builtin("two-rooms");
  const trace::TransportScene source_{scene_};
  const trace::PathTracer tracer_{scene_, 0.5f};
};

TEST_F(BakedRooms, BakeWritesAndHandsBackWhatTheLibraryBakes) {
  BakeOptions options = small_bake(file_);
  options.neighbors = 2;
  const BakeResult result = run_bake(options);
  EXPECT_EQ(result.set, baked(options));
  EXPECT_EQ(result.set, probes::read_probe_file(file_));
  EXPECT_EQ(result.viz, probes::VizMethod::path) << "so it is for few probes";
  EXPECT_EQ(result.geometry_builds, 1u);
  EXPECT_FALSE(result.place);
  EXPECT_FALSE(result.farm);
  EXPECT_FALSE(std::filesystem::exists(file_ + ".checkpoint"));
  EXPECT_FALSE(options.viz) << "the caller's options are as they were";

  options.viz = probes::VizMethod::none;
  EXPECT_EQ(probes::edge_count(run_bake(options).set), 0u);
  options.of_viz = {"--threshold"};
  EXPECT_EQ(message_of([&] { run_bake(options); }), "--threshold: is of VIZ: use --viz links or path");
}

TEST_F(BakedRooms, HierScalesGroupsAndAddsTheNeighbours) {
  probes::ProbeSet wanted = run_bake(small_bake(file_)).set;
  HierOptions options{.input = file_, .output = dir_ / "h.sphl", .params = {}, .scales = {"lamp=0.5"}};
  options.params.op = probes::HierOperator::mean;
  options.params.neighbors = 1;
  const HierResult result = run_hier(options);
  probes::relight(wanted, "lamp", vec3(0.5f));
  EXPECT_EQ(result.edges, probes::hier(wanted, options.params));
  EXPECT_EQ(result.edges, wanted.probes.size()) << "one neighbour each";
  EXPECT_EQ(result.set, wanted);
  EXPECT_EQ(probes::read_probe_file(options.output), wanted);
  ASSERT_TRUE(result.contraction);
  EXPECT_EQ(result.contraction->upper, probes::hier_contraction(wanted, options.params)->upper);
  EXPECT_GT(result.seconds, 0);
  HierResult slow = result;
  slow.seconds = 1.5e-3;
  EXPECT_THAT(to_text(slow, options), testing::HasSubstr(": 1500.0 us; another application"));
}

TEST_F(BakedRooms, LeakAndMeasureAgreeWithTheLibraryPointByPoint) {
  const probes::ProbeSet set = run_bake(small_bake(file_)).set;
  // By these some of the few points count as dark.
  study::LeakParams params{
      .dark_share = 0.5f, .sigmas = 0, .path = {.max_depth = 3, .passes = 1, .spp = 8, .seed = 7}};
  const probes::IrradianceLookup lookup(set, tracer_, probes::lookup_params({}, set));

  LeakOptions leak;
  leak.scene.source = "builtin:two-rooms";
  leak.probes = file_;
  leak.points = 16;
  leak.seed = 7;
  leak.params = params;
  leak.params.path.seed = 0;
  leak.output = dir_ / "map.exr";
  leak.width = 8, leak.height = 4, leak.map_spp = 2;
  const LeakResult leaked = run_leak(leak);
  const study::LeakReport report = study::measure_leak(tracer_, lookup, points(set, 16, 0), params);
  EXPECT_EQ(leaked.report.truth, report.truth);
  EXPECT_EQ(leaked.report.looked_up, report.looked_up);
  EXPECT_EQ(leaked.report.ratio, report.ratio);
  EXPECT_GT(report.ratio, 0);
  EXPECT_EQ(leaked.points.size(), 16u);
  EXPECT_EQ(leaked.time, 0.5f) << "that of the bake";
  ASSERT_TRUE(leaked.map);
  EXPECT_EQ(leaked.map->scale, 0) << "numbers";
  EXPECT_EQ(image::read_image(leak.output).width, 8);

  MeasureOptions measure;
  measure.scene.source = "builtin:two-rooms";
  measure.scene.time = 0.5f;
  measure.probes = {file_};
  measure.weights = {probes::WeightMethod::distance, probes::WeightMethod::mls};
  measure.methods = {"direct"};
  measure.points = 64;
  measure.seed = 7;
  measure.params = params;
  measure.params.path.seed = 0;
  measure.box = {{-9, -1, -9}, {3, 9, 9}};  // one room and most of the other
  const MeasureResult measured = run_measure(measure);
  const std::vector<rays::SurfacePoint> within = points(set, 64, 0.05f, measure.box);
  const study::TruthAtPoints truth = study::trace_truth(tracer_, within, params);
  ASSERT_EQ(measured.points.size(), within.size());
  EXPECT_EQ(measured.truth.mean, truth.mean);
  ASSERT_EQ(measured.lights.size(), 3u);
  EXPECT_EQ(measured.lights[0].weights, probes::WeightMethod::distance);
  const MeasuredLight& mls = measured.lights[1];
  const std::vector<vec3> found = study::look_up(lookup, within);
  EXPECT_EQ(mls.weights, probes::WeightMethod::mls);
  EXPECT_EQ(mls.error.channels[0].mean_error,
            study::lookup_error(found, truth.estimates).channels[0].mean_error);
  EXPECT_EQ(mls.leak_ratio, study::leak_ratio(found, truth));
  EXPECT_GT(mls.leak_ratio, 0);
  EXPECT_FALSE(mls.frame_ms);
  const MeasuredLight& direct = measured.lights[2];
  EXPECT_EQ(direct.name, "direct");
  EXPECT_EQ(direct.error.luminance.ratio, 0) << "it has no indirect light";
  EXPECT_TRUE(direct.method && direct.frame_ms);
  EXPECT_FALSE(direct.weights);
}

TEST(Commands, PlaceHandsBackTheLibrarysPlacement) {
  const test::TempDir dir;
  PlaceOverlayOptions options;
  options.scene.source = "builtin:two-rooms";
  options.output = dir / "p.ssphh.json";
  options.place.probes = "auto:2";
  options.place.levels = 0;
  const scene::Scene scene = scene::make_builtin("two-rooms");
  place::PlaceParams params = place::place_params(scene);
  params.spacing = 2, params.levels = 0;
  const PlaceResult result = run_place(options);
  EXPECT_EQ(result.placement, place::place_probes(trace::TransportScene(scene), params));
  const json::Value overlay = json::parse(read_text_file(options.output), options.output);
  EXPECT_EQ(overlay["sphls"].size(), result.placement.probes.size() - params.manual.size());
}

RelightOptions small_relight(const std::string& save) {
  RelightOptions o;
  o.scene.source = "builtin:two-rooms";
  o.animate = {"lamp.scale=1:3"};
  o.frames = 2;
  o.save = save;
  o.params.degree = 1;
  o.params.transport.directions = 64;
  o.params.transport.surfel_size = 0.5f;
  o.params.transport.link_rays = 16;
  return o;
}

TEST(Commands, RelightSavesTheLastFrameOfASession) {
  const test::TempDir dir;
  const RelightOptions options = small_relight(dir / "r.sphl");
  const RelightResult result = run_relight(options);
  EXPECT_EQ(result.run.updates.size(), 2u);
  EXPECT_FALSE(result.run.cancelled);
  EXPECT_TRUE(result.saved);

  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  transport::RelightSession session(source, result.places, options.params);
  scene::LightingState state = rays::lighting_at(source, 0);
  session.update(state);
  state.group_scales.at(0) = vec3(3);
  session.update(state);
  EXPECT_EQ(result.surfels, session.network().surfel_count());
  EXPECT_EQ(result.links, session.network().links().link_count());
  const probes::ProbeSet saved = probes::read_probe_file(options.save);
  ASSERT_EQ(saved.probes.size(), session.places().size());
  // A bake solves each group anew, to the solver's residual; a frame starts from the one before.
  for (std::size_t i = 0; i < saved.probes.size(); ++i) {
    const float wanted = session.reflected()[i][0].y;
    EXPECT_NEAR(saved.probes[i].reflected[0].y, wanted, 0.01f * wanted) << i;
  }
}

/// Asks for a stop when the second frame begins.
class StopAfterOne final : public Progress {
 public:
  void begin(const std::string& stage, std::uint64_t, const std::string&) override {
    frames_ = stage == "relighting";
  }
  void advance(std::uint64_t) override {
    if (frames_) token.request();
  }
  void end() override { frames_ = false; }
  CancelToken token;

 private:
  bool frames_ = false;
};

TEST(Commands, RelightHandsBackTheFramesBeforeACancel) {
  const test::TempDir dir;
  StopAfterOne progress;
  testing::internal::CaptureStderr();
  const RelightResult result = run_relight(small_relight(dir / "r.sphl"), {&progress, &progress.token});
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("cancelled"));
  EXPECT_EQ(result.run.updates.size(), 1u);
  EXPECT_TRUE(result.run.cancelled);
  EXPECT_FALSE(result.saved);
  EXPECT_THROW(run_relight(small_relight(dir / "r.sphl"), {nullptr, &progress.token}), Cancelled);
}

TEST(Commands, RespondTellsWhenTheErrorHasSettled) {
  const auto frames = [](const std::vector<double>& errors) {
    std::vector<RespondFrame> list;
    for (const double error : errors) list.emplace_back().error.channels[1].mean_error = error;
    return list;
  };
  EXPECT_EQ(frames_to_settle(frames({0.5})), 1);
  EXPECT_EQ(frames_to_settle(frames({0.5, 0.3, 0.21, 0.2})), 3) << "0.22 is within a tenth";
  EXPECT_EQ(frames_to_settle(frames({0.21, 0.3, 0.21, 0.2})), 3) << "it has to stay";
  EXPECT_EQ(frames_to_settle(frames({0.0151, 0.0149, 0.01})), 2) << "half a per cent";
}

TEST(Commands, CompareMeasuresAndFailsForWhatIsNoNumber) {
  const test::TempDir dir;
  image::Image reference(2, 1, 3), test(2, 1, 3);
  reference.pixels = {1, 1, 1, 2, 2, 2};
  test.pixels = {1.5f, 1.5f, 1.5f, 1, 1, 1};
  CompareOptions options;
  options.reference = dir / "a.exr", options.test = dir / "b.exr", options.output = dir / "map.exr";
  options.map = metrics::ErrorMap::with_sign;
  image::write_image(options.reference, reference);
  image::write_image(options.test, test);
  const CompareResult result = run_compare(options);
  EXPECT_EQ(result.linear.mae, 0.75);
  EXPECT_EQ(result.linear.bias, -0.25);
  EXPECT_TRUE(result.hdr);
  EXPECT_EQ(result.map_scale, 0.0f) << "numbers";
  EXPECT_EQ(image::read_image(options.output).at(1, 0)[0], -1);
  EXPECT_FALSE(has_failed(result, options));

  test.pixels[3] = NAN;
  image::write_image(options.test, test);
  const CompareResult bad = run_compare(options);
  EXPECT_EQ(bad.linear.nonfinite_pixels, 1u);
  EXPECT_TRUE(has_failed(bad, options));
  options.allow_nonfinite = true;
  EXPECT_FALSE(has_failed(bad, options));
}

TEST(Commands, FarmTellsWhatItsBrokerDoes) {
  const test::TempDir dir;
  BrokerChoice choice;
  choice.endpoint = "ipc://" + (dir / "broker").string();
  majordomo::Broker broker({.bind = choice.endpoint});
  std::thread serving([&] { broker.run(); });
  majordomo::Worker worker({.endpoint = choice.endpoint, .service = "gen", .name = "w1"});
  std::thread working([&] { worker.run([](const majordomo::Job& job) { return job.body; }); });
  majordomo::Client client({.endpoint = choice.endpoint});
  const auto finish = [&](int jobs) {
    for (int i = 0; i < jobs; ++i) client.call("gen", {"x"}, {.deadline = 5000}, {});
  };

  finish(1);
  const FarmStatus status = run_farm_status(choice);
  EXPECT_EQ(status.stats["services"][0]["finished"], 1);
  EXPECT_EQ(status.workers["workers"][0]["name"], "w1");
  EXPECT_FALSE(status.per_second);

  using Clock = std::chrono::steady_clock;
  std::vector<FarmStatus> looks;
  Clock::time_point first;
  run_farm_top({choice, 0.05, 3}, [&](const FarmStatus& look) {
    looks.push_back(look);
    if (looks.size() == 1) std::this_thread::sleep_for(std::chrono::milliseconds(60));
    if (looks.size() == 2) finish(3);
    if (looks.size() == 1) first = Clock::now();
  });
  const double most = std::chrono::duration<double>(Clock::now() - first).count();
  ASSERT_EQ(looks.size(), 3u);
  EXPECT_FALSE(looks[0].per_second);
  EXPECT_EQ(looks[1].per_second, 0.0);
  ASSERT_TRUE(looks[2].per_second);
  EXPECT_GE(*looks[2].per_second, 3 / most) << "time before the look before does not count";
  EXPECT_LE(*looks[2].per_second, 3 / 0.05);

  EXPECT_EQ(run_farm_parked(choice).jobs.size(), 0u);
  EXPECT_EQ(run_farm_release({choice, {}, true}).released, 0);
  EXPECT_EQ(run_farm_drop({choice, {}, true}).dropped, 0);
  EXPECT_THAT(message_of([&] { run_farm_drop({choice, {7}, false}); }), HasSubstr("job 7 is not set aside"));
  EXPECT_THAT(message_of([&] { run_farm_release({choice, {}, false}); }), HasSubstr("none are named"));
  EXPECT_EQ(run_farm_drain({choice, "other"}).told, 0);
  EXPECT_EQ(run_farm_drain({choice, "w"}).told, 1);
  working.join();
  broker.stop();
  broker.stop();
  serving.join();
}

TEST(Commands, FarmKeysHaveTheRightsOfTheirRole) {
  const test::TempDir dir;
  const FarmKeygenOptions options{.folder = dir / "keys", .name = "ann", .role = FarmRole::admin};
  EXPECT_EQ(run_farm_keygen(options).made, (std::vector<std::string>{"broker", "ann"}));
  const majordomo::AllowList allowed = majordomo::read_allow_list(dir / "keys/allow.txt");
  ASSERT_EQ(allowed.size(), 1u);
  EXPECT_EQ(allowed[0].public_key, majordomo::read_public_key(dir / "keys/ann.pub"));
  EXPECT_TRUE(allowed[0].rights.admin);
  EXPECT_FALSE(allowed[0].rights.may_serve("ssphh.jobs.1"));
  EXPECT_THROW(run_farm_keygen(options), Error) << "it has a key";
}

TEST(Commands, RunsWithoutFramesAreRefused) {
  RelightOptions relight;
  relight.frames = 0;
  EXPECT_EQ(message_of([&] { run_relight(relight); }), "relight: needs a frame");
  RespondOptions respond;
  const std::string problem = "respond: needs a frame before and one after the event";
  respond.frames = 0;
  EXPECT_EQ(message_of([&] { run_respond(respond); }), problem);
  respond.frames = 1, respond.before = 0;
  EXPECT_EQ(message_of([&] { run_respond(respond); }), problem);
}

}  // namespace
}  // namespace ssphh::app
