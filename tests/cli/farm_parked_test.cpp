// What an administrator of a farm sees of jobs that failed, does with them, and may do at all; how broker and
// worker say that they listen, read their lists anew or cannot begin.

#include <fstream>
#include <thread>

#include <fmt/format.h>

#include <ssphh/farm/ask.h>
#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/worker.h>

#include "error_message.h"
#include "here.h"
#include "temp_dir.h"
#include "tool.h"

namespace ssphh {
namespace {

using test::json_here;
using test::problem_here;
using test::text_here;

/// A broker that sets a job aside after one failure, and a worker that can do none.
class FailingFarm : public testing::Test {
 protected:
  FailingFarm()
      : broker_({.bind = endpoint_, .limits = {.attempts = 1}}, [](const majordomo::BrokerEvent&) {}),
        serving_([this] { broker_.run(); }),
        worker_({.endpoint = endpoint_, .service = "gen", .name = "w1"}),
        working_([this] {
          worker_.run(
              [](const majordomo::Job&) -> majordomo::Frames { throw std::runtime_error("no memory"); });
        }) {}
  ~FailingFarm() override {
    worker_.abandon();
    working_.join();
    broker_.stop();
    broker_.stop();
    serving_.join();
  }
  /// Leaves that many jobs of 2500 bytes aside.
  void fail(int jobs) const {
    majordomo::Client client({.endpoint = endpoint_});
    for (int i = 0; i < jobs; ++i) {
      client.submit("gen", {std::string(2500, static_cast<char>('a' + i))});
      const auto event = client.poll(10'000);
      ASSERT_TRUE(event);
      EXPECT_EQ(event->outcome, majordomo::Outcome::parked);
    }
  }
  std::vector<std::string> farm(const std::string& what, const std::vector<std::string>& more = {}) const {
    return test::joined({"farm", what, "--broker", endpoint_}, more);
  }

  const test::TempDir dir_;
  const std::string endpoint_ = "ipc://" + (dir_ / "broker").string();
  majordomo::Broker broker_;
  std::thread serving_;
  majordomo::Worker worker_;
  std::thread working_;
};

TEST_F(FailingFarm, ParkedJobsAreShownReleasedAndForgotten) {
  fail(3);
  EXPECT_EQ(text_here(farm("parked")),
            "job 1 of gen, 2.5 KB, set aside 0 s ago\n  w1: no memory\n"
            "job 2 of gen, 2.5 KB, set aside 0 s ago\n  w1: no memory\n"
            "job 3 of gen, 2.5 KB, set aside 0 s ago\n  w1: no memory");
  EXPECT_EQ(json_here(farm("parked"))["jobs"].size(), 3u);
  EXPECT_EQ(text_here(farm("drop", {"2"})), "1 job is forgotten");
  EXPECT_EQ(json_here(farm("parked"))["jobs"].size(), 2u);
  EXPECT_EQ(json_here(farm("drop", {"1", "3"})), json::Value({{"dropped", 2}}));
  EXPECT_EQ(text_here(farm("parked")), "no job is set aside");
  EXPECT_EQ(text_here(farm("release", {"--all"})), "0 jobs are queued again");
  fail(1);
  EXPECT_EQ(text_here(farm("release", {"4"})), "1 job is queued again");
}

TEST_F(FailingFarm, WorkersLeaveWhoseNameBeginsSo) {
  fail(1);  // so the worker is known
  EXPECT_EQ(text_here(farm("drain", {"--workers", "x"})), "0 workers were told to leave");
  EXPECT_EQ(json_here(farm("drain", {"--workers", "w"})), json::Value({{"told", 1}}));
}

TEST_F(FailingFarm, QuestionsThatCannotBeAnsweredSayWhy) {
  majordomo::Client client({.endpoint = endpoint_});
  EXPECT_EQ(test::message_of([&] { farm::ask(client, "mmi.nothing", "", {}); }),
            "mmi.nothing: the broker does not know it (is it an older one?)");
  EXPECT_EQ(test::message_of([&] { farm::ask_json(client, "mmi.drain", {}); }),
            "mmi.drain: the broker's answer is no JSON object");
  EXPECT_EQ(problem_here(farm("drop", {"7"})), "mmi.drop: job 7 is not set aside");
  EXPECT_EQ(problem_here(farm("release")),
            "jobs: none are named (give their numbers (`ssphh farm parked`) or --all)");
}

// As a process: SIGHUP has the list read again, and what a key may do is what the list says.
TEST(BrokerProcess, KeysDecideWhoMayAdminister) {
  const test::TempDir dir;
  const std::string folder = dir / "keys", endpoint = "ipc://" + (dir / "broker").string();
  json_here({"farm", "keygen", "ann", "--role", "client", "--keys", folder});
  json_here({"farm", "keygen", "eve", "--role", "admin", "--keys", folder});
  test::ToolProcess broker({"broker", "--bind", endpoint, "--keys", folder});
  ASSERT_TRUE(broker.wait_for_stderr("broker-ready"));
  const auto drain = [&](const char* key) {
    return std::vector<std::string>{"farm", "drain", "--broker", endpoint, "--keys", folder, "--key", key};
  };
  EXPECT_EQ(problem_here(drain("ann")), "mmi.drain: this key has no admin role (make one with --role admin)");
  EXPECT_EQ(text_here(drain("eve")), "0 workers were told to leave");
  broker.signal(SIGHUP);
  EXPECT_TRUE(broker.wait_for_stderr("allow-list-read keys=2"));
  broker.signal(SIGTERM);
  EXPECT_EQ(broker.wait().exit_code, 0);
}

TEST(BrokerProcess, WithJsonAllIsLinesOnStdout) {
  const test::TempDir dir;
  test::ToolProcess broker({"broker", "--bind", "ipc://" + (dir / "broker").string(), "--json"});
  for (int i = 0; i < 1000 && !std::filesystem::exists(dir / "broker"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  text_here({"farm", "status", "--broker", "ipc://" + (dir / "broker").string()});  // it listens to signals
  broker.signal(SIGTERM);
  const test::ToolResult result = broker.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out,
            fmt::format(R"({{"event":"broker-ready","level":"info","endpoint":"ipc://{}"}})"
                        "\n"
                        R"({{"event":"broker-draining","level":"info","running":"0","queued":"0"}})"
                        "\n"
                        R"({{"event":"broker-ended","level":"info"}})"
                        "\n",
                        (dir / "broker").string()));
  EXPECT_EQ(result.err, "");
}

TEST(WorkerCommand, WhatWouldFailAgainIsExitCode42) {
  const std::vector<std::string> command = {"worker", "--broker", "nonsense"};
  const test::HereResult text = test::run_here(command);
  EXPECT_EQ(text.exit_code, 42);
  EXPECT_EQ(text.out, "");
  EXPECT_EQ(
      json_here(command, 42),
      json::Value({{"error", "--keys nonsense: is no endpoint (write tcp://HOST:PORT or ipc://PATH)"}}));
}

TEST(WorkerCommand, ToldToLeaveSaysWhatItDid) {
  CancelToken token;
  token.request();
  const test::TempDir dir;
  const std::vector<std::string> command = {
      "worker", "--broker", "ipc://" + (dir / "none").string(), "--cache", dir / "c", "--threads", "1"};
  const test::HereResult result = test::run_here(command, {nullptr, &token});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, testing::MatchesRegex("0 jobs, busy 0.0 s of [0-9].[0-9] s\n"));
}

}  // namespace
}  // namespace ssphh
