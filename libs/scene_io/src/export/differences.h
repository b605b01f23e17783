#pragma once
/// Collects what another renderer computes differently: one line per kind, with the names it concerns.

#include <map>
#include <string>
#include <vector>

namespace ssphh::scene_io {

class Differences {
 public:
  void add(const std::string& kind, const std::string& name) {
    names_[kind].push_back(name.empty() ? "(unnamed)" : name);
  }

  /// "kind: first, second, third and 4 more", in alphabetical order of the kinds.
  std::vector<std::string> lines() const {
    constexpr std::size_t shown = 5;
    std::vector<std::string> out;
    for (const auto& [kind, names] : names_) {
      std::string line = kind + ": ";
      for (std::size_t i = 0; i < names.size() && i < shown; ++i) line += (i > 0 ? ", " : "") + names[i];
      if (names.size() > shown) line += " and " + std::to_string(names.size() - shown) + " more";
      out.push_back(std::move(line));
    }
    return out;
  }

 private:
  std::map<std::string, std::vector<std::string>> names_;
};

}  // namespace ssphh::scene_io
