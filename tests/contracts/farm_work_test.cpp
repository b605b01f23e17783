/// Contracts of what does work on farms: dispatch, crews, workers, stores, and farms of one machine.

#include <limits>

#include <ssphh/bake/bake.h>
#include <ssphh/farm/ask.h>
#include <ssphh/farm/dispatch.h>
#include <ssphh/farm/farm_bake.h>
#include <ssphh/farm/farm_render.h>
#include <ssphh/farm/local_farm.h>
#include <ssphh/farm/run_job.h>
#include <ssphh/farm/scene_package.h>
#include <ssphh/farm/status.h>
#include <ssphh/farm/worker_pool.h>
#include <ssphh/scene/query.h>

#include "contract.h"
#include "probe_sets.h"
#include "spoilt_scenes.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

/// Where no broker is.
farm::FarmOptions nowhere() {
  farm::FarmOptions options;
  options.broker.endpoint = "ipc:///tmp/ssphh-no-broker-is-here";
  return options;
}

farm::UnitGroup one_unit() {
  farm::UnitGroup group;
  group.count = 1;
  group.body = [](std::span<const std::size_t>) { return std::string("job"); };
  group.done = [](std::span<const std::size_t>, farm::JobResult) {};
  return group;
}

/// A row for work that is refused before anybody waits for a broker.
Contract refuses_work(const std::string& given,
                      std::function<void(farm::FarmOptions&, farm::UnitGroup&)> spoil,
                      std::vector<std::string> words) {
  return refuses(
      "Dispatch", given,
      [spoil] {
        farm::FarmOptions options = nowhere();
        farm::UnitGroup group = one_unit();
        spoil(options, group);
        farm::FarmReport report;
        farm::dispatch(options, {group}, report, [](std::size_t, const farm::FarmReport&) {}, {});
      },
      std::move(words));
}

/// A row for a render that is refused before anybody waits for a broker.
Contract refuses_render(const std::string& given,
                        std::function<void(trace::RenderParams&, std::optional<farm::RenderProbes>&)> spoil,
                        std::vector<std::string> words) {
  return refuses(
      "FarmRender", given,
      [spoil] {
        const scene::Scene scene = sound_scene();
        trace::RenderParams params;
        params.width = params.height = 8;
        std::optional<farm::RenderProbes> probes;
        spoil(params, probes);
        farm::FarmReport report;
        farm::render(nowhere(), scene, 0, params, probes, {trace::RenderLayer::color}, report);
      },
      std::move(words));
}

Contract refuses_crew(const std::string& given, const bake::ProbeStage& stage,
                      std::function<void(bake::ProbeStageResult)> done, std::vector<std::string> words) {
  return refuses(
      "FarmCrew", given,
      [=] {
        const scene::Scene scene = sound_scene();
        const farm::FarmOptions options = nowhere();
        farm::FarmCrew crew(options, scene, 0);
        crew.run(sound_set(), {}, std::array{stage}, done, {});
      },
      std::move(words));
}

/// `workers`: their number, as JSON.
Contract refuses_figures(const std::string& given, const std::string& workers) {
  return refuses("FiguresOf", given,
                 [workers] {
                   farm::FarmStatus status;
                   status.stats = json::parse(
                       R"({"now":{"workers":)" + workers + R"(},"total":{},"services":[]})", "stats");
                   status.workers = json::parse(R"({"workers":[]})", "workers");
                   farm::figures_of(status);
                 },
                 {"mmi.stats", "workers"});
}

farm::LocalFarmOptions local_farm() {
  farm::LocalFarmOptions options;
  options.tool = "/bin/true";
  options.workers = 1;
  return options;
}

Contract refuses_local(const std::string& given, std::function<void(farm::LocalFarmOptions&)> spoil,
                       std::vector<std::string> words) {
  return refuses(
      "LocalFarm", given,
      [spoil] {
        farm::LocalFarmOptions options = local_farm();
        spoil(options);
        farm::LocalFarm farm(options);
      },
      std::move(words));
}

Contract refuses_pool(const std::string& given, std::function<void(farm::WorkerPoolOptions&)> spoil,
                      std::vector<std::string> words) {
  return refuses(
      "RunWorkers", given,
      [spoil] {
        const TempDir dir;
        farm::WorkerPoolOptions options;
        options.broker = nowhere().broker;
        options.cache = dir.path() / "cache";
        spoil(options);
        CancelToken cancel;
        cancel.request();  // what is not refused leaves at once
        farm::run_workers(options, {nullptr, &cancel});
      },
      std::move(words));
}

std::vector<Contract> of_work() {
  using farm::FarmOptions;
  using farm::UnitGroup;
  return {
      refuses_work("WithoutABroker", [](FarmOptions& o, UnitGroup&) { o.broker = {}; }, {"broker endpoint"}),
      refuses_work("AtNoEndpoint", [](FarmOptions& o, UnitGroup&) { o.broker.endpoint = "here"; },
                   {"here", "is no endpoint"}),
      refuses_work("OfUnitsThatHaveNoJob", [](FarmOptions&, UnitGroup& g) { g.body = {}; }, {"work", "body"}),
      refuses_work("WhoseResultsNobodyTakes", [](FarmOptions&, UnitGroup& g) { g.done = {}; },
                   {"work", "done"}),
      refuses_work("OfJobsThatTakeNoTime", [](FarmOptions& o, UnitGroup&) { o.job_seconds = double(nan); },
                   {"job cutter"}),
      refuses_work("WithoutEndOfPatience", [](FarmOptions& o, UnitGroup&) { o.patience = double(nan); },
                   {"patience"}),
      refuses_work("WithMessagesInAFile", [](FarmOptions& o, UnitGroup&) { o.messages = "/dev/null/x"; },
                   {"/dev/null/x"}),
      refuses_work("ThatTellsNobody",
                   [](FarmOptions& o, UnitGroup& g) {
                     farm::FarmReport report;
                     farm::dispatch(o, {g}, report, {}, {});
                   },
                   {"work", "finished"}),
      gives("Dispatch", "NoUnits",
            [] {
              farm::FarmReport report;
              farm::dispatch(nowhere(), {{}}, report, {}, {});
              EXPECT_EQ(report.jobs, 0u);
            }),

      refuses_render("OfNoPixels", [](auto& params, auto&) { params.width = 0; }, {"width"}),
      refuses_render("OfNegativeHeight", [](auto& params, auto&) { params.height = -3; }, {"height"}),
      refuses_render("LitByNoSet", [](auto&, auto& probes) { probes.emplace(); }, {"probes", "none"}),
      refuses_render("OfNoPasses", [](auto& params, auto&) { params.path.passes = 0; }, {"passes"}),
      refuses("FarmRender", "OfNoLayers",
              [] {
                const scene::Scene scene = sound_scene();
                farm::FarmReport report;
                farm::render(nowhere(), scene, 0, {}, {}, {}, report);
              },
              {"layers"}),

      refuses_crew("OfAProbeThatIsNotThere", {bake::BakeStage::gen, 3}, [](bake::ProbeStageResult) {},
                   {"probe 3 of 3"}),
      refuses_crew("WhoseResultsNobodyTakes", {bake::BakeStage::gen, 0}, {}, {"nobody takes"}),

      refuses_local("OfNoWorkers", [](auto& o) { o.workers = 0; }, {"--local", "1 to 1024"}),
      refuses_local("WithoutATool", [](auto& o) { o.tool = ""; }, {"cannot be started"}),
      refuses_local("OfAToolThatIsNotThere", [](auto& o) { o.tool = "/nowhere/ssphh"; },
                    {"/nowhere/ssphh", "cannot be started"}),
      refuses_local("OfAFolder", [](auto& o) { o.tool = "/tmp"; }, {"/tmp", "cannot be started"}),
      refuses_local("OfMinusOneThreads", [](auto& o) { o.threads = -1; }, {"threads"}),
      refuses_local("ThatLooksWithoutPause", [](auto& o) { o.look = {}; }, {"look"}),

      refuses_pool("OfNoSlots", [](auto& o) { o.slots = 0; }, {"slots"}),
      refuses_pool("AtNoEndpoint", [](auto& o) { o.broker.endpoint = ""; }, {"is no endpoint"}),
      refuses_pool("OfANameThatIsNone", [](auto& o) { o.name = "a b"; }, {"worker name"}),
      refuses_pool("ThatLeavesAtNoTime", [](auto& o) { o.idle_exit = double(nan); }, {"idle"}),
      refuses_pool("ThatLeavesBeforeItCame", [](auto& o) { o.idle_exit = -1; }, {"idle"}),
      refuses_pool("WithACacheInAFile", [](auto& o) { o.cache = "/dev/null/cache"; }, {"/dev/null/cache"}),
  };
}

/// A cache, and the sound scene that a client would send.
struct Store {
  TempDir dir;
  farm::DiskCache cache{dir.path() / "cache", 1 << 20};
  scene::Scene scene = sound_scene();
  farm::ScenePackage package = farm::pack_scene(scene);

  farm::SceneRef ref() const { return {package.id, package.manifest.size(), scene::light_hash(scene), 0}; }
  farm::FetchChunk fetch() const {
    return [this](const Hash128&, const Hash128& hash, std::uint64_t offset, std::uint64_t length) {
      std::span<const std::byte> blob = package.manifest;
      for (const farm::Blob& other : package.blobs)
        if (other.hash == hash) blob = other.bytes;
      const auto part = blob.subspan(offset, length);
      return std::vector<std::byte>(part.begin(), part.end());
    };
  }
};

Contract refuses_stored(std::string entry, std::string given, std::function<void(Store&)> call,
                        std::vector<std::string> words) {
  return refuses(
      std::move(entry), std::move(given), [] { return std::make_unique<Store>(); }, std::move(call),
      std::move(words),
      [](Store& s) {
        farm::SceneStore scenes(s.cache);
        EXPECT_EQ(scenes.get(s.ref(), s.fetch(), {})->scene.name, "sound");
      });
}

std::vector<Contract> of_stores() {
  return {
      refuses_stored("SceneStore", "ThatKeepsNone", [](Store& s) { farm::SceneStore(s.cache, 0); },
                     {"scene store", "1 at least"}),
      refuses_stored("SceneStore", "WithoutSource",
                     [](Store& s) { farm::SceneStore(s.cache).get(s.ref(), {}, {}); }, {"blob", "fetch"}),
      refuses_stored("SceneStore", "AtNoTime",
                     [](Store& s) {
                       farm::SceneRef ref = s.ref();
                       ref.time = nan;
                       farm::SceneStore(s.cache).get(ref, s.fetch(), {});
                     },
                     {"time"}),
      refuses_stored("RunJob", "OfNoProbes",
                     [](Store& s) {
                       farm::SceneStore scenes(s.cache);
                       farm::ProbeJob job;
                       job.scene = s.ref();
                       farm::run_job(job, scenes, s.fetch());
                     },
                     {"job: probes"}),
      refuses_stored("RunJob", "OfARendererThatIsNotThere",
                     [](Store& s) {
                       farm::SceneStore scenes(s.cache);
                       farm::ProbeJob job;
                       job.scene = s.ref(), job.renderer = farm::Renderer::cycles;
                       job.probes = {0}, job.places.resize(1);
                       farm::run_job(job, scenes, s.fetch());
                     },
                     {"renderer cycles", "not there"}),
      refuses_work(
          "ByARendererThatIsNone",
          [](farm::FarmOptions& o, farm::UnitGroup&) { o.renderer = static_cast<farm::Renderer>(9); },
          {"none of that number"}),
      refuses_stored("RunJob", "OfProbesWithoutPlaces",
                     [](Store& s) {
                       farm::SceneStore scenes(s.cache);
                       farm::ProbeJob job;
                       job.scene = s.ref();
                       job.stage = bake::BakeStage::viz;
                       job.probes = {7};
                       job.places.resize(2);
                       farm::run_job(job, scenes, s.fetch());
                     },
                     {"job: probes", "out of range"}),
      refuses_stored("RunJob", "OfATileOutside",
                     [](Store& s) {
                       farm::SceneStore scenes(s.cache);
                       farm::TileJob job;
                       job.scene = s.ref();
                       job.layers = {trace::RenderLayer::color};
                       job.tiles = {{1 << 20, 0, 8, 8}};
                       farm::run_job(job, scenes, s.fetch());
                     },
                     {"job: tiles"}),
      refuses("UnpackScene", "WithoutSource",
              [] {
                scene::Scene scene = sound_scene();
                scene.meshes.push_back(scene::make_sphere(1));
                farm::unpack_scene(farm::pack_scene(scene).manifest, {});
              },
              {"scene manifest", "fetch"}),
      refuses("BlobServer", "AtNoEndpoint",
              [] {
                farm::BlobServer({"nowhere", {}}, {});
              },
              {"is no endpoint"}),
      refuses("Connect", "ToNoEndpoint",
              [] {
                farm::connect({"", {}});
              },
              {"is no endpoint"}),
      refuses("StatusWatch", "OfNoEndpoint",
              [] {
                farm::StatusWatch watch({"tcp://", {}});
              },
              {"tcp://"}),
      refuses("FiguresOf", "Nothing", [] { farm::figures_of({}); }, {"mmi."}),
      refuses_figures("TextsForNumbers", R"("two")"),
      refuses_figures("NegativeNumbers", R"(-2)"),
      refuses_figures("NumbersThatNoCountCanBe", R"(1e300)"),
  };
}

SSPHH_CONTRACTS(FarmWork, of_work());
SSPHH_CONTRACTS(FarmStore, of_stores());

}  // namespace
}  // namespace ssphh::test
