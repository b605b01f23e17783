#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/enum_names.h>

namespace ssphh::app {

/// `automatic` is a bar on a terminal and plain lines otherwise.
enum class ProgressStyle { automatic, bar, plain, json, none };
constexpr auto enum_table(ProgressStyle) {
  using enum ProgressStyle;
  return std::to_array<EnumName<ProgressStyle>>(
      {{automatic, "auto"}, {bar, "bar"}, {plain, "plain"}, {json, "json"}, {none, "none"}});
}

/// By the second, minute or hour: the first that makes it at least one.
std::string rate_text(double per_second, const std::string& unit);
/// "M:SS", from an hour on "H:MM:SS".
std::string clock_text(double seconds);

/// Progress with rate and estimated time on stderr: a redrawn bar, or a line at most every few seconds.
class StderrProgress final : public Progress {
 public:
  explicit StderrProgress(ProgressStyle style);
  void begin(const std::string& stage, std::uint64_t total, const std::string& unit) override;
  void advance(std::uint64_t count) override;
  void end() override;

 private:
  using Clock = std::chrono::steady_clock;
  void print(bool last);

  ProgressStyle style_;
  std::mutex mutex_;
  std::string stage_, unit_;
  std::uint64_t total_ = 0, done_ = 0;
  Clock::time_point start_, printed_;
};

}  // namespace ssphh::app
