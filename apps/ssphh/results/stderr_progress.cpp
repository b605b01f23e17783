#include "results/stderr_progress.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include <ssphh/core/json.h>

namespace ssphh::app {
namespace {

std::string scaled(double value) {
  const char* suffixes[] = {"", "k", "M", "G", "T"};
  int i = 0;
  while (value >= 1000 && i < 4) value /= 1000, ++i;
  return fmt::format("{:.{}f}{}", value, i == 0 ? 0 : 1, suffixes[i]);
}

}  // namespace

std::string rate_text(double per_second, const std::string& unit) {
  if (per_second >= 1 || per_second <= 0) return fmt::format("{} {}/s", scaled(per_second), unit);
  const double per_minute = 60 * per_second;
  return per_minute >= 1 ? fmt::format("{:.1f} {}/min", per_minute, unit)
                         : fmt::format("{:.1f} {}/h", 60 * per_minute, unit);
}

std::string clock_text(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02}", s / 60, s % 60);
}

StderrProgress::StderrProgress(ProgressStyle style) : style_(style) {
  if (style == ProgressStyle::automatic)
    style_ = ::isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::plain;
}

void StderrProgress::begin(const std::string& stage, std::uint64_t total, const std::string& unit) {
  std::lock_guard lock(mutex_);
  stage_ = stage, unit_ = unit, total_ = total, done_ = 0;
  start_ = printed_ = Clock::now();
}

void StderrProgress::advance(std::uint64_t count) {
  std::lock_guard lock(mutex_);
  done_ += count;
  const auto interval = std::chrono::milliseconds(style_ == ProgressStyle::bar    ? 100
                                                  : style_ == ProgressStyle::json ? 200
                                                                                  : 2000);
  if (Clock::now() - printed_ >= interval) print(false);
}

void StderrProgress::end() {
  std::lock_guard lock(mutex_);
  print(true);
}

void StderrProgress::print(bool last) {
  printed_ = Clock::now();
  if (style_ == ProgressStyle::none) return;
  const double seconds = std::chrono::duration<double>(printed_ - start_).count();
  const double fraction =
      total_ ? std::min(1.0, static_cast<double>(done_) / static_cast<double>(total_)) : 1.0;
  const double rate = seconds > 0 ? static_cast<double>(done_) / seconds : 0;
  const double eta = rate > 0 && total_ > done_ ? static_cast<double>(total_ - done_) / rate : 0;
  if (style_ == ProgressStyle::json) {
    const json::Value line = {{"stage", stage_}, {"done", done_},      {"total", total_}, {"unit", unit_},
                              {"rate", rate},    {"seconds", seconds}, {"eta", eta}};
    fmt::print(stderr, "{}\n", json::print(line));
    return;
  }
  const std::string text =
      last ? fmt::format("{}: {} {} in {:.1f} s, {}", stage_, scaled(static_cast<double>(done_)), unit_,
                         seconds, rate_text(rate, unit_))
           : fmt::format("{}: {:3.0f} %, {}, {} left", stage_, 100 * fraction, rate_text(rate, unit_),
                         clock_text(eta));
  if (style_ == ProgressStyle::bar) {
    constexpr int cells = 24;
    const int full = static_cast<int>(fraction * cells);
    fmt::print(stderr, "\r[{}{}] {}\x1b[K{}", std::string(static_cast<std::size_t>(full), '#'),
               std::string(static_cast<std::size_t>(cells - full), '.'), text, last ? "\n" : "");
  } else {
    fmt::print(stderr, "{}\n", text);
  }
  std::fflush(stderr);
}

}  // namespace ssphh::app
