#include <mutex>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <ssphh/core/log.h>

namespace ssphh {
namespace {

struct State {
  std::mutex mutex;
  LogLevel threshold = LogLevel::info;
  LogSink sink;
  spdlog::logger fallback{"ssphh", std::make_shared<spdlog::sinks::stderr_sink_st>()};

  State() {
    fallback.set_pattern("%v");
    fallback.flush_on(spdlog::level::trace);
  }
};

State& state() {
  static State instance;
  return instance;
}

std::string line(LogLevel level, const std::string& message) {
  return level == LogLevel::info ? message : fmt::format("{}: {}", name_of(level), message);
}

}  // namespace

void set_log_level(LogLevel threshold) {
  std::lock_guard lock(state().mutex);
  state().threshold = threshold;
}

LogSink set_log_sink(LogSink sink) {
  std::lock_guard lock(state().mutex);
  std::swap(state().sink, sink);
  return sink;
}

void log(LogLevel level, const std::string& message) {
  std::lock_guard lock(state().mutex);
  if (level < state().threshold) return;
  if (state().sink) {
    state().sink(level, message);
  } else {
    state().fallback.info("{}", line(level, message));
  }
}

}  // namespace ssphh
