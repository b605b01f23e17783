#include <map>
#include <random>

#include "farm_process.h"
#include "json_schema.h"
#include "places.h"

namespace ssphh::test {
namespace {

void expect_done(ToolProcess& process, const std::filesystem::path& file, const SmallBake& bake) {
  const ToolResult result = process.wait();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_file(file), bake.wanted) << "the file must be the local one, bit by bit";
}

TEST(FarmBake, AnyNumberOfWorkersGivesTheBitsOfALocalBake) {
  const TempDir dir;
  const SmallBake bake(dir, "8");
  FarmProcesses farm(1);
  for (int workers = 1; workers <= 3; ++workers) {
    if (workers > 1) farm.start_worker();
    const auto file = dir / ("out" + std::to_string(workers) + ".sphl");
    ToolProcess process(bake.on(farm.endpoint(), file));
    expect_done(process, file, bake);
  }
  for (std::size_t i = 0; i < farm.worker_count(); ++i) {
    farm.worker(i).signal(SIGTERM);
    const ToolResult left = farm.worker(i).wait();
    EXPECT_EQ(left.exit_code, 0) << "drained\n" << left.err;
    EXPECT_THAT(left.err, testing::HasSubstr("kind=")) << "every worker took part";
  }
}

TEST(FarmBake, LocalOptionAndJsonSayWhatWasDone) {
  const TempDir dir;
  const SmallBake bake(dir, "2");
  auto command = bake.arguments;
  const std::string file = (dir / "out.sphl").string(), cache = (dir / "cache").string();
  command.insert(command.end(), {"-o", file, "--local", "2", "--cache", cache});
  json::Value object = run_json(command);
  EXPECT_EQ(object["farm"]["units"], 12);
  EXPECT_EQ(object["farm"]["cached"], 0);
  EXPECT_EQ(read_file(file), bake.wanted);
  object = run_json(command);
  EXPECT_EQ(object["farm"]["cached"], 12) << "known from the first time";
  EXPECT_EQ(object["farm"]["jobs"], 0);
  EXPECT_EQ(read_file(file), bake.wanted);

  // Damaged results are computed again.
  for (const auto& entry : std::filesystem::recursive_directory_iterator(cache)) {
    if (!entry.is_regular_file()) continue;
    auto bytes = read_file(entry.path());
    bytes[bytes.size() / 2] ^= std::byte{1};
    write_file(entry.path(), bytes);
  }
  object = run_json(command);
  EXPECT_EQ(object["farm"]["cached"], 0);
  EXPECT_EQ(read_file(file), bake.wanted);
}

TEST(FarmBake, KeepsItsMessagesAsJsonOfTheSchemas) {
  const TempDir dir;
  const SmallBake bake(dir, "2");
  auto command = bake.arguments;
  const std::string file = (dir / "out.sphl").string(), kept = (dir / "kept").string();
  command.insert(command.end(), {"-o", file, "--local", "1", "--cache", "none", "--keep-messages", kept});
  const json::Value object = run_json(command);
  EXPECT_EQ(read_file(file), bake.wanted) << "JSON keeps every bit";
  std::map<std::string, int> count;
  for (const auto& entry : std::filesystem::directory_iterator(kept)) {
    const std::string name = entry.path().filename(), text = read_text_file(entry.path());
    const std::string what = name.substr(5, name.find('.', 5) - 5);  // 0001.job.json
    EXPECT_THAT(schema_errors(source_dir() / ("schemas/farm-" + what + ".schema.json"), text),
                testing::IsEmpty())
        << name;
    ++count[what];
  }
  EXPECT_EQ(count["job"], object["farm"]["jobs"].number());
  EXPECT_EQ(count["result"], object["farm"]["jobs"].number());
}

TEST(FarmBake, KilledWorkersCostNothingButTime) {
  const TempDir dir;
  const SmallBake bake(dir, "24");
  FarmProcesses farm(3, {"--attempts", "20"});  // or a job that is struck three times is set aside
  const auto file = dir / "out.sphl";
  ToolProcess process(bake.on(farm.endpoint(), file));
  ASSERT_TRUE(farm.worker(0).wait_for_stderr("worker-ready"));
  std::minstd_rand random(7);
  for (int i = 0; i < 4; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50 + random() % 60));
    farm.replace_worker(random() % 3);
  }
  expect_done(process, file, bake);
}

TEST(FarmBake, FrozenWorkerCostsNothingButTime) {
  const TempDir dir;
  const SmallBake bake(dir, "16");
  FarmProcesses farm(2);
  const auto file = dir / "out.sphl";
  ToolProcess process(bake.on(farm.endpoint(), file));
  ASSERT_TRUE(farm.worker(0).wait_for_stderr("kind=gen"));
  farm.worker(0).signal(SIGSTOP);
  expect_done(process, file, bake);
}

TEST(FarmBake, BrokerThatIsKilledAndComesBackLosesNothing) {
  const TempDir dir;
  const SmallBake bake(dir, "16");
  FarmProcesses farm(2, {"--store", (dir / "store").string()});
  const auto file = dir / "out.sphl";
  ToolProcess process(bake.on(farm.endpoint(), file));
  ASSERT_TRUE(farm.worker(0).wait_for_stderr("kind=gen"));
  farm.kill_broker();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  farm.start_broker();
  expect_done(process, file, bake);
}

TEST(FarmBake, CancelledBakeGoesOnWhereItStopped) {
  const TempDir dir;
  const SmallBake bake(dir, "24");
  FarmProcesses farm(1);
  const auto file = dir / "out.sphl";
  const std::string cache = (dir / "results").string();
  ToolProcess process(bake.on(farm.endpoint(), file, cache));
  ASSERT_TRUE(farm.worker(0).wait_for_stderr("kind=gen"));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  process.signal(SIGINT);
  const ToolResult cancelled = process.wait();
  if (cancelled.exit_code == 0) GTEST_SKIP() << "it was done before the signal came";
  EXPECT_EQ(cancelled.exit_code, 1) << cancelled.err;
  EXPECT_FALSE(std::filesystem::exists(file));
  // Another output: the checkpoint beside the first does not help, the results do.
  const auto other = dir / "other.sphl";
  const ToolResult again = run_tool(bake.on(farm.endpoint(), other, cache));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_GT(parse_json(again.out)["farm"]["cached"].number(), 0);
  EXPECT_EQ(read_file(other), bake.wanted);
}

TEST(FarmBake, WorkerWithoutRoomSaysSoAndOthersDoTheJobs) {
  const TempDir dir;
  const SmallBake bake(dir, "4");
  FarmProcesses farm(2);
  for (std::size_t i = 0; i < 2; ++i) ASSERT_TRUE(farm.worker(i).wait_for_stderr("worker-ready"));
  // The folder of the first one's cache is gone and cannot come back.
  std::filesystem::remove_all(farm.dir() / "cache0");
  write_file(farm.dir() / "cache0", "a file where the cache was");
  const auto file = dir / "out.sphl";
  ToolProcess process(bake.on(farm.endpoint(), file));
  expect_done(process, file, bake);
  EXPECT_THAT(farm.worker(0).stderr_so_far(),
              testing::HasSubstr("failed: " + (farm.dir() / "cache0").string()));
}

}  // namespace
}  // namespace ssphh::test
