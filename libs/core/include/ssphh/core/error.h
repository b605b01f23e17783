#pragma once
/// The kinds of failure: `Error` for bad input (what, where, what to do), `Cancelled` for a stop that was
/// asked for, `SSPHH_CHECK` for this library's own mistakes. "None" is a std::optional, never an exception.

#include <stdexcept>
#include <string>

namespace ssphh {

/// Bad input or a failing environment. `what()` reads "WHERE: PROBLEM (HINT)".
class Error : public std::runtime_error {
 public:
  /// `where`: file and place, option or object at fault; `problem`: what is wrong; `hint`: what the user can
  /// do.
  Error(std::string where, std::string problem, std::string hint = {});

  const std::string& where() const { return where_; }
  const std::string& problem() const { return problem_; }
  const std::string& hint() const { return hint_; }

 private:
  std::string where_, problem_, hint_;
};

/// Thrown out of long work when its CancelToken was triggered.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// Throws Cancelled; out of line, as refuse() is (require.h): headers serve programs without exceptions.
[[noreturn]] void stop_cancelled();

[[noreturn]] void check_failed(const char* expression, const char* file, int line);

}  // namespace ssphh

/// Aborts with the place when a programmer's assumption is broken; also active in release builds.
#define SSPHH_CHECK(condition) ((condition) ? void(0) : ::ssphh::check_failed(#condition, __FILE__, __LINE__))
