#pragma once
/// Numbers of things, as texts say them.

#include <concepts>
#include <string>
#include <string_view>

namespace ssphh {

/// "1 worker", "3 workers", "0 workers". `several`: what stands in place of `noun` where there is not one, if
/// that is not the noun and an s: "retries", "jobs are".
template <std::integral T>
std::string counted(T count, std::string_view noun, std::string_view several = {}) {
  const bool one = count == 1;
  std::string text = std::to_string(count) + ' ';
  text += one || several.empty() ? noun : several;
  if (!one && several.empty()) text += 's';
  return text;
}

}  // namespace ssphh
