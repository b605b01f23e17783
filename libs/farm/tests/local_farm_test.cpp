/// A farm of this machine, with a program in place of the tool that tells what it was started with.

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/farm/local_farm.h>

#include "error_message.h"
#include "temp_dir.h"

namespace ssphh::farm {
namespace {

namespace fs = std::filesystem;
using ssphh::test::message_of;
using ssphh::test::TempDir;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Far longer than it takes, so that only what never comes is a failure.
bool comes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 3000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

class LocalFarmTest : public testing::Test {
 protected:
  /// A program that prints its arguments and goes on with `rest`.
  void write_tool(const std::string& rest) {
    std::ofstream(options_.tool) << "#!/bin/sh\necho \"$@\"\n" << rest << "\n";
    fs::permissions(options_.tool, fs::perms::owner_all);
  }
  static fs::path folder(const LocalFarm& farm) {
    return fs::path(farm.address().endpoint.substr(std::string("ipc://").size())).parent_path();
  }
  static std::string started_with(const LocalFarm& farm, const std::string& log) {
    EXPECT_TRUE(comes_true([&] { return text_of(folder(farm) / log).ends_with("\n"); })) << log;
    return text_of(folder(farm) / log);
  }
  static std::string of_worker(const LocalFarm& farm, int threads, int worker, std::uint64_t mebibytes) {
    return fmt::format(
        "worker --broker {} --renderer path --slots 1 --threads {} --name local:{} --cache /some/where "
        "--cache-size {} --config none\n",
        farm.address().endpoint, threads, worker, mebibytes);
  }
  /// Keeps the messages instead of showing them.
  void SetUp() override {
    options_.tool = dir_ / "tool";
    options_.cache = "/some/where";
    options_.look = std::chrono::milliseconds(4);
    set_log_sink([this](LogLevel level, const std::string& message) {
      const std::lock_guard lock(mutex_);
      (level == LogLevel::error ? errors_ : warnings_).push_back(message);
    });
  }
  void TearDown() override { set_log_sink({}); }

  TempDir dir_;
  LocalFarmOptions options_;
  std::mutex mutex_;
  std::vector<std::string> errors_, warnings_;
};

TEST_F(LocalFarmTest, StartsABrokerAndTwoWorkersThatShareTheMachine) {
  write_tool("exec sleep 100");
  fs::path folder_of_farm;
  std::vector<int> pids;
  {
    const LocalFarm farm(options_);
    folder_of_farm = folder(farm);
    pids = farm.worker_pids();
    ASSERT_EQ(pids.size(), 2u);
    EXPECT_FALSE(farm.address().security);
    EXPECT_EQ(farm.address().endpoint, "ipc://" + (folder_of_farm / "broker").string());
    EXPECT_EQ(started_with(farm, "broker.log"),
              "broker --bind " + farm.address().endpoint + " --attempts 5 --config none\n");
    const int threads = std::max(1, thread_count() / 2);
    EXPECT_EQ(started_with(farm, "worker-0.log"), of_worker(farm, threads, 0, 20 << 10));
    EXPECT_EQ(started_with(farm, "worker-1.log"), of_worker(farm, threads, 1, 20 << 10));
    EXPECT_EQ(fs::status(folder_of_farm / "worker-0.log").permissions(),
              fs::perms::owner_read | fs::perms::owner_write);
    for (const int pid : pids) EXPECT_EQ(::getpgid(pid), pid) << "Ctrl-C is for the parent alone";
    EXPECT_EQ(farm.worker_pids(), pids);
  }
  EXPECT_FALSE(fs::exists(folder_of_farm));
  for (const int pid : pids) EXPECT_EQ(::kill(pid, 0), -1) << "outlives its farm";
  EXPECT_TRUE(warnings_.empty());
  EXPECT_TRUE(errors_.empty());
}

TEST_F(LocalFarmTest, LogsAreKeptWhereThereIsNoStdin) {
  write_tool("exec sleep 100");
  options_.workers = options_.threads = 1;
  const int kept = ::dup(STDIN_FILENO);
  ::close(STDIN_FILENO);
  const LocalFarm farm(options_);
  if (kept >= 0) ::dup2(kept, STDIN_FILENO), ::close(kept);
  EXPECT_EQ(started_with(farm, "worker-0.log"), of_worker(farm, 1, 0, 20 << 10));
}

TEST_F(LocalFarmTest, WorkersHaveThreadsAndCacheAsTheyAreAskedFor) {
  write_tool("exec sleep 100");
  options_.threads = 5;
  for (const auto& [bytes, mebibytes] :
       {std::pair{(std::uint64_t{7} << 20) + 12345, 7}, {std::uint64_t{1000}, 1}}) {
    options_.workers = 3;
    options_.cache_bytes = bytes;
    const LocalFarm farm(options_);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(started_with(farm, fmt::format("worker-{}.log", i)),
                of_worker(farm, 5, i, static_cast<std::uint64_t>(mebibytes)));
    }
  }
}

TEST_F(LocalFarmTest, ThreadsAreTheMachinesSharedOutOneAtLeastOrThoseAskedFor) {
  write_tool("exec sleep 100");
  const auto expect_threads = [&](int workers, int asked, int threads) {
    options_.workers = workers, options_.threads = asked;
    const LocalFarm farm(options_);
    EXPECT_EQ(started_with(farm, "worker-0.log"), of_worker(farm, threads, 0, 20 << 10)) << workers;
  };
  expect_threads(thread_count() + 1, 0, 1);
  expect_threads(1, 0, thread_count());
  expect_threads(1, 1, 1);
}

TEST_F(LocalFarmTest, AWorkerThatLivesOutlivesOneThatIsGivenUp) {
  const fs::path end = dir_ / "end";
  write_tool("[ $1 = worker ] || exec sleep 100\ncase \"$*\" in *local:0*) until [ -e " + end.string() +
             " ]; do sleep 0.01; done;; esac");
  const LocalFarm farm(options_);
  const int first = farm.worker_pids().at(0);
  ASSERT_TRUE(comes_true([&] { return farm.worker_pids().at(1) == -1; }));
  EXPECT_EQ(farm.worker_pids().at(0), first);
  const auto warned = [&] {
    const std::lock_guard lock(mutex_);
    return std::ranges::count_if(
        warnings_, [](const std::string& text) { return text.starts_with("local worker 0 has ended"); });
  };
  EXPECT_EQ(warned(), 0);
  std::ofstream(end) << "now";
  EXPECT_TRUE(comes_true([&] { return farm.worker_pids() == std::vector<int>{-1, -1}; }));
  EXPECT_TRUE(farm.failure().starts_with("no worker is left: local worker 0 has ended"))
      << "it is not started again: the other has used up their restarts";
  EXPECT_EQ(warned(), 0) << "whoever asked for the farm tells";
}

TEST_F(LocalFarmTest, WorkersThatDieAreStartedAgainEightTimesEach) {
  write_tool("[ $1 = worker ] || exec sleep 100");
  const LocalFarm farm(options_);
  const auto given_up = [&] { return farm.worker_pids() == std::vector<int>{-1, -1}; };
  ASSERT_TRUE(comes_true(given_up));
  std::size_t starts = 0;
  for (const char* log : {"worker-0.log", "worker-1.log"}) {
    const std::string text = text_of(folder(farm) / log);
    starts += static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }
  EXPECT_EQ(starts, 2u + 16u);
  const std::lock_guard lock(mutex_);
  ASSERT_EQ(warnings_.size(), 17u) << "the last one is for the caller to tell";
  EXPECT_EQ(std::ranges::count(warnings_, "local worker 0 has ended (exit code 0); it is started again") +
                std::ranges::count(warnings_, "local worker 1 has ended (exit code 0); it is started again"),
            16);
  EXPECT_EQ(std::ranges::count_if(warnings_,
                                  [&](const std::string& text) {
                                    return text.find("ended (exit code 0); its log ends: ") != text.npos;
                                  }),
            1);
}

TEST_F(LocalFarmTest, AWorkerThatWouldFailAgainIsToldWithTheEndOfItsLogAndNotStartedAgain) {
  write_tool("[ $1 = worker ] || exec sleep 100\necho 'error: no room'\nexit 42");
  options_.workers = 1;
  LocalFarm farm(options_);
  ASSERT_TRUE(comes_true([&] { return !farm.failure().empty(); }));
  const std::string told = "local worker 0 has ended (exit code 42); its log ends: " +
                           of_worker(farm, thread_count(), 0, 20 << 10) + "error: no room";
  EXPECT_EQ(farm.failure(), "no worker is left: " + told);
  EXPECT_EQ(farm.worker_pids(), std::vector<int>{-1});
  write_tool("exec sleep 100");
  farm.restart();
  EXPECT_EQ(farm.failure(), "");
  EXPECT_GT(farm.worker_pids()[0], 0);
}

TEST_F(LocalFarmTest, ABrokerThatWasKilledIsStartedAgainWhereThatIsAskedFor) {
  write_tool("exec sleep 100");
  LocalFarm farm(options_);
  const std::vector<int> workers = farm.worker_pids();
  started_with(farm, "broker.log");
  const int broker = farm.broker_pid();
  ::kill(broker, SIGKILL);
  ASSERT_TRUE(comes_true([&] { return farm.broker_pid() < 0; }));
  EXPECT_TRUE(
      farm.failure().starts_with("the local broker has ended (signal 9, Killed); its log ends: broker"))
      << farm.failure();
  farm.restart();
  EXPECT_EQ(farm.failure(), "");
  EXPECT_GT(farm.broker_pid(), 0);
  EXPECT_NE(farm.broker_pid(), broker);
  EXPECT_EQ(farm.worker_pids(), workers) << "those that live are left alone";
}

TEST_F(LocalFarmTest, ABrokerThatEndsIsAFailureWithTheEndOfItsLog) {
  write_tool("[ $1 = broker ] || exec sleep 100\nprintf 'begin%01500dend' 7");
  const LocalFarm farm(options_);
  const std::vector<int> workers = farm.worker_pids();
  ASSERT_TRUE(comes_true([&] { return !farm.failure().empty(); }));
  std::this_thread::sleep_for(5 * options_.look);
  EXPECT_EQ(farm.worker_pids(), workers) << "those that live are left alone";
  EXPECT_EQ(farm.failure(),
            "the local broker has ended (exit code 0); its log ends: " + std::string(996, '0') + "7end");
  const std::lock_guard lock(mutex_);
  EXPECT_TRUE(warnings_.empty() && errors_.empty()) << "whoever asked for the farm tells";
}

TEST_F(LocalFarmTest, NumberOfWorkersHasLimits) {
  for (const int workers : {-1, 0, 1025}) {
    options_.workers = workers;
    EXPECT_EQ(message_of([&] { LocalFarm farm(options_); }), "--local: must be 1 to 1024 workers");
  }
  write_tool("exec sleep 100");
  options_.workers = 1;
  EXPECT_NO_THROW(LocalFarm{options_});
}

}  // namespace
}  // namespace ssphh::farm
