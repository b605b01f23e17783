// Programs that the tool runs: what they print goes where it should, how they end is told.

#include "commands/child_process.h"

#include <cstdlib>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>

#include "error_message.h"
#include "temp_dir.h"

namespace ssphh::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using namespace std::chrono_literals;

class ChildProcess : public testing::Test {
 protected:
  std::vector<std::string> shell(const std::string& text) const { return {"sh", "-c", text}; }
  std::string problem(const std::string& text, std::chrono::seconds limit = 20s) const {
    return test::message_of([&] { run_program(shell(text), log_, limit, {}); });
  }

  const test::TempDir dir_;
  const std::filesystem::path log_ = dir_ / "log", result_ = dir_ / "result";
};

TEST_F(ChildProcess, PrintsIntoLogAndResult) {
  run_program(shell("echo out; echo err >&2"), log_, 20s, {}, result_);
  EXPECT_EQ(read_text_file(result_), "out\n");
  EXPECT_EQ(read_text_file(log_), "err\n");
  run_program(shell("echo more; echo errors >&2"), log_, 20s, {});
  EXPECT_EQ(read_text_file(log_), "err\nmore\nerrors\n") << "appended, both without a result";
  EXPECT_EQ(read_text_file(result_), "out\n");
}

TEST_F(ChildProcess, ReadsNothing) {
  run_program(shell("cat; echo end"), log_, 20s, {});
  EXPECT_EQ(read_text_file(log_), "end\n");
}

TEST_F(ChildProcess, TellsWhatItTook) {
  const ProgramUsage usage =
      run_program(shell("i=0; while [ $i -lt 20000 ]; do i=$((i + 1)); done"), log_, 20s, {});
  EXPECT_GT(usage.cpu_seconds, 0);
  EXPECT_GE(usage.seconds, 0.5 * usage.cpu_seconds) << "of one thread; the clocks' grains differ";
  // A shell's pages: more than 256 KiB, less than 256 MiB.
  EXPECT_GT(usage.peak_bytes, 256u << 10);
  EXPECT_LT(usage.peak_bytes, 256u << 20);
}

TEST_F(ChildProcess, AnExitCodeIsToldWithTheLastEightLines) {
  const std::string text = problem("for i in 1 2 3 4 5 6 7 8 9 10; do echo line $i; done; exit 3");
  EXPECT_THAT(text, AllOf(HasSubstr("sh: exited with 3; " + log_.string() + " says:\n  line 3\n  line 4"),
                          HasSubstr("\n  line 10"), Not(HasSubstr("line 2"))));
  EXPECT_THAT(test::message_of([&] { run_program({"/nonexistent/program"}, dir_ / "log2", 20s, {}); }),
              HasSubstr("/nonexistent/program: exited with 127"));
}

TEST_F(ChildProcess, ASignalIsToldByNumberAndName) {
  EXPECT_THAT(problem("echo last words; kill -TERM $$"),
              AllOf(HasSubstr("ended by signal 15 (Terminated)"), HasSubstr("\n  last words")));
}

TEST_F(ChildProcess, ATimeLimitEndsItWithItsChildren) {
  const std::string still = dir_ / "still";
  const std::string text = problem("echo begun; (sleep 0.1; touch " + still + ") & sleep 5", 0s);
  EXPECT_THAT(text, AllOf(HasSubstr("not done after 0 s and ended"), HasSubstr("--time-limit")));
  std::this_thread::sleep_for(150ms);
  EXPECT_FALSE(std::filesystem::exists(still));
}

TEST_F(ChildProcess, CtrlCEndsIt) {
  CancelToken cancel;
  cancel.request();
  const std::string still = dir_ / "still";
  EXPECT_THROW(run_program(shell("sleep 0.05; touch " + still), log_, 20s, {nullptr, &cancel}), Cancelled);
  std::this_thread::sleep_for(100ms);
  EXPECT_FALSE(std::filesystem::exists(still)) << "it does not go on";
}

TEST_F(ChildProcess, ALogThatCannotBeWrittenIsAnError) {
  EXPECT_THAT(
      test::message_of([&] { run_program(shell("true"), dir_ / "no/log", 20s, {}); }),
      AllOf(HasSubstr((dir_ / "no/log").string()), HasSubstr("cannot write: No such file or directory")));
}

TEST_F(ChildProcess, ProgramsAreFoundInTheOrderOfPath) {
  const std::string before = std::getenv("PATH");
  for (const char* folder : {"a", "b", "c"}) {
    std::filesystem::create_directory(dir_ / folder);
    std::ofstream(dir_ / folder / "tool") << "#!/bin/sh\necho \"$PATH\"\n";
  }
  for (const char* folder : {"b", "c"})
    std::filesystem::permissions(dir_ / folder / "tool", std::filesystem::perms::owner_all);
  std::filesystem::create_directory(dir_ / "a/folder");
  const std::string path =
      (dir_ / "a").string() + ":" + (dir_ / "b").string() + ":" + (dir_ / "c").string() + ":" + before;
  ::setenv("PATH", path.c_str(), 1);
  const std::filesystem::path tool = find_program("tool"), folder = find_program("folder");
  run_program({"tool"}, log_, 20s, {});
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(tool, std::filesystem::canonical(dir_ / "b/tool")) << "the first that may be run";
  EXPECT_EQ(folder, "");
  EXPECT_EQ(read_text_file(log_), tool.parent_path().string() + ":" + path + "\n")
      << "beside it first of all";
}

}  // namespace
}  // namespace ssphh::app
