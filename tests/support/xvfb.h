#pragma once
/// A display without a screen, for tests of windows.

#include <cstdlib>
#include <string>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ssphh::test {

/// Starts Xvfb on a free display and makes it this process's $DISPLAY; ends it again.
class Xvfb {
 public:
  Xvfb() {
    int pipe_ends[2];
    if (::pipe(pipe_ends) != 0) return;
    pid_ = ::fork();
    if (pid_ == 0) {
      ::close(pipe_ends[0]);
      ::close(STDOUT_FILENO), ::close(STDERR_FILENO);
      const std::string fd = std::to_string(pipe_ends[1]);
      ::execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", "1280x800x24", "-nolisten", "tcp",
               static_cast<char*>(nullptr));
      ::_exit(127);
    }
    ::close(pipe_ends[1]);
    // The display's number and a line feed; nothing when Xvfb is missing.
    std::string number;
    char c = 0;
    while (::read(pipe_ends[0], &c, 1) == 1 && c != '\n') number += c;
    ::close(pipe_ends[0]);
    if (number.empty()) return;
    running_ = true;
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
  }
  ~Xvfb() {
    ::unsetenv("DISPLAY");
    if (pid_ <= 0) return;
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
  }
  Xvfb(const Xvfb&) = delete;
  Xvfb& operator=(const Xvfb&) = delete;

  bool running() const { return running_; }

 private:
  pid_t pid_ = -1;
  bool running_ = false;
};

}  // namespace ssphh::test
