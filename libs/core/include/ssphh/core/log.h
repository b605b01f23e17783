#pragma once
/// Messages for people, on stderr (stdout belongs to results).

#include <functional>
#include <string>

#include <fmt/format.h>

#include <ssphh/core/enum_names.h>

namespace ssphh {

enum class LogLevel { debug, info, warning, error };
constexpr auto enum_table(LogLevel) {
  using enum LogLevel;
  return std::to_array<EnumName<LogLevel>>(
      {{debug, "debug"}, {info, "info"}, {warning, "warning"}, {error, "error"}});
}

/// Receives every message at or above the threshold; called under a lock.
using LogSink = std::function<void(LogLevel, const std::string&)>;

void set_log_level(LogLevel threshold);

/// Replaces the stderr sink; an empty function restores it. Returns the sink that was there before.
LogSink set_log_sink(LogSink sink);

void log(LogLevel level, const std::string& message);

template <class... Args>
void log_info(fmt::format_string<Args...> format, Args&&... args) {
  log(LogLevel::info, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void log_warning(fmt::format_string<Args...> format, Args&&... args) {
  log(LogLevel::warning, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace ssphh
