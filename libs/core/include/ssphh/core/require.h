#pragma once
/// Contracts of public entries.

#include <ssphh/core/error.h>

namespace ssphh {

/// Throws Error(where, problem); out of line, so that a check costs a hot loop one comparison.
[[noreturn]] void refuse(const char* where, const char* problem);
[[noreturn]] void refuse(const std::string& where, const std::string& problem);

/// What a caller passes, or an implementation of an interface returns, is as the entry asks; else an Error.
/// SSPHH_CHECK is for what only this library's own mistakes can break.
inline void require(bool condition, const char* where, const char* problem) {
  if (!condition) [[unlikely]]
    refuse(where, problem);
}

}  // namespace ssphh
