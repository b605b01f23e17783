#pragma once
/// Runs the ssphh tool as a user would and captures what it prints.

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "places.h"
#include "temp_dir.h"

namespace ssphh::test {

struct ToolResult {
  int exit_code = -1;  ///< 128 + signal when killed
  std::string out, err;
};

/// A running tool; its output goes to files, so it never blocks on a pipe.
class ToolProcess {
 public:
  explicit ToolProcess(const std::vector<std::string>& arguments) {
    pid_ = ::fork();
    if (pid_ == 0) {
      redirect(dir_ / "out", STDOUT_FILENO);
      redirect(dir_ / "err", STDERR_FILENO);
      ::close(STDIN_FILENO);
      ::setenv("SSPHH_CONFIG", "none", 0);  // whatever the user's own defaults are
      std::vector<char*> argv = {const_cast<char*>(tool_path().c_str())};
      for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
      argv.push_back(nullptr);
      ::execv(tool_path().c_str(), argv.data());
      ::_exit(127);
    }
  }
  /// A test that gives up leaves no tool behind, for which others would wait.
  ~ToolProcess() {
    if (waited_) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  ToolProcess(const ToolProcess&) = delete;
  void signal(int number) const { ::kill(pid_, number); }
  pid_t pid() const { return pid_; }
  bool running() const {
    siginfo_t ended{};
    return ::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           ended.si_pid == 0;
  }
  std::string stderr_so_far() const { return slurp(dir_ / "err"); }
  /// Polls until stderr holds `text` or a minute has passed: other programs may leave this one little of the
  /// machine.
  bool wait_for_stderr(const std::string& text) const {
    for (int i = 0; i < 6000; ++i) {
      if (stderr_so_far().find(text) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  ToolResult wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    waited_ = true;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), slurp(dir_ / "out"),
            slurp(dir_ / "err")};
  }

 private:
  static void redirect(const std::filesystem::path& path, int fd) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, fd);
  }
  static std::string slurp(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  TempDir dir_;
  pid_t pid_;
  bool waited_ = false;
};

inline ToolResult run_tool(const std::vector<std::string>& arguments) {
  return ToolProcess(arguments).wait();
}

}  // namespace ssphh::test
