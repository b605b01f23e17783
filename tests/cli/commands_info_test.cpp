// Commands that tell of scenes, methods, probe files and frames, and those that serve, as the functions that
// they are: called with structs, without a process or a command line, and held against the library.

#include <algorithm>
#include <future>
#include <thread>

#include <gmock/gmock.h>

#include <ssphh/bake/bake.h>
#include <ssphh/core/file.h>
#include <ssphh/core/parallel.h>
#include <ssphh/image/io.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/window.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/bench_frame.h"
#include "commands/broker.h"
#include "commands/farm.h"
#include "commands/methods.h"
#include "commands/probe.h"
#include "commands/probe_convert.h"
#include "commands/scene.h"
#include "commands/view.h"
#include "commands/worker.h"
#include "error_message.h"
#include "temp_dir.h"
#include "thread_count.h"

namespace ssphh::app {
namespace {

using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Commands, SceneListIsTheLibrarys) {
  const SceneListResult result = run_scene_list();
  ASSERT_EQ(result.scenes.size(), scene::builtin_scenes().size());
  for (std::size_t i = 0; i < result.scenes.size(); ++i)
    EXPECT_EQ(result.scenes[i].name, scene::builtin_scenes()[i].name);
}

TEST(Commands, SceneInfoCountsWhatTheSceneHoldsInItsPose) {
  SceneOptions options;
  options.source = "builtin:cornell";
  const SceneInfo box = run_scene_info(options);
  EXPECT_EQ(box.emissive_instances, 1u);
  EXPECT_EQ(box.movable, 0u);
  EXPECT_THAT(box.cameras, ElementsAre("front"));

  // A door larger than the house, which carries a SPHL.
  const test::TempDir dir;
  scene::Scene scene = scene::make_builtin("two-rooms");
  const auto door = std::ranges::find(scene.nodes, true, &scene::Node::movable) - scene.nodes.begin();
  const auto leaf = std::ranges::find(scene.instances, static_cast<int>(door), &scene::Instance::node);
  ASSERT_NE(leaf, scene.instances.end());
  for (vec3& p : scene.meshes[leaf->mesh].positions) p *= 20.0f;
  scene.sphls[0].node = static_cast<int>(scene.nodes.size());
  scene::Node& handle = scene.nodes.emplace_back();
  handle.parent = static_cast<int>(door), handle.local.translation = vec3(1), handle.movable = true;
  scene.sphls[1].enabled = false;
  scene_io::write_glb(dir / "s.glb", scene);
  options.source = dir / "s.glb";
  options.time = 0.75f;
  const SceneInfo info = run_scene_info(options);
  EXPECT_EQ(info.name, "two-rooms");
  EXPECT_EQ(info.triangles, scene::triangle_count(scene));
  EXPECT_EQ(info.meshes, scene.meshes.size());
  EXPECT_EQ(info.instances, scene.instances.size());
  EXPECT_EQ(info.materials, scene.materials.size());
  EXPECT_EQ(info.lights, 1u);
  EXPECT_EQ(info.emissive_instances + info.textures, 0u);
  EXPECT_EQ(info.animations, scene.animations.size());
  EXPECT_EQ(info.animation_seconds, scene::animation_duration(scene));
  EXPECT_EQ(info.movable, 2u);
  EXPECT_FALSE(info.environment);
  EXPECT_THAT(info.light_groups, ElementsAre("lamp"));
  EXPECT_THAT(info.cameras, ElementsAre("room-a", "room-b"));
  EXPECT_EQ(info.hash, scene::scene_hash(load_scene(options)));
  const scene::Bounds bounds = scene::world_bounds(scene, scene::world_matrices(scene, 0.75f));
  EXPECT_EQ(info.bounds.min, bounds.min);
  EXPECT_EQ(info.bounds.max, bounds.max);
  EXPECT_NE(bounds.max, scene::world_bounds(scene, scene::world_matrices(scene)).max) << "the pose counts";
  const std::vector<scene::ProbePlace> places = scene::sphl_places(scene, 0.75f);
  EXPECT_NE(places[0].position, scene::sphl_places(scene)[0].position);
  EXPECT_EQ(info.sphls.size(), places.size() + 1) << "one is disabled";
  ASSERT_EQ(info.places.size(), places.size());
  EXPECT_EQ(info.places[0].position, places[0].position);
  EXPECT_EQ(info.places[1].name, places[1].name);
}

TEST(Commands, MethodsAreTheLibrarysTable) {
  const MethodsResult all = run_methods();
  EXPECT_EQ(all.methods.data(), methods::all_methods().data());
  EXPECT_EQ(all.methods.size(), methods::all_methods().size());
  const MethodsResult one = run_methods({.name = "vpl"});
  ASSERT_EQ(one.methods.size(), 1u);
  EXPECT_EQ(one.methods.data(), &methods::find_method("vpl"));
  EXPECT_THAT(message_of([] { run_methods({.name = "vpll"}); }), HasSubstr("there is no such method"));
}

/// builtin:two-rooms with its door half open, and the probes of a small bake in a file.
class ProbesInFiles : public testing::Test {
 protected:
  static probes::ProbeSet baked(const scene::Scene& scene) {
    bake::BakeParams params;
    params.face_size = 2, params.path.spp = 2, params.viz = false;
    bake::BakeReport report;
    return bake::bake(trace::PathTracer(scene, 0.5f), place::init_from_scene(scene, 1, 0.5f), params, "",
                      report);
  }

  ProbesInFiles() { probes::write_probe_file(set_, file_); }

  const test::TempDir dir_;
  const std::string file_ = dir_ / "a.sphl";
  const scene::Scene scene_ = scene::make_builtin("two-rooms");
  probes::ProbeSet set_ = baked(scene_);
};

TEST_F(ProbesInFiles, InfoFindsTheLowestIrradiance) {
  set_.probes.resize(2);
  // Light 1 from everywhere in red and green, a half in blue, less toward one side in green: E is π of the
  // mean, and band 1 is weighted by 2π/3.
  sh::RadianceSh light(1);
  const float y00 = std::sqrt(1 / (4 * pi)), y10 = std::sqrt(3 / (4 * pi));
  light[0] = vec3(1, 1, 0.5f) / y00;
  light[2] = vec3(0, 0.9f, 0) / y10;
  for (probes::GroupLight& group : set_.probes[1].groups) group = {sh::RadianceSh(1), sh::RadianceSh(1)};
  set_.probes[1].groups[0].reflected = light;
  probes::merge_groups(set_);
  probes::write_probe_file(set_, file_);
  const ProbeInfo info = run_probe_info({file_});
  EXPECT_EQ(info.set, set_);
  ASSERT_EQ(info.lowest_irradiance.size(), 2u);
  // A search over normals ends within a thousandth.
  EXPECT_NEAR(info.lowest_irradiance[1], pi - 0.9f * 2 * pi / 3, 1e-3f * pi);
  const vec3 lowest = sh::minimum(sh::irradiance_from_radiance(set_.probes[0].self));
  EXPECT_EQ(info.lowest_irradiance[0], std::min({lowest.x, lowest.y, lowest.z}));
}

TEST_F(ProbesInFiles, PreviewAndConvertWriteWhatTheLibraryMakes) {
  const ProbePreviewOptions preview{.input = file_, .output = dir_ / "p.exr", .width = 8, .exposure = 1};
  const ProbePreviewResult drawn = run_probe_preview(preview);
  const ProbeSheet sheet = probe_sheet(set_, 8, 1);
  EXPECT_EQ(drawn.set, set_);
  EXPECT_EQ(drawn.sheet.image.pixels, sheet.image.pixels);
  EXPECT_EQ(image::read_image(preview.output).pixels, sheet.image.pixels);
  ASSERT_EQ(drawn.sheet.columns.size(), 1u) << "no neighbours";
  EXPECT_EQ(drawn.sheet.columns[0].exposure, sheet.columns[0].exposure);

  const ProbeConvertOptions convert{.input = file_, .output = dir_ / "a.sphl.json"};
  const ProbeConvertResult converted = run_probe_convert(convert);
  EXPECT_EQ(converted.probes, set_.probes.size());
  EXPECT_EQ(converted.bytes, read_file(convert.output).size());
  EXPECT_EQ(read_text_file(convert.output), probes::probes_to_json(set_));
}

TEST_F(ProbesInFiles, LintHandsBackTheLibrarysProblems) {
  set_.probes[1].position = vec3(0, -0.1f, 0);  // in the floor
  probes::write_probe_file(set_, file_);
  ProbeLintOptions options;
  options.scene.source = "builtin:two-rooms";
  options.input = file_;
  options.params.spacing = 1;
  study::LintParams params = options.params;
  params.interest = place::place_params(scene_, 0.5f).interest;
  options.params.interest = {set_.probes[1].position};  // as if one should be there
  const auto wanted = study::lint_probes(set_, trace::TransportScene(scene_), params);
  const ProbeLintResult result = run_probe_lint(options);
  EXPECT_EQ(result.set, set_);
  ASSERT_EQ(result.problems.size(), wanted.size());
  ASSERT_GT(wanted.size(), 0u);
  EXPECT_EQ(wanted[0].kind, study::ProbeProblem::inside);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(result.problems[i].probe, wanted[i].probe);
    EXPECT_EQ(result.problems[i].message, wanted[i].message);
  }
  EXPECT_TRUE(has_failed(result, options));
  EXPECT_FALSE(has_failed({result.set, {}}, options));
  options.scene.source = "builtin:cornell";
  EXPECT_THAT(message_of([&] { run_probe_lint(options); }), HasSubstr("another scene"));
}

TEST_F(ProbesInFiles, BenchFrameTimesEveryFrame) {
  BenchFrameOptions options;
  options.scene.source = "builtin:two-rooms";
  options.scene.time = 0.5f;
  options.frames = 0;
  EXPECT_EQ(message_of([&] { run_bench_frame(options); }), "bench-frame: needs a frame");
  options.lookup.probes = file_;
  options.width = 16, options.height = 12;
  options.frames = 2, options.warm_up = 1;
  options.ratio = true;
  BenchFrameResult result;
  try {
    result = run_bench_frame(options);
  } catch (const Error& e) {
    GTEST_SKIP() << e.what();
  }
  gl::Context gl = gl::Context::headless();
  EXPECT_EQ(result.renderer, gl.info().renderer);
  realtime::Renderer renderer(gl, scene_, {}, 0.5f);
  set_probes(renderer, options.lookup, scene_, 0.5f);
  realtime::FrameSettings settings = still_settings(options.lookup, 1);
  settings.indirect_scale = 3;
  const realtime::Target target{.width = 16, .height = 12};
  const scene::CameraPose camera = scene::camera_pose(scene_, "", 0.5f);
  renderer.draw(camera, settings, target);
  EXPECT_EQ(result.draw_calls, renderer.draw(camera, settings, target).draw_calls);
  EXPECT_EQ(result.memory, renderer.memory_bytes());
  EXPECT_EQ(result.probes, static_cast<int>(set_.probes.size()));
  EXPECT_THAT(result.frame_ms, testing::AllOf(testing::SizeIs(2), testing::Each(testing::Gt(0))));
  EXPECT_THAT(result.direct_ms, testing::AllOf(testing::SizeIs(2), testing::Each(testing::Gt(0))));
  ASSERT_TRUE(result.pass_ms.contains("indirect"));
  EXPECT_EQ(result.pass_ms.at("indirect").size(), 2u);
  EXPECT_GT(result.resident, 0);
  EXPECT_THAT(result.method_numbers, testing::IsEmpty()) << "they are of methods";
}

TEST(Commands, BrokerAndWorkerServeUntilTheyAreStopped) {
  const test::TempDir dir;
  BrokerChoice choice;
  choice.endpoint = "ipc://" + (dir / "broker").string();
  BrokerSettings broker;
  broker.broker.bind = choice.endpoint;
  std::vector<std::string> events;
  std::promise<majordomo::Broker*> listens;
  bool ended = false;
  std::thread serving([&] {
    run_broker(broker, {[&](majordomo::Broker& b) { listens.set_value(&b); }, [&] { ended = true; },
                        [&](const majordomo::BrokerEvent& event) { events.emplace_back(event.name); }});
  });
  majordomo::Broker* running = listens.get_future().get();
  EXPECT_EQ(running->endpoint(), choice.endpoint);
  EXPECT_FALSE(ended);

  WorkerSettings worker;
  worker.broker = choice;
  worker.pool.slots = 2;
  worker.cache = dir / "cache";
  const test::Threads all(0);  // whatever another test left
  const int threads = thread_count();
  CancelToken leave;
  farm::WorkerPoolReport report;
  testing::internal::CaptureStderr();
  std::thread working([&] { report = run_worker(worker, {nullptr, &leave}); });
  const auto workers = [&] { return run_farm_status(choice).workers["workers"].size(); };
  for (int i = 0; i < 500 && workers() < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(workers(), 2u) << "one each slot";
  leave.request();
  working.join();
  EXPECT_EQ(thread_count(), shared_threads(threads, 2));
  EXPECT_EQ(report.jobs, 0u);
  EXPECT_GT(report.seconds, 0);
  worker.pool.slots = 1, worker.threads = 1;
  run_worker(worker, {nullptr, &leave});
  EXPECT_EQ(thread_count(), 1);
  worker.threads = 0;
  run_worker(worker, {nullptr, &leave});
  EXPECT_EQ(thread_count(), threads) << "whatever another run left";
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("worker-ready broker=" + choice.endpoint));
  running->stop();
  serving.join();
  EXPECT_TRUE(ended);
  EXPECT_THAT(events, testing::IsSupersetOf({"broker-draining", "broker-ended"}));
}

TEST(Commands, BrokerIsNotReadyWhereItCannotListen) {
  BrokerSettings settings;
  settings.broker.bind = "ipc:///nonexistent/x";
  int calls = 0;
  const BrokerCalls count{[&](majordomo::Broker&) { ++calls; }, [&] { ++calls; }};
  EXPECT_THAT(message_of([&] { run_broker(settings, count); }), HasSubstr("cannot bind"));
  EXPECT_EQ(calls, 0);

  const test::TempDir dir;
  settings.broker.bind = "ipc://" + (dir / "broker").string();
  const BrokerCalls failing{[](majordomo::Broker&) { throw Error("stdout", "is full"); }, [&] { ++calls; }};
  EXPECT_EQ(message_of([&] { run_broker(settings, failing); }), "stdout: is full");
  EXPECT_EQ(calls, 1) << "whoever kept the broker is told";
}

TEST(Commands, ViewRefusesWhatIsNoSize) {
  ViewOptions options;
  options.size = "64x63";
  EXPECT_THAT(message_of([&] { run_view(options); }), HasSubstr("\"64x63\" is no size"));
}

}  // namespace
}  // namespace ssphh::app
