#pragma once
/// JSON as tests read it.

#include <cstddef>
#include <ostream>
#include <string_view>

#include <ssphh/core/json.h>

namespace ssphh::json {

/// As GoogleTest shows it.
inline void PrintTo(const Value& value, std::ostream* out) {
  *out << print(value);
}

}  // namespace ssphh::json

namespace ssphh::test {

/// Constant: of a variable, a member that is not there would be added as null, and equal another such.
inline const json::Value parse_json(std::string_view text) {
  return json::parse(text, "the test's JSON");
}

/// Null for what is no JSON.
inline const json::Value parse_json_if_any(std::string_view text) {
  return json::try_parse(text).value_or(json::Value());
}

inline float float_of(const json::Value& number) {
  return static_cast<float>(number.number());
}

inline std::size_t count_of(const json::Value& number) {
  return static_cast<std::size_t>(number.number());
}

}  // namespace ssphh::test
