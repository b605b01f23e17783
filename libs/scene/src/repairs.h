#pragma once
/// Counts of what validate() mended, as one line per kind.

#include <map>
#include <string>
#include <vector>

namespace ssphh::scene {

class Repairs {
 public:
  /// `kind` reads after a count: "degenerate triangles removed".
  void count(const std::string& kind, std::size_t n = 1) {
    if (n > 0) counts_[kind] += n;
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> result;
    for (const auto& [kind, n] : counts_) result.push_back(std::to_string(n) + " " + kind);
    return result;
  }

 private:
  std::map<std::string, std::size_t> counts_;
};

}  // namespace ssphh::scene
