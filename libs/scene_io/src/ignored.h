#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace ssphh::scene_io {

/// What a file holds and the loader leaves out, counted by kind.
class Ignored {
 public:
  void add(const std::string& what, std::uint64_t count = 1) {
    if (count == 0) return;
    const bool full = counts_.size() >= 200 && !counts_.contains(what);
    counts_[full ? "other things" : what] += count;
  }
  /// "WHAT (N)" in alphabetical order.
  std::vector<std::string> lines() const {
    std::vector<std::string> out;
    for (const auto& [what, count] : counts_) out.push_back(fmt::format("{} ({})", what, count));
    return out;
  }

 private:
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace ssphh::scene_io
