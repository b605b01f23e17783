#include <algorithm>

#include <ssphh/bake/light_scope.h>
#include <ssphh/core/require.h>

namespace ssphh::bake {

void LightScope::require_within(std::size_t probe_count, std::size_t group_count) const {
  const auto check = [](const auto& list, std::size_t count, const char* problem) {
    if (!list) return;
    const bool ascends = std::ranges::is_sorted(*list, std::ranges::less_equal{});
    require(ascends && (list->empty() || list->back() < count), "scope of light", problem);
  };
  check(probes, probe_count, "its probes must ascend and be of the set");
  check(groups, group_count, "its light groups must ascend and be of the set");
}

bool LightScope::has(const std::optional<std::vector<std::uint32_t>>& list, std::size_t i) {
  return !list || std::ranges::binary_search(*list, i);
}

}  // namespace ssphh::bake
