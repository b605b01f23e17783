#pragma once
/// Which part of a set's light is found anew.

#include <cstdint>
#include <optional>
#include <vector>

namespace ssphh::bake {

/// Indices, ascending. Everything else keeps its bits.
struct LightScope {
  std::optional<std::vector<std::uint32_t>> probes;  ///< none: all
  std::optional<std::vector<std::uint32_t>> groups;  ///< light groups; none: all

  /// Throws Error for indices that do not ascend, or of none of so many.
  void require_within(std::size_t probe_count, std::size_t group_count) const;
  bool has_probe(std::size_t i) const { return has(probes, i); }
  bool has_group(std::size_t g) const { return has(groups, g); }

 private:
  static bool has(const std::optional<std::vector<std::uint32_t>>& list, std::size_t i);
};

}  // namespace ssphh::bake
