#pragma once
/// A broker and workers as processes, on a socket in a temporary folder.

#include <gtest/gtest.h>

#include <ssphh/core/file.h>

#include "joined.h"
#include "tool_checks.h"

namespace ssphh::test {

class FarmProcesses {
 public:
  explicit FarmProcesses(int workers, std::vector<std::string> broker_options = {})
      : broker_options_(std::move(broker_options)) {
    start_broker();
    for (int i = 0; i < workers; ++i) start_worker();
  }
  ~FarmProcesses() {
    for (auto& worker : workers_) end(*worker);
    if (broker_) end(*broker_);
  }
  FarmProcesses(const FarmProcesses&) = delete;
  FarmProcesses& operator=(const FarmProcesses&) = delete;

  std::string endpoint() const { return "ipc://" + (dir_ / "broker").string(); }
  const TempDir& dir() const { return dir_; }
  ToolProcess& broker() { return *broker_; }
  ToolProcess& worker(std::size_t i) { return *workers_[i]; }
  std::size_t worker_count() const { return workers_.size(); }

  /// A cache of its own, so that every worker fetches the scene. `by`: another endpoint that leads to the
  /// broker.
  void start_worker(std::vector<std::string> more = {}, const std::string& by = {}) {
    std::vector<std::string> arguments = {"worker",
                                          "--broker",
                                          by.empty() ? endpoint() : by,
                                          "--threads",
                                          "1",
                                          "--name",
                                          "test:" + std::to_string(workers_.size()),
                                          "--cache",
                                          (dir_ / ("cache" + std::to_string(workers_.size()))).string()};
    workers_.push_back(std::make_unique<ToolProcess>(joined(arguments, more)));
  }
  void replace_worker(std::size_t i) {
    end(*workers_[i]);
    std::vector<std::string> arguments = {"worker",
                                          "--broker",
                                          endpoint(),
                                          "--threads",
                                          "1",
                                          "--cache",
                                          (dir_ / ("cache" + std::to_string(i))).string()};
    workers_[i] = std::make_unique<ToolProcess>(arguments);
  }
  void start_broker() {
    broker_ = std::make_unique<ToolProcess>(joined({"broker", "--bind", endpoint()}, broker_options_));
    EXPECT_TRUE(broker_->wait_for_stderr("broker-ready")) << broker_->stderr_so_far();
  }
  void kill_broker() { end(*broker_); }

 private:
  static void end(ToolProcess& process) {
    process.signal(SIGCONT);
    process.signal(SIGKILL);
    process.wait();
  }

  TempDir dir_;
  std::vector<std::string> broker_options_;
  std::unique_ptr<ToolProcess> broker_;
  std::vector<std::unique_ptr<ToolProcess>> workers_;
};

/// What a small bake of Gallery 1 gives, done here.
struct SmallBake {
  std::vector<std::string> arguments;
  std::vector<std::byte> wanted;

  explicit SmallBake(const TempDir& dir, const std::string& spp = "16") {
    arguments = {"bake", "builtin:gallery1", "--face", "16",          "--spp",
                 spp,    "--degree",         "5",      "--max-depth", "3"};
    const std::string file = (dir / "local.sphl").string();
    const ToolResult result = run_tool(joined(arguments, {"-o", file, "--progress", "none"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    wanted = read_file(file);
  }
  std::vector<std::string> on(const std::string& endpoint, const std::filesystem::path& output,
                              const std::string& cache = "none") const {
    return joined(arguments, {"-o", output.string(), "--broker", endpoint, "--cache", cache, "--progress",
                              "plain", "--json"});
  }
};

}  // namespace ssphh::test
