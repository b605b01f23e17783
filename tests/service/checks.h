#pragma once
/// The checks of the probe. Each uses services of its own, so that they can run side by side on one broker.

#include <functional>
#include <string>
#include <vector>

namespace ssphh::probe {

struct Check {
  const char* name;
  const char* source;  ///< the rule: RFC, or "dependable" for what it leaves open
  std::function<bool(const std::string& endpoint)> passes;
};

/// Checks that leave the broker as it was.
std::vector<Check> rules();
/// And such that take times in heartbeats, which the broker sends every `beat` milliseconds.
std::vector<Check> times(int beat);
/// Hostile messages: after each, the broker must still serve others.
std::vector<Check> hostile();

}  // namespace ssphh::probe
