#include <algorithm>

#include <ssphh/bake/light_scope.h>

namespace ssphh::bake {

bool LightScope::has(const std::optional<std::vector<std::uint32_t>>& list, std::size_t i) {
  return !list || std::ranges::binary_search(*list, i);
}

}  // namespace ssphh::bake
