// `ssphh farm` against a broker that runs here: what it shows is what the broker tells.

#include <thread>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/worker.h>

#include "here.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::json_here;
using test::problem_here;
using test::text_here;
using testing::AllOf;
using testing::HasSubstr;

class Farm : public testing::Test {
 protected:
  Farm()
      : broker_({.bind = endpoint_}),
        serving_([this] { broker_.run(); }),
        worker_({.endpoint = endpoint_, .service = "gen", .name = "w1"}),
        working_([this] { worker_.run([](const majordomo::Job& job) { return job.body; }); }) {}
  ~Farm() override {
    worker_.abandon();
    working_.join();
    broker_.stop();
    broker_.stop();
    serving_.join();
  }
  void finish(int jobs) const {
    majordomo::Client client({.endpoint = endpoint_});
    for (int i = 0; i < jobs; ++i) client.call("gen", {"x"}, {.deadline = 5000}, {});
  }
  const json::Value status() const { return json_here({"farm", "status", "--broker", endpoint_}); }

  const test::TempDir dir_;
  const std::string endpoint_ = "ipc://" + (dir_ / "broker").string();
  majordomo::Broker broker_;
  std::thread serving_;
  majordomo::Worker worker_;
  std::thread working_;
};

TEST_F(Farm, StatusShowsCountsServicesAndWorkers) {
  finish(3);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto since = [](const json::Value& status) {
    return status["workers"][0]["since_ms"].number() / 1000;
  };
  const json::Value before = status();
  const std::string text = text_here({"farm", "status", "--broker", endpoint_});
  const json::Value after = status();
  EXPECT_EQ(before["stats"]["services"][0]["finished"], 3);
  ASSERT_EQ(before["workers"].size(), 1u);
  EXPECT_THAT(
      text,
      testing::MatchesRegex(
          "1 worker \\(1 idle\\), 0 jobs queued, 0 running, [0-9]+ finished, 0 retries, 0 parked\n(.|\n)*"));
  EXPECT_THAT(text, HasSubstr(fmt::format("\n{:<48} {:>7} {:>6} {:>7} {:>9}\n", "gen", 1, 1, 0, 3)));
  const std::string row = text.substr(text.find("\nw1") + 1);
  EXPECT_THAT(row, testing::EndsWith(fmt::format("{:>7}  gen", 3)));
  const double shown = std::stod(row.substr(40));
  EXPECT_GE(shown, since(before) - 0.051);
  EXPECT_LE(shown, since(after) + 0.051);
  EXPECT_THAT(text, testing::Not(HasSubstr("jobs/s"))) << "one look tells no rate";
}

TEST_F(Farm, TopTellsTheRateFromTheSecondLookOn) {
  finish(1);
  const std::string text =
      text_here({"farm", "top", "--broker", endpoint_, "--count", "2", "--interval", "0.1"});
  const std::string clear = "\x1b[H\x1b[2J";
  const std::size_t second = text.find(clear, 1);
  ASSERT_NE(second, std::string::npos);
  EXPECT_THAT(text.substr(0, second), testing::Not(HasSubstr("jobs/s")));
  EXPECT_THAT(text.substr(second), HasSubstr("\n0.00 jobs/s\n")) << "its own questions are no jobs";
  EXPECT_EQ(text.find(clear, second + 1), std::string::npos);
}

TEST_F(Farm, JobsAreNamedToReleaseOrDropThem) {
  EXPECT_EQ(text_here({"farm", "parked", "--broker", endpoint_}), "no job is set aside");
  EXPECT_EQ(json_here({"farm", "release", "--all", "--broker", endpoint_}), json::Value({{"released", 0}}));
  EXPECT_EQ(text_here({"farm", "drop", "--all", "--broker", endpoint_}), "0 jobs are forgotten");
  EXPECT_THAT(problem_here({"farm", "drop", "--broker", endpoint_}), HasSubstr("jobs: none are named"));
  EXPECT_THAT(problem_here({"farm", "release", "7", "--broker", endpoint_}),
              HasSubstr("job 7 is not set aside"));
}

TEST(FarmKeys, AreMadeWithTheRightsOfTheirRole) {
  const test::TempDir dir;
  const std::string folder = dir / "keys";
  const json::Value first = json_here({"farm", "keygen", "ann", "--role", "client", "--keys", folder});
  EXPECT_EQ(first, json::Value({{"folder", folder}, {"made", {"broker", "ann"}}, {"role", "client"}}));
  const json::Value second = json_here({"farm", "keygen", "box", "--role", "worker", "--keys", folder});
  EXPECT_EQ(second["made"], json::Value::array({"box"})) << "the broker has one";
  EXPECT_THAT(text_here({"farm", "keygen", "eve", "--role", "admin", "--keys", folder}),
              testing::StartsWith(
                  folder + ": made eve.key, which may be a admin\ngive its user eve.key and broker.pub"));
  for (const char* file : {"broker.key", "broker.pub", "ann.key", "box.key", "eve.key"})
    EXPECT_TRUE(std::filesystem::exists(dir / "keys" / file)) << file;
  const std::string allowed = read_text_file(dir / "keys/allow.txt");
  EXPECT_THAT(allowed, AllOf(testing::ContainsRegex("ann [^\n]*client worker:ssphh.blobs.\\*"),
                             testing::ContainsRegex("box [^\n]*client worker:ssphh.jobs.\\*"),
                             testing::ContainsRegex("eve [^\n]*client admin")));
  EXPECT_EQ(std::filesystem::status(folder).permissions(), std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace ssphh
