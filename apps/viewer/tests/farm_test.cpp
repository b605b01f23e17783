// Bakes of the window at a farm: a broker, and sometimes a worker, in this process.

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/farm/status.h>
#include <ssphh/farm/worker_pool.h>

#include "broker_thread.h"
#include "error_message.h"
#include "gl_stage.h"
#include "panel_stage.h"
#include "script_player.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

/// Serves until its end.
class WorkerThread {
 public:
  WorkerThread(const farm::BrokerAddress& broker, const std::filesystem::path& cache) {
    options_.broker = broker, options_.cache = cache, options_.name = "mill";
    thread_ = std::thread([this] { farm::run_workers(options_, {nullptr, &stop_}); });
  }
  ~WorkerThread() {
    stop_.request();
    thread_.join();
  }

 private:
  farm::WorkerPoolOptions options_;
  CancelToken stop_;
  std::thread thread_;
};

/// A broker, and what it is asked about its jobs.
struct Farm {
  farm::test::Quiet quiet;
  std::optional<farm::test::BrokerThread> broker{std::in_place};
  farm::FarmOptions options{.broker = broker->address()};

  std::uint64_t jobs() const {
    const farm::FarmFigures f = figures_of(farm::StatusWatch(options.broker).look());
    return f.queued + f.running;
  }
  /// Far longer than it takes.
  bool comes_to(bool any) const {
    for (int i = 0; i < 1000; ++i) {
      if ((jobs() > 0) == any) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
};

class FarmBakes : public PanelStage {
 protected:
  FarmBakes() {
    options_.farm = &farm_.options;
    start(1000, 900);
    app().take_document(document("two-rooms"));
    app().bake_params.face_size = 16, app().bake_params.path = {.max_depth = 2, .passes = 1, .spp = 8};
  }
  ~FarmBakes() override { app_.reset(); }

  /// What a bake saves.
  std::vector<std::byte> baked() {
    app().start_gen(false);
    finish_work();
    app().save_probes(dir_ / "probes.sphl");
    return read_file(dir_ / "probes.sphl");
  }
  template <class Done>
  bool turns_until(const Done& done) {
    for (int i = 0; i < 3000 && !done(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      app().take_work();
      app().take_farm_news();
    }
    return done();
  }

  Farm farm_;
};

TEST_F(FarmBakes, HaveTheBitsOfABakeOfThisMachine) {
  const WorkerThread worker(farm_.options.broker, dir_ / "cache");
  const std::vector<std::byte> there = baked();
  ASSERT_TRUE(app().report.farm);
  EXPECT_EQ(app().report.farm->units, 24u) << "GEN and VIZ of six SPHLs, at a glance and in full";
  EXPECT_EQ(app().report.farm->cached, 0u);
  app().farm->used = false;
  const std::vector<std::byte> here = baked();
  EXPECT_FALSE(app().report.farm);
  EXPECT_TRUE(there == here);
}

TEST_F(FarmBakes, ThatAreStoppedLeaveNoJobBehind) {
  app().start_gen(false);
  EXPECT_TRUE(farm_.comes_to(true));
  app().job.cancel();
  EXPECT_TRUE(farm_.comes_to(false));
}

TEST_F(FarmBakes, WaitWhereTheBrokerIsLostEndAScriptAndGoOnHere) {
  ASSERT_TRUE(turns_until([&] { return app().farm->figures().has_value(); }));
  ScriptPlayer player(parse_script("gen\nsettle", "script"));
  for (int i = 0; i < 3; ++i) player.next(app());
  EXPECT_TRUE(farm_.comes_to(true));
  EXPECT_NO_THROW(player.next(app())) << "there it is still waited for";
  farm_.broker.reset();
  ASSERT_TRUE(turns_until([&] { return app().message_is_error; }));
  EXPECT_EQ(app().message, "The farm's broker at " + farm_.options.broker.endpoint +
                               " does not answer. The bake waits for it and goes on when it answers; \"Bake "
                               "here\" in the panel Farm has it done by this machine.");
  EXPECT_TRUE(app().baking());
  EXPECT_EQ(test::message_of([&] { player.next(app()); }),
            "script: line 2: the bake waits for " + farm_.options.broker.endpoint +
                ", whose broker does not answer (start it again, or leave out --broker)");
  open("Farm");
  EXPECT_TRUE(shows("It does not answer"));
  EXPECT_FALSE(shows("queued")) << "who knows";
  click_text("Bake here");
  finish_work();
  EXPECT_EQ(app().message, "GEN is done");
  EXPECT_FALSE(app().farm->used);
}

/// Its own farm, of which a test says what has become of it.
class OwnFarmBakes : public FarmBakes {
 protected:
  OwnFarmBakes() {
    options_.own_farm = {[this] { return failure_; }, [this] { failure_.clear(), ++restarts_; }};
    start(1000, 900);
    app().take_document(document("two-rooms"));
  }
  std::string failure_;
  int restarts_ = 0;
};

TEST_F(OwnFarmBakes, AreOfferedANewStartWhereTheBrokerHasEnded) {
  open("Farm");
  EXPECT_FALSE(shows("Start it again"));
  app().start_gen(false);
  failure_ = "the local broker has ended (signal 9, Killed)";
  app().take_farm_news();
  EXPECT_TRUE(app().message_is_error);
  EXPECT_THAT(app().message, HasSubstr(failure_ + ". \"Start it again\" in the panel Farm"));
  app().say("something else");
  app().take_farm_news();
  EXPECT_EQ(app().message, "something else") << "told once";
  open("Farm");
  EXPECT_TRUE(shows(failure_));
  click_text("Start it again");
  EXPECT_EQ(restarts_, 1);
  EXPECT_TRUE(app().baking()) << "it goes on";
  open("Farm");
  EXPECT_FALSE(shows("Start it again"));
  app().job.cancel();
}

TEST_F(OwnFarmBakes, EndAScriptWithWhatHasBecomeOfTheFarm) {
  ScriptPlayer player(parse_script("gen\nsettle", "script"));
  for (int i = 0; i < 3; ++i) player.next(app());
  failure_ = "no worker is left: local worker 0 has ended (exit code 42)";
  EXPECT_EQ(test::message_of([&] { player.next(app()); }), "script: line 2: " + failure_);
}

TEST_F(FarmBakes, StandInThePanelWithTheWorkersThatDoThem) {
  open("Farm");
  EXPECT_TRUE(shows(farm_.options.broker.endpoint));
  ASSERT_TRUE(turns_until([&] { return app().farm->figures().has_value(); }));
  open("Farm");
  EXPECT_TRUE(shows("0 jobs queued, 0 running"));
  EXPECT_TRUE(shows("No worker of this build"));
  EXPECT_FALSE(shows("Bake here"));
  const WorkerThread worker(farm_.options.broker, dir_ / "cache");
  ASSERT_TRUE(turns_until([&] { return app().farm->figures()->workers > 0; }));
  open("Farm");
  EXPECT_TRUE(shows("mill"));
  EXPECT_TRUE(shows("idle"));
  EXPECT_FALSE(shows("No worker"));
  click_widget("at the farm");
  EXPECT_FALSE(app().farm->used);
}

TEST_F(FarmBakes, ABrokersNameThatIsNoneIsRefusedAtOnce) {
  const farm::FarmOptions nonsense{.broker = {"nonsense", {}}};
  options_.farm = &nonsense;
  EXPECT_EQ(test::message_of([&] { start(100, 100); }),
            test::message_of([&] { majordomo::Client({.endpoint = "nonsense"}); }));
}

TEST_F(FarmBakes, AProbesEdgesOfTheGlanceStayUntilThereAreOthers) {
  take_probes();
  const probes::Probe before = app().light.set().probes[2];
  ASSERT_EQ(before.edges.size(), 2u);
  probes::Probe next = before;
  next.groups[0].reflected[0] = vec3(9);
  next.edges.clear();
  app().light.take_probe(2, next);
  EXPECT_EQ(app().light.set().probes[2].groups, next.groups);
  EXPECT_EQ(app().light.set().probes[2].edges, before.edges) << "GEN alone";
  next.edges = {before.edges[1]};
  app().light.take_probe(2, next);
  EXPECT_EQ(app().light.set().probes[2].edges, next.edges);
}

TEST_F(FarmBakes, TellTheirShareAndWhatIsLeft) {
  const WorkerThread worker(farm_.options.broker, dir_ / "cache");
  app().bake_params.path.spp = 2048;
  app().start_gen(false);
  ASSERT_TRUE(turns_until([&] { return app().job.status().stage_left.has_value(); }));
  ASSERT_TRUE(turns_until([&] { return app().farm->figures().has_value(); }));
  open("Farm");
  EXPECT_TRUE(shows("GEN: "));
  EXPECT_TRUE(shows(" s left"));
  app().job.cancel();
}

TEST_F(FarmBakes, WithoutAFarmThereIsNoPanelOfOne) {
  options_.farm = nullptr;
  start(1000, 900);
  frames(2);
  EXPECT_TRUE(shows("Scene"));
  EXPECT_FALSE(shows("Farm"));
}

class StaleBakes : public GlStage {
 protected:
  void prepare() override { options_.farm = &farm_.options, options_.probes = "off"; }
  void ready() override { app().open("builtin:two-rooms"); }
  Farm farm_;
};

TEST_F(StaleBakes, AreStoppedAndBegunAnewOnceEditsRest) {
  app().start_gen(false);
  EXPECT_TRUE(farm_.comes_to(true));
  app().edit("dim", [](Edits& e) { e.lights[0].intensity = 1; });
  app().turn({});
  EXPECT_FALSE(app().baking());
  EXPECT_TRUE(farm_.comes_to(false)) << "nobody waits for the old light";
  app().edit("name", [](Edits& e) { e.groups["lamp"] = vec3(2); });
  EXPECT_TRUE(turn_until([&] { return app().baking(); }, [&] { app().turn({}); }));
  EXPECT_TRUE(farm_.comes_to(true));
  app().edit("brighter", [](Edits& e) { e.groups["lamp"] = vec3(3); });
  app().turn({});
  EXPECT_TRUE(app().baking()) << "light follows factors of its groups without a bake";
}

}  // namespace
}  // namespace ssphh::viewer
