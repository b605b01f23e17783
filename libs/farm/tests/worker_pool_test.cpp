#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/farm/engine.h>
#include <ssphh/farm/job_codec.h>
#include <ssphh/farm/worker_pool.h>

#include "broker_thread.h"
#include "error_message.h"
#include "farm_fixtures.h"

namespace ssphh::farm {
namespace {

using ssphh::test::message_of;
using ssphh::test::TempDir;
using test::BrokerThread;
using test::PackedScene;
using test::Quiet;
using test::ServiceThread;

WorkerPoolOptions pool_options(const BrokerAddress& broker, const TempDir& dir) {
  WorkerPoolOptions options;
  options.broker = broker;
  options.cache = dir.path();
  options.cache_bytes = 64 << 20;
  return options;
}

TEST(WorkerPool, HasOneToAThousandAndTwentyFourSlots) {
  for (const int slots : {-1, 0, 1025}) {
    WorkerPoolOptions options;
    options.slots = slots;
    EXPECT_EQ(message_of([&] { run_workers(options, {}); }), "slots: must be 1 to 1024");
  }
}

TEST(WorkerPool, LeavesWhenItHasHadNoJobForAsLongAsItWasTold) {
  const Quiet quiet;
  const TempDir dir;
  const BrokerThread broker;
  WorkerPoolOptions options = pool_options(broker.address(), dir);
  options.slots = 2;
  options.idle_exit = 0.1;
  const Stopwatch all;
  const WorkerPoolReport report = run_workers(options, {});
  EXPECT_GE(all.seconds(), 0.1)
      << "its own seconds begin when all is set up, on a busy machine later than its wait";
  EXPECT_EQ(report.jobs, 0u);
  EXPECT_EQ(report.busy_seconds, 0);
  EXPECT_GT(report.seconds, 0);
  EXPECT_LE(report.seconds, all.seconds());
}

TEST(WorkerPool, IsReadyOnceItsCacheIsThereAndNotWithoutOne) {
  const TempDir dir;
  const BrokerThread broker;
  WorkerPoolOptions options = pool_options(broker.address(), dir);
  options.idle_exit = 0.01;
  const auto logged = [&](const std::filesystem::path& cache, const std::string& problem) {
    options.cache = cache;
    testing::internal::CaptureStderr();
    EXPECT_THAT(message_of([&] { run_workers(options, {}); }), testing::HasSubstr(problem));
    return testing::internal::GetCapturedStderr();
  };
  write_file(dir / "file", "no folder");
  EXPECT_THAT(logged(dir / "file" / "cache", "the cache cannot be made"),
              testing::Not(testing::HasSubstr("worker-ready")));
  EXPECT_THAT(logged(dir / "cache", "no error"),
              testing::HasSubstr("worker-ready broker=" + options.broker.endpoint + " service=" +
                                 job_service() + " slots=1 cache=" + (dir / "cache").string() + "\n"));
  EXPECT_TRUE(std::filesystem::is_directory(dir / "cache"));
}

// The first job waits for its scene for longer than the pool may be idle; the second is done nevertheless.
TEST(WorkerPool, IsNotIdleWhileAJobRuns) {
  const Quiet quiet;
  const TempDir dir;
  const BrokerThread broker;
  const PackedScene packed("cornell");
  const ServiceThread slow(broker.address(), blob_service(packed.package.id),
                           [](const majordomo::Job&) -> majordomo::Frames {
                             std::this_thread::sleep_for(std::chrono::milliseconds(400));
                             throw Error("the scene", "is gone");
                           });
  WorkerPoolReport report;
  std::thread pool([&] {
    WorkerPoolOptions options = pool_options(broker.address(), dir);
    options.idle_exit = 0.25;
    report = run_workers(options, {});
  });
  {
    majordomo::ClientOptions client_options;
    client_options.endpoint = broker.address().endpoint;
    majordomo::Client client(client_options);
    ProbeJob job = test::gen_job(PackedScene("gallery1"));
    job.scene = packed.ref();
    client.submit(job_service(), {encode_job(job, ContentType::json)});
    majordomo::RequestOptions second;
    second.deadline = 20'000;
    const std::string said = message_of([&] { client.call(job_service(), {"what?"}, second); });
    EXPECT_NE(said.find("job: is not valid JSON"), std::string::npos) << said;
  }
  pool.join();
  EXPECT_GE(report.jobs, 1u);
  EXPECT_GE(report.busy_seconds, 0.4);
  EXPECT_LE(report.busy_seconds, report.seconds);
}

/// The worker's name in the result of a job that one of the pool's slots does.
std::string name_in_result(const std::string& name, int slots) {
  const TempDir dir;
  const BrokerThread broker;
  const PackedScene packed("gallery1");
  const BlobServer server(broker.address(), packed.package);
  CancelToken stop;
  std::thread pool([&] {
    WorkerPoolOptions options = pool_options(broker.address(), dir);
    options.name = name;
    options.slots = slots;
    run_workers(options, {nullptr, &stop});
  });
  majordomo::ClientOptions client_options;
  client_options.endpoint = broker.address().endpoint;
  majordomo::Client client(client_options);
  const majordomo::Frames reply =
      client.call(job_service(), {encode_job(test::gen_job(packed), ContentType::json)});
  stop.request();
  pool.join();
  EXPECT_EQ(content_type(reply.at(0)), ContentType::json) << "answers as it was asked";
  return decode_result(reply.at(0)).stats.worker;
}

/// Jobs for a pool of one slot called "w".
class PoolWithAClient {
 public:
  explicit PoolWithAClient(const PackedScene& packed)
      : server_(broker_.address(), packed.package), pool_([this] {
          WorkerPoolOptions options = pool_options(broker_.address(), dir_);
          options.name = "w";
          run_workers(options, {nullptr, &stop_});
        }) {}
  ~PoolWithAClient() {
    stop_.request();
    pool_.join();
  }
  void call(const std::string& body) {
    majordomo::ClientOptions options;
    options.endpoint = broker_.address().endpoint;
    majordomo::Client(options).call(job_service(), {body});
  }

 private:
  TempDir dir_;
  BrokerThread broker_;
  BlobServer server_;
  CancelToken stop_;
  std::thread pool_;
};

TEST(WorkerPool, LogsOfEachJobWhoDidItAndWhatItTook) {
  std::mutex mutex;
  std::vector<std::string> lines;
  set_log_sink([&](LogLevel level, const std::string& line) {
    const std::lock_guard lock(mutex);
    if (line.starts_with("job=")) lines.push_back(std::string(name_of(level)) + " " + line);
  });
  const PackedScene packed("gallery1");
  {
    PoolWithAClient pool(packed);
    pool.call(encode_job(test::gen_job(packed), ContentType::json));
    ProbeJob viz = test::viz_job(packed);
    viz.probes = {0};
    pool.call(encode_job(viz, ContentType::binary));
    TileJob tiles = test::tile_job(packed);
    tiles.tiles.push_back({0, 8, 8, 8});
    pool.call(encode_job(tiles, ContentType::binary));
    EXPECT_THROW(pool.call("what?"), Error);
  }
  set_log_sink({});
  const std::string rest = "seconds=[0-9]+\\.[0-9]{3} rays=[1-9][0-9]*";
  EXPECT_THAT(
      lines,
      testing::ElementsAre(
          testing::MatchesRegex("info job=[0-9]+ attempt=1 slot=w kind=gen units=2 " + rest),
          testing::MatchesRegex("info job=[0-9]+ attempt=1 slot=w kind=viz units=1 " + rest),
          testing::MatchesRegex("info job=[0-9]+ attempt=1 slot=w kind=ref units=3 " + rest),
          testing::MatchesRegex("warning job=[0-9]+ attempt=1 slot=w failed: job: is not valid JSON: .*")));
}

TEST(WorkerPool, TellsWhichSlotDidAJob) {
  const Quiet quiet;
  EXPECT_EQ(name_in_result("w", 1), "w");
  const std::string slot = name_in_result("w", 2);
  EXPECT_TRUE(slot == "w/0" || slot == "w/1") << slot;
  EXPECT_EQ(name_in_result("", 1), test::name_of_this_process());
}

}  // namespace
}  // namespace ssphh::farm
