#include "child_process.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ssphh/core/error.h>

namespace ssphh::app {
namespace {

std::string last_lines(const std::filesystem::path& log, int count) {
  std::ifstream file(log);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  std::string text;
  const std::size_t first = lines.size() - std::min(lines.size(), static_cast<std::size_t>(count));
  for (std::size_t i = first; i < lines.size(); ++i) text += "\n  " + lines[i];
  return text;
}

int open_to_write(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file < 0) throw Error(path.string(), std::string("cannot write: ") + std::strerror(errno));
  return file;
}

pid_t start(const std::vector<std::string>& command, const std::filesystem::path& log,
            const std::filesystem::path& result) {
  const int err = open_to_write(log), out = open_to_write(result.empty() ? log : result);
  std::vector<char*> arguments;
  for (const std::string& a : command) arguments.push_back(const_cast<char*>(a.c_str()));
  arguments.push_back(nullptr);
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::setpgid(0, 0);  // so that its children end with it
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(err, 2), ::dup2(out, 1), ::dup2(nothing, 0);  // in this order: 0 may have been closed and be err
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ::close(out), ::close(err);
  if (pid < 0) throw Error(command[0], std::string("cannot start: ") + std::strerror(errno));
  return pid;
}

}  // namespace

ProgramUsage run_program(const std::vector<std::string>& command, const std::filesystem::path& log,
                         std::chrono::seconds limit, const Control& control,
                         const std::filesystem::path& result) {
  const auto begin = std::chrono::steady_clock::now();
  const pid_t pid = start(command, log, result);
  const auto deadline = begin + limit;
  int status = 0;
  rusage usage{};
  const auto end_it = [&] {
    ::kill(-pid, SIGKILL), ::kill(pid, SIGKILL);
    ::waitpid(pid, &status, 0);
  };
  while (::wait4(pid, &status, WNOHANG, &usage) == 0) {
    if (control.cancelled()) {
      end_it();
      throw Cancelled();
    }
    if (std::chrono::steady_clock::now() > deadline) {
      end_it();
      throw Error(command[0],
                  fmt::format("not done after {} s and ended; {} says:{}", limit.count(), log.string(),
                              last_lines(log, 8)),
                  "raise --time-limit, or ask for fewer pixels or samples");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (WIFSIGNALED(status)) {
    throw Error(command[0], fmt::format("ended by signal {} ({}); {} says:{}", WTERMSIG(status),
                                        ::strsignal(WTERMSIG(status)), log.string(), last_lines(log, 8)));
  }
  if (WEXITSTATUS(status) != 0) {
    throw Error(command[0], fmt::format("exited with {}; {} says:{}", WEXITSTATUS(status), log.string(),
                                        last_lines(log, 8)));
  }
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
          seconds(usage.ru_utime) + seconds(usage.ru_stime),
          static_cast<std::uint64_t>(usage.ru_maxrss) * 1024};
}

bool program_exists(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((folder + "/" + name).c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace ssphh::app
