#include <chrono>
#include <thread>

#include "farm_process.h"

namespace ssphh::test {
namespace {

TEST(FarmRender, PicturesAndLayersHaveTheBitsOfALocalRender) {
  const TempDir dir;
  FarmProcesses farm(2);
  const std::vector<std::string> common = {
      "render", "builtin:gallery1",          "--width", "70", "--height", "41", "--spp", "4", "--passes", "2",
      "--aov",  "direct,normal,depth,groups"};
  auto local = common, far = common;
  local.insert(local.end(), {"-o", (dir / "local.exr").string()});
  far.insert(far.end(), {"-o", (dir / "far.exr").string(), "--broker", farm.endpoint(), "--cache", "none"});
  const json::Value a = run_json(local), b = run_json(far);
  EXPECT_EQ(a["paths"], b["paths"]);
  EXPECT_EQ(b["farm"]["units"], 6);
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(dir.path())) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("local.")) continue;
    EXPECT_EQ(read_file(entry.path()), read_file(dir / ("far." + name.substr(6)))) << name;
    ++compared;
  }
  EXPECT_EQ(compared, 1 + 3 + 3) << "picture, direct, normal, depth, three groups";
}

TEST(FarmRender, PicturesLitByProbesHaveTheBitsOfALocalRender) {
  const TempDir dir;
  FarmProcesses farm(2);
  const std::string probes = (dir / "p.sphl").string();
  ASSERT_EQ(run_tool({"bake", "builtin:gallery1", "--face", "8", "--spp", "4", "--viz", "off", "--records",
                      "0", "-o", probes})
                .exit_code,
            0);
  const std::vector<std::string> common = {
      "render", "builtin:gallery1", "--method", "ssphh", "--probes", probes, "--width",
      "48",     "--height",         "32",       "--spp", "4"};
  auto local = common, far = common;
  local.insert(local.end(), {"-o", (dir / "local.exr").string()});
  far.insert(far.end(), {"-o", (dir / "far.exr").string(), "--broker", farm.endpoint(), "--cache", "none"});
  run_json(local), run_json(far);
  EXPECT_EQ(read_file(dir / "local.exr"), read_file(dir / "far.exr"));
}

TEST(FarmRelight, FramesHaveTheBitsOfALocalRunThoughAWorkerDies) {
  const TempDir dir;
  const std::vector<std::string> common = {"relight",       "builtin:two-rooms",
                                           "--probes",      "6",
                                           "--degree",      "2",
                                           "--directions",  "64",
                                           "--surfel-size", "0.8",
                                           "--link-rays",   "16",
                                           "--frames",      "2",
                                           "--format",      "exr",
                                           "--width",       "96",
                                           "--height",      "64",
                                           "--spp",         "64"};
  const json::Value local = run_json(joined(common, {"-o", (dir / "local").string()}));
  EXPECT_FALSE(local.contains("farm"));
  FarmProcesses farm(2);
  ToolProcess process(joined(
      common, {"-o", (dir / "far").string(), "--broker", farm.endpoint(), "--cache", "none", "--json"}));
  ASSERT_TRUE(farm.worker(0).wait_for_stderr("kind=ref"));
  farm.worker(0).signal(SIGSTOP);  // the broker gives it another job
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  farm.worker(0).signal(SIGKILL);
  const ToolResult result = process.wait();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json::Value far = json::parse(result.out, "relight");
  EXPECT_EQ(far["farm"]["units"], 2 * 3 * 2) << "tiles of 32 pixels";
  EXPECT_GE(far["farm"]["retries"].number(), 1);
  for (const char* name : {"frame-0000.exr", "frame-0001.exr"})
    EXPECT_EQ(read_file(dir / "local" / name), read_file(dir / "far" / name)) << name;
  expect_failure(joined(common, {"--broker", farm.endpoint()}), "none are asked for");
}

TEST(FarmCommand, StatusDrainAndKeys) {
  const TempDir dir;
  FarmProcesses farm(2);
  ASSERT_TRUE(farm.worker(1).wait_for_stderr("worker-ready"));
  json::Value status = json::Value::object();
  for (int i = 0; i < 100 && (!status.contains("workers") || status["workers"].size() < 2); ++i)
    status = run_json({"farm", "status", "--broker", farm.endpoint()});
  ASSERT_EQ(status["workers"].size(), 2u) << print(status, 1);
  EXPECT_EQ(run_json({"farm", "drain", "--broker", farm.endpoint(), "--workers", "test:1"})["told"], 1);
  EXPECT_EQ(farm.worker(1).wait().exit_code, 0);

  const std::string keys = (dir / "keys").string();
  run_json({"farm", "keygen", "node1", "--role", "worker", "--keys", keys});
  run_json({"farm", "keygen", "me", "--role", "client", "--keys", keys});
  for (const char* name : {"broker.key", "broker.pub", "node1.key", "me.key", "allow.txt"})
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(keys) / name)) << name;
  expect_failure({"farm", "keygen", "me", "--role", "admin", "--keys", keys}, "me");
  expect_failure({"farm", "status", "--broker", "tcp://192.0.2.1:5555"}, "--keys");
  expect_failure({"worker", "--broker", "tcp://192.0.2.1:5555"}, "--keys", 42);
}

TEST(FarmCommand, OnlyAnAdministratorMayDrain) {
  const TempDir dir;
  const std::string keys = (dir / "keys").string();
  run_json({"farm", "keygen", "me", "--role", "client", "--keys", keys});
  std::filesystem::rename(dir / "keys/me.key", dir / "keys/admin.key");  // a name gives no role
  const FarmProcesses farm(0, {"--keys", keys});
  expect_failure({"farm", "drain", "--broker", farm.endpoint(), "--keys", keys, "--workers", "all"},
                 "this key has no admin role (make one with --role admin)");
}

TEST(FarmCommand, BakeWithKeys) {
  const TempDir dir;
  const SmallBake bake(dir, "2");
  const std::string keys = (dir / "keys").string();
  for (const char* who : {"client", "worker"})
    run_json({"farm", "keygen", who, "--role", who, "--keys", keys});
  FarmProcesses farm(0, {"--keys", keys});
  farm.start_worker({"--keys", keys});
  auto command = bake.on(farm.endpoint(), dir / "out.sphl");
  command.insert(command.end(), {"--keys", keys});
  const ToolResult result = run_tool(command);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_file(dir / "out.sphl"), bake.wanted);
}

TEST(FarmCommand, AKeyTakenOffTheListIsRefusedAfterSighup) {
  const TempDir dir;
  const std::string keys = (dir / "keys").string();
  for (const char* who : {"alice", "bob"})
    run_json({"farm", "keygen", who, "--role", "client", "--keys", keys});
  FarmProcesses farm(0, {"--keys", keys});
  const auto status = [&](const char* who) {
    return run_tool({"farm", "status", "--broker", farm.endpoint(), "--keys", keys, "--key", who}).exit_code;
  };
  EXPECT_EQ(status("alice"), 0);
  std::string kept;
  std::istringstream lines(read_text_file(dir / "keys/allow.txt"));
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("alice ")) kept += line + "\n";
  write_file(dir / "keys/allow.txt", kept);
  farm.broker().signal(SIGHUP);
  EXPECT_TRUE(farm.broker().wait_for_stderr("allow-list-read keys=1"));
  EXPECT_EQ(status("bob"), 0);
  // It tries on, for lists change, until its five seconds are over; here until it has been refused.
  ToolProcess refused({"farm", "status", "--broker", farm.endpoint(), "--keys", keys, "--key", "alice"});
  EXPECT_TRUE(refused.wait_for_stderr("the broker refuses the connection")) << refused.stderr_so_far();
  EXPECT_TRUE(farm.broker().wait_for_stderr("connection-refused"));
  refused.signal(SIGINT);
  const ToolResult result = refused.wait();
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_EQ(result.out, "") << "it was told nothing";
}

}  // namespace
}  // namespace ssphh::test
