#pragma once
/// Command lines in parts.

#include <string>
#include <vector>

namespace ssphh::test {

inline std::vector<std::string> joined(std::vector<std::string> arguments,
                                       const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace ssphh::test
