#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include <ssphh/core/check_handler.h>
#include <ssphh/core/require.h>

namespace ssphh {
namespace {

std::atomic<CheckHandler> check_handler = nullptr;

std::string message(const std::string& where, const std::string& problem, const std::string& hint) {
  std::string text = where.empty() ? problem : where + ": " + problem;
  if (!hint.empty()) text += " (" + hint + ")";
  return text;
}

}  // namespace

Error::Error(std::string where, std::string problem, std::string hint)
    : std::runtime_error(message(where, problem, hint)),
      where_(std::move(where)),
      problem_(std::move(problem)),
      hint_(std::move(hint)) {}

void refuse(const char* where, const char* problem) {
  throw Error(where, problem);
}
void refuse(const std::string& where, const std::string& problem) {
  throw Error(where, problem);
}

void stop_cancelled() {
  throw Cancelled();
}

CheckHandler set_check_handler(CheckHandler handler) {
  return check_handler.exchange(handler);
}

void check_failed(const char* expression, const char* file, int line) {
  if (const CheckHandler handler = check_handler) {
    handler(expression, file, line);
  } else {
    std::fprintf(stderr, "%s:%d: internal error, please report: check failed: %s\n", file, line, expression);
  }
  std::abort();
}

}  // namespace ssphh
