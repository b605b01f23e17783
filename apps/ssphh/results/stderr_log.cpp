#include "results/stderr_log.h"

#include <cstdlib>
#include <string_view>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ssphh/core/json.h>

namespace ssphh::app {

std::string json_line(LogLevel level, const std::string& message,
                      std::chrono::system_clock::time_point time) {
  const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
  const json::Value line = {{"time", fmt::format("{:%FT%T}.{:03}Z", fmt::gmtime(since / 1000), since % 1000)},
                            {"level", name_of(level)},
                            {"message", message}};
  return print(line);
}

std::string coloured_line(LogLevel level, const std::string& message) {
  if (level == LogLevel::info) return message;
  const int colour = level == LogLevel::error ? 31 : level == LogLevel::warning ? 33 : 90;
  return fmt::format("\x1b[1;{}m{}:\x1b[0m {}", colour, name_of(level), message);
}

bool wants_colour(bool terminal) {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string_view(value ? value : "");
  };
  return terminal && variable("NO_COLOR").empty() && variable("TERM") != "dumb";
}

void log_as_json() {
  set_log_sink([](LogLevel level, const std::string& message) {
    fmt::print(stderr, "{}\n", json_line(level, message, std::chrono::system_clock::now()));
  });
}

void log_in_colour() {
  set_log_sink([](LogLevel level, const std::string& message) {
    fmt::print(stderr, "{}\n", coloured_line(level, message));
  });
}

}  // namespace ssphh::app
