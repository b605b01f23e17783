/// A bake over a network that is cut, falls silent or is slow, and on disks that are full.

#include <sys/resource.h>

#include "farm_process.h"
#include "relay.h"

namespace ssphh::test {
namespace {

/// A farm whose first worker sits behind a relay.
struct FarAwayWorker {
  explicit FarAwayWorker(int near_workers)
      : farm(0, {"--attempts", "20"}), relay((farm.dir() / "broker").string()) {
    farm.start_worker({}, relay.endpoint());
    for (int i = 0; i < near_workers; ++i) farm.start_worker();
    EXPECT_TRUE(farm.worker(0).wait_for_stderr("worker-ready"));
  }
  FarmProcesses farm;
  Relay relay;
};

void expect_wanted(ToolProcess& process, const std::filesystem::path& file, const SmallBake& bake) {
  const ToolResult result = process.wait();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_file(file), bake.wanted) << "the file must be the local one, bit by bit";
}

TEST(FarmNetwork, LinkThatIsCutAgainAndAgainCostsNothingButTime) {
  const TempDir dir;
  const SmallBake bake(dir, "24");
  FarAwayWorker far(1);
  const auto file = dir / "out.sphl";
  ToolProcess process(bake.on(far.farm.endpoint(), file));
  for (int i = 0; i < 5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(90));
    far.relay.cut();
  }
  expect_wanted(process, file, bake);
}

// Nobody is told that the cable is out: heartbeats find it, and after it is in again the worker is back.
TEST(FarmNetwork, SilentLinkCostsARetryAndTheWorkerComesBack) {
  const TempDir dir;
  const SmallBake bake(dir, "16");
  FarAwayWorker far(1);
  const auto file = dir / "out.sphl";
  ToolProcess process(bake.on(far.farm.endpoint(), file));
  ASSERT_TRUE(far.farm.worker(0).wait_for_stderr("kind=gen"));
  far.relay.stall(true);
  expect_wanted(process, file, bake);
  far.relay.stall(false);
  std::size_t workers = 0;
  for (int i = 0; i < 100 && workers < 2; ++i) {
    workers = run_json({"farm", "status", "--broker", far.farm.endpoint()})["workers"].size();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  EXPECT_EQ(workers, 2u);
}

TEST(FarmNetwork, SlowLinkCostsNothingButTime) {
  const TempDir dir;
  const SmallBake bake(dir, "4");
  FarAwayWorker far(0);
  far.relay.slow(std::chrono::milliseconds(20), 1e6);
  const auto file = dir / "out.sphl";
  ToolProcess process(bake.on(far.farm.endpoint(), file));
  expect_wanted(process, file, bake);
  EXPECT_GT(far.relay.passed(), 10'000u);
}

// Writing fails in the middle of a file, as on a disk without room.
TEST(FarmNetwork, WorkerWhoseDiskIsFullSaysSoAndOthersDoTheJobs) {
  const TempDir dir;
  const SmallBake bake(dir, "4");
  FarmProcesses farm(1);
  rlimit limit{}, small{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  small = {1024, limit.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  farm.start_worker();
  ::setrlimit(RLIMIT_FSIZE, &limit);
  for (std::size_t i = 0; i < 2; ++i) ASSERT_TRUE(farm.worker(i).wait_for_stderr("worker-ready"));
  const auto file = dir / "out.sphl";
  ToolProcess process(bake.on(farm.endpoint(), file));
  expect_wanted(process, file, bake);
  EXPECT_THAT(farm.worker(1).stderr_so_far(), testing::HasSubstr("File too large"));
  farm.worker(1).signal(SIGTERM);
  EXPECT_EQ(farm.worker(1).wait().exit_code, 0) << "it is alive";
}

}  // namespace
}  // namespace ssphh::test
