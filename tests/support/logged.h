#pragma once
/// What is said in the log while it lives, line after line.

#include <string>
#include <utility>
#include <vector>

#include <ssphh/core/log.h>

namespace ssphh::test {

class Logged {
 public:
  Logged() { set_log_level(LogLevel::info); }
  ~Logged() {
    set_log_sink(std::move(before_));
    set_log_level(LogLevel::info);
  }
  Logged(const Logged&) = delete;
  Logged& operator=(const Logged&) = delete;

  /// Since the last call, each as "level: line\n".
  std::string take() { return std::exchange(text_, {}); }

 private:
  std::string text_;
  LogSink before_ = set_log_sink([this](LogLevel level, const std::string& line) {
    text_ += std::string(name_of(level)) + ": " + line + "\n";
  });
};

}  // namespace ssphh::test
