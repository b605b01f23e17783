#pragma once
/// Results number by number, for a file that says what they were (expected_text.h).

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <ssphh/core/math.h>

#include "expected_text.h"

namespace ssphh::test {

/// Lines of a name and numbers.
class NumberList {
 public:
  /// Numbers, vectors, lists of them and empty or held values of them.
  template <class... Values>
  void add(std::string_view name, const Values&... values) {
    text_ += name;
    (put(values), ...);
    text_ += '\n';
  }
  /// As expect_text_of.
  void expect(const std::string& file) const { expect_text_of(file, text_); }

 private:
  template <class Value>
  void put(const Value& value) {
    if constexpr (std::is_floating_point_v<Value>) {
      text_ += fmt::format(" {:.7g}", value + Value(0));  // no sign of a zero
    } else if constexpr (std::is_enum_v<Value>) {
      put(static_cast<int>(value));
    } else {
      text_ += fmt::format(" {}", value);
    }
  }
  template <glm::length_t n, class T, glm::qualifier q>
  void put(const glm::vec<n, T, q>& v) {
    for (glm::length_t c = 0; c < n; ++c) put(v[c]);
  }
  template <class T>
  void put(const std::optional<T>& held) {
    held ? put(*held) : put("none");
  }
  template <class T>
  void put(const std::vector<T>& values) {
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(std::span<const T> values) {
    for (const T& value : values) put(value);
  }
  template <class T, std::size_t n>
  void put(const std::array<T, n>& values) {
    for (const T& value : values) put(value);
  }

  std::string text_;
};

}  // namespace ssphh::test
