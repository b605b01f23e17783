#include "commands/child_process.h"

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
#include <ssphh/core/stopwatch.h>

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

/// This process' environment with the program's own folder first on PATH. A distribution's Blender takes the
/// first python3 there for its own, and that of a version manager or a virtual environment has no numpy.
std::vector<std::string> environment_for(const std::string& program) {
  const std::filesystem::path found = find_program(program);
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const bool is_path = std::string_view(*variable).starts_with("PATH=");
    variables.emplace_back(is_path && !found.empty()
                               ? fmt::format("PATH={}:{}", found.parent_path().string(), *variable + 5)
                               : *variable);
  }
  return variables;
}

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (const std::string& text : texts) result.push_back(const_cast<char*>(text.c_str()));
  result.push_back(nullptr);
  return result;
}

pid_t start(const std::vector<std::string>& command, const std::filesystem::path& log,
            const std::filesystem::path& result) {
  const int err = open_to_write(log), out = open_to_write(result.empty() ? log : result);
  const std::vector<std::string> variables = environment_for(command[0]);
  const std::vector<char*> arguments = pointers(command), environment = pointers(variables);
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::setpgid(0, 0);  // so that its children end with it
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(err, 2), ::dup2(out, 1), ::dup2(nothing, 0);  // in this order: 0 may have been closed and be err
    ::execvpe(arguments[0], arguments.data(), environment.data());
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
  const Stopwatch watch;
  const pid_t pid = start(command, log, result);
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
    if (watch.seconds() > static_cast<double>(limit.count())) {
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
  return {watch.seconds(), seconds(usage.ru_utime) + seconds(usage.ru_stime),
          static_cast<std::uint64_t>(usage.ru_maxrss) * 1024};
}

std::filesystem::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    std::error_code unreadable;
    if (std::filesystem::is_regular_file(file, unreadable) && ::access(file.c_str(), X_OK) == 0)
      return std::filesystem::canonical(file);
  }
  return {};
}

}  // namespace ssphh::app
