#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/enum_names.h>

namespace ssphh {

std::string none_of(std::string_view name, const std::vector<std::string>& known) {
  constexpr std::size_t shown = 64;  // bytes: a file's text may be of any length
  return fmt::format("\"{}{}\" is none of: {}", name.substr(0, shown), name.size() > shown ? "…" : "",
                     fmt::join(known, ", "));
}

}  // namespace ssphh
