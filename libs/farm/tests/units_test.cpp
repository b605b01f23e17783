/// How units are cut into jobs, handed to workers and counted, with a worker that answers anything.

#include <algorithm>
#include <atomic>

#include <gtest/gtest.h>

#include <ssphh/farm/dispatch.h>
#include <ssphh/farm/engine.h>

#include "broker_thread.h"
#include "error_message.h"

namespace ssphh::farm {
namespace {

using ssphh::test::message_of;
using test::BrokerThread;
using test::Quiet;
using test::ServiceThread;

/// A result without probes that took so long.
std::string answer(double seconds) {
  return encode_result({ProbeJobResult{}, {seconds, 0, "w"}}, ContentType::json);
}

/// Units that say which they are, as "GROUP:UNIT UNIT...".
UnitGroup numbered(std::size_t group, std::size_t count, std::vector<std::string>& done) {
  const auto name = [group](std::span<const std::size_t> units) {
    std::string text = std::to_string(group) + ":";
    for (const std::size_t unit : units) text += std::to_string(unit) + " ";
    return text;
  };
  return {count, name,
          [name, &done](std::span<const std::size_t> units, JobResult) { done.push_back(name(units)); }};
}

struct Units : testing::Test {
  Units() { options.broker = broker.address(); }
  void run(const std::vector<UnitGroup>& groups) {
    dispatch(options, groups, report, [this](std::size_t units, const FarmReport&) { told.push_back(units); },
             {});
  }
  ServiceThread worker(majordomo::Handler handler) {
    return {options.broker, job_service(), std::move(handler)};
  }

  Quiet quiet;
  BrokerThread broker;
  FarmOptions options;
  FarmReport report;
  std::vector<std::string> done;
  std::vector<std::size_t> told;
};

// Four single units at first, as nothing is known. A unit takes 0.25 s, so that six fill the 1.5 s of a job,
// and less than half of what is left goes to the only worker.
TEST_F(Units, JobsGrowToTheTimeAskedForAndShrinkTowardTheEnd) {
  std::vector<std::string> asked;
  {
    const ServiceThread serving = worker([&](const majordomo::Job& job) {
      asked.push_back(job.body.at(0));
      const auto units = std::ranges::count(job.body[0], ' ');
      return majordomo::Frames{answer(0.25 * static_cast<double>(units))};
    });
    run({numbered(0, 20, done)});
  }
  const std::vector<std::string> wanted = {
      "0:0 ", "0:1 ", "0:2 ", "0:3 ", "0:4 5 6 7 8 9 ", "0:10 11 12 13 14 ", "0:15 16 17 ", "0:18 ", "0:19 "};
  EXPECT_EQ(asked, wanted);
  EXPECT_EQ(done, wanted);
  EXPECT_EQ(told, (std::vector<std::size_t>{1, 1, 1, 1, 6, 5, 3, 1, 1}));
  EXPECT_EQ(report.jobs, 9u);
  EXPECT_EQ(report.retries, 0u);
  EXPECT_DOUBLE_EQ(report.compute_seconds, 5);
  EXPECT_GT(report.seconds, 0);
}

// Two for each worker, so that none waits for the next one; four where workers are few.
TEST_F(Units, AreUnderWayTwoForEachWorker) {
  std::atomic<std::size_t> made{0};
  const auto handler = [&](const majordomo::Job&) {
    for (int i = 0; i < 2000 && made < 6; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return majordomo::Frames{answer(10)};
  };
  const ServiceThread first = worker(handler), second = worker(handler), third = worker(handler);
  majordomo::ClientOptions client_options;
  client_options.endpoint = options.broker.endpoint;
  majordomo::Client client(client_options);
  while (client.call("mmi.stats", {""}).at(1).find("\"workers\":3") == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::size_t most = 0;
  UnitGroup group = numbered(0, 12, done);
  group.body = [&, name = group.body](std::span<const std::size_t> units) {
    most = std::max(most, ++made - done.size());
    return name(units);
  };
  run({group});
  EXPECT_EQ(most, 6u);
  EXPECT_EQ(report.jobs, 12u);
  EXPECT_EQ(report.workers, 3);
}

TEST_F(Units, TheFirstGroupComesFirst) {
  const ServiceThread serving = worker([&](const majordomo::Job&) { return majordomo::Frames{answer(10)}; });
  run({numbered(0, 3, done), numbered(1, 0, done), numbered(2, 3, done)});
  EXPECT_EQ(done, (std::vector<std::string>{"0:0 ", "0:1 ", "0:2 ", "2:0 ", "2:1 ", "2:2 "}));
  EXPECT_EQ(report.jobs, 6u);
  EXPECT_LE(report.workers, 1);
}

TEST_F(Units, ReportsAddUp) {
  const ServiceThread serving = worker([&](const majordomo::Job&) { return majordomo::Frames{answer(2)}; });
  run({numbered(0, 1, done)});
  const double first = report.seconds;
  run({numbered(0, 1, done)});
  EXPECT_EQ(report.jobs, 2u);
  EXPECT_EQ(report.compute_seconds, 4);
  EXPECT_GT(report.seconds, first);
}

TEST_F(Units, WhatIsWaitedForIsSaidOnce) {
  std::atomic<bool> said{false}, ended{false};
  std::vector<std::string> lines;
  set_log_level(LogLevel::warning);
  const LogSink before = set_log_sink([&](LogLevel, const std::string& line) {
    lines.push_back(line);
    said = true;
  });
  options.patience = 0.1;
  std::thread late([&] {
    for (int i = 0; i < 2000 && !said; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const ServiceThread serving = worker([&](const majordomo::Job&) { return majordomo::Frames{answer(1)}; });
    while (!ended) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  });
  run({numbered(0, 2, done)});
  ended = true;
  late.join();
  set_log_sink(before);
  EXPECT_EQ(lines, std::vector<std::string>{"the broker has no worker of this build (engine " + engine_id() +
                                            "); jobs wait for one"});
}

TEST_F(Units, WhatAWorkerCouldNotDoIsTriedAgainAndCounted) {
  std::atomic<int> calls = 0;
  const ServiceThread serving = worker([&](const majordomo::Job&) {
    if (++calls == 1) throw std::runtime_error("a full disk");
    return majordomo::Frames{answer(1)};
  });
  run({numbered(0, 1, done)});
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(report.jobs, 1u);
  EXPECT_EQ(report.retries, 1u);
}

TEST_F(Units, FailuresAreToldWithTheirReason) {
  {
    const ServiceThread serving =
        worker([&](const majordomo::Job&) -> majordomo::Frames { throw Error("here", "cannot be done"); });
    EXPECT_EQ(message_of([&] { run({numbered(0, 3, done)}); }),
              "the farm: a job of 1 unit ended as \"failed\": " + test::name_of_this_process() +
                  ": here: cannot be done");
  }
  {
    const ServiceThread serving = worker([&](const majordomo::Job&) { return majordomo::Frames{}; });
    EXPECT_TRUE(message_of([&] { run({numbered(0, 3, done)}); }).starts_with("result: is not valid JSON"));
  }
  EXPECT_TRUE(done.empty());
  EXPECT_TRUE(told.empty());
}

}  // namespace
}  // namespace ssphh::farm
