/// `ssphh broker` keeps the limits that it is given, and `ssphh farm` shows what it tells; peers run here.

#include <thread>

#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/worker.h>

#include "farm_process.h"

namespace ssphh::test {
namespace {

using majordomo::Client;
using majordomo::Frames;
using majordomo::Job;
using majordomo::Outcome;
using testing::HasSubstr;

/// Does what the body says: "done", "fail" (on this worker), or "wait" until nobody wants it any more.
Frames obey(const Job& job) {
  const std::string what = job.body.at(0).substr(0, 4);
  if (what == "fail") throw std::runtime_error("no memory");
  while (what == "wait" && !job.cancel->requested())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  job.control().check();
  return job.body;
}

class Worker {
 public:
  Worker(const std::string& endpoint, const std::string& name)
      : worker_({.endpoint = endpoint, .service = "gen", .name = name}),
        thread_([this] { worker_.run(obey); }) {}
  ~Worker() {
    worker_.abandon();
    thread_.join();
  }

 private:
  majordomo::Worker worker_;
  std::thread thread_;
};

/// What becomes of one request.
majordomo::ClientEvent asked(const std::string& endpoint, std::string body, majordomo::Millis deadline = 0) {
  Client client({.endpoint = endpoint});
  client.submit("gen", {std::move(body)}, {.deadline = deadline});
  return client.poll(10'000).value_or(majordomo::ClientEvent{.outcome = Outcome::no_answer});
}

TEST(BrokerCommand, KeepsALimitOfAClientsMegabytes) {
  const FarmProcesses farm(0, {"--max-client-mb", "1"});
  EXPECT_EQ(asked(farm.endpoint(), std::string((1 << 20) + 1, 'x')).outcome, Outcome::refused);
  EXPECT_EQ(asked(farm.endpoint(), std::string(1 << 20, 'x'), 50).outcome, Outcome::expired) << "it waited";
}

TEST(BrokerCommand, GivesAnAttemptSoManySecondsAndAJobSoManyAttempts) {
  const FarmProcesses farm(0, {"--attempt-timeout", "0.12", "--attempts", "1"});
  const Worker worker(farm.endpoint(), "slow");
  const auto event = asked(farm.endpoint(), "wait");
  EXPECT_EQ(event.outcome, Outcome::parked);
  EXPECT_EQ(event.attempts, 1);
  EXPECT_THAT(event.reason, testing::ContainsRegex("slow: no answer within [1-9][0-9][0-9]+ ms"));
}

TEST(FarmCommand, ShowsWorkersQueuesAndParkedJobs) {
  const FarmProcesses farm(0, {"--attempts", "1"});
  std::vector<std::unique_ptr<Worker>> workers;
  for (const char* name : {"a", "b", "c"}) workers.push_back(std::make_unique<Worker>(farm.endpoint(), name));
  for (int i = 0; i < 5; ++i) ASSERT_EQ(asked(farm.endpoint(), "done").outcome, Outcome::ok);
  EXPECT_EQ(asked(farm.endpoint(), "fail" + std::string(2496, 'x')).outcome, Outcome::parked);
  Client client({.endpoint = farm.endpoint()});
  for (int i = 0; i < 2; ++i) client.submit("gen", {"wait"});
  for (int i = 0; i < 4; ++i) client.submit("none", {"x"});
  const auto registered = [&](const std::string& name) {
    return client.call("mmi.workers", {""}, {.deadline = 5000}).at(1).find(name) != std::string::npos;
  };
  for (const char* name : {"\"a\"", "\"b\"", "\"c\""})
    for (int i = 0; i < 1000 && !registered(name); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));

  const std::string status = run_tool({"farm", "status", "--broker", farm.endpoint()}).out;
  EXPECT_THAT(status, HasSubstr("3 workers (1 idle), 4 jobs queued, 2 running, "));
  EXPECT_THAT(status, HasSubstr(" 0 retries, 1 parked\n"));
  const auto row = [](const std::string& name, const std::string& numbers) {
    return "\n" + name + std::string(48 - name.size(), ' ') + " " + numbers;
  };
  EXPECT_THAT(status, HasSubstr(row("gen", "      3      1       0         6")));
  EXPECT_THAT(status, HasSubstr(row("none", "      0      0       4         0")));

  const std::string parked = run_tool({"farm", "parked", "--broker", farm.endpoint()}).out;
  EXPECT_THAT(parked, testing::MatchesRegex("job [0-9]+ of gen, 2.5 KB, set aside [0-9]+ s ago\n"
                                            "  [abc]: no memory\n"));
}

}  // namespace
}  // namespace ssphh::test
