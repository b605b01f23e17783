#pragma once
/// Messages on stderr in other forms than the library's plain lines.

#include <chrono>
#include <string>

#include <ssphh/core/log.h>

namespace ssphh::app {

/// One JSON object: time (UTC), level, message.
std::string json_line(LogLevel level, const std::string& message, std::chrono::system_clock::time_point time);
/// As the library writes it, with "error:" in red and "warning:" in yellow.
std::string coloured_line(LogLevel level, const std::string& message);

/// Whether stderr should be coloured: on a terminal that is not dumb, unless NO_COLOR (no-color.org) is set.
bool wants_colour(bool terminal);

/// From now on all messages are such lines on stderr.
void log_as_json();
void log_in_colour();

}  // namespace ssphh::app
