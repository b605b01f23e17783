#include <ssphh/core/parse_number.h>

namespace ssphh {

std::optional<std::vector<float>> parse_numbers(std::string_view text) {
  std::vector<float> numbers;
  for (;;) {
    const std::size_t comma = text.find(',');
    const auto number = parse_number<float>(text.substr(0, comma));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace ssphh
