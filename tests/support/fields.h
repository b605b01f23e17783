#pragma once
/// The fields of plain structs one by one, for tests of "every field". A struct is taken apart by its own
/// `fields(visit, s)`, a structured binding: with a field more or less it no longer compiles, so that no test
/// forgets one.

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/hash.h>
#include <ssphh/core/math.h>

namespace ssphh::test {

void fields(auto& visit, Hash128& h) {
  auto& [high, low] = h;
  visit("high", high), visit("low", low);
}
template <class A, class B>
void fields(auto& visit, std::pair<A, B>& p) {
  visit("first", p.first), visit("second", p.second);
}
void fields(auto& visit, vec3& v) {
  visit("x", v.x), visit("y", v.y), visit("z", v.z);
}
void fields(auto& visit, mat4& m) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) visit(fmt::format("{}.{}", column, row), m[column][row]);
}

/// Calls `leaf(path, value)` for every number, choice and text within a value; an optional also has "given"
/// and a list "size"; of a map the values.
template <class Leaf>
class FieldWalk {
 public:
  explicit FieldWalk(Leaf leaf) : leaf_(std::move(leaf)) {}

  template <class T>
  void operator()(const std::string& name, T& value) {
    const std::string outer = path_;
    path_ += (outer.empty() ? "" : "/") + name;
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string>) {
      leaf_(path_, value);
    } else {
      descend(value);
    }
    path_ = outer;
  }

 private:
  template <class T>
  void descend(std::optional<T>& value) {
    bool given = value.has_value();
    (*this)("given", given);
    if (given && !value) value.emplace();
    if (!given) value.reset();
    if (value) (*this)("value", *value);
  }
  template <class T>
  void descend(std::vector<T>& values) {
    std::size_t size = values.size();
    (*this)("size", size);
    values.resize(size);
    for (std::size_t i = 0; i < values.size(); ++i) (*this)(std::to_string(i), values[i]);
  }
  template <class T>
  void descend(std::map<std::string, T>& values) {
    for (auto& [name, value] : values) (*this)(name, value);
  }
  template <class T>
  void descend(T& value) {
    fields(*this, value);
  }

  Leaf leaf_;
  std::string path_;
};

/// Another value that differs as little as can be; of 64-bit numbers the upper half, which is easily lost.
template <class T>
void change(T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    value = !value;
  } else if constexpr (std::is_same_v<T, std::size_t>) {
    value = value < 1000 ? value + 1 : value ^ (std::uint64_t{1} << 40);
  } else if constexpr (std::is_integral_v<T>) {
    value = static_cast<T>(value + 1);
  } else if constexpr (std::is_floating_point_v<T>) {
    value = std::nextafter(value, std::numeric_limits<T>::max());
  } else if constexpr (std::is_enum_v<T>) {
    value = value == T{} ? static_cast<T>(1) : T{};
  } else {
    value += "x";
  }
}

/// All leaves as text, with every bit.
template <class T>
std::map<std::string, std::string> field_texts(T value) {
  std::map<std::string, std::string> texts;
  FieldWalk walk([&](const std::string& path, auto& leaf) {
    using Value = std::remove_reference_t<decltype(leaf)>;
    std::string& text = texts[path];
    if constexpr (std::is_enum_v<Value>) {
      text = fmt::format("choice {}", static_cast<int>(leaf));
    } else if constexpr (std::is_floating_point_v<Value>) {
      text = fmt::format("{:a}", leaf);
    } else {
      text = fmt::format("{}", leaf);
    }
  });
  walk("", value);
  return texts;
}

/// Says which fields differ.
template <class T>
void expect_same_fields(const T& got, const T& wanted) {
  const auto texts = field_texts(got), expected = field_texts(wanted);
  for (const auto& [field, text] : expected) {
    const auto found = texts.find(field);
    EXPECT_EQ(found == texts.end() ? "missing" : found->second, text) << "\"" << field << "\"";
  }
  EXPECT_EQ(texts.size(), expected.size()) << "fields";
}

/// Calls check(path, changed) for each leaf, with a copy of `value` in which it alone is another.
template <class T, class Check>
void with_each_field_changed(const T& value, const Check& check) {
  for (int wanted = 0;; ++wanted) {
    T changed = value;
    int at = 0;
    std::string field;
    FieldWalk walk([&](const std::string& path, auto& leaf) {
      if (at++ == wanted) field = path, change(leaf);
    });
    walk("", changed);
    if (at <= wanted) return;
    check(field, changed);
  }
}

/// Fields, by the beginning of their path, that do not decide a result, each with the reason.
using Undecisive = std::map<std::string, std::string>;

/// Every field but the undecisive ones changes the key, each to one of its own.
template <class T, class Key>
void expect_a_key_of_every_field(const T& request, const Key& key, const Undecisive& undecisive = {}) {
  const std::string base = key(request).hex();
  std::map<std::string, std::string> seen{{base, "the request without a change"}};
  std::map<std::string, int> met;
  with_each_field_changed(request, [&](const std::string& field, const T& changed) {
    const std::string hex = key(changed).hex();
    for (const auto& [begin, reason] : undecisive) {
      if (!field.starts_with(begin)) continue;
      ++met[begin];
      EXPECT_EQ(hex, base) << "\"" << field << "\" changes the key: " << reason;
      return;
    }
    const auto [same, fresh] = seen.emplace(hex, field);
    EXPECT_TRUE(fresh) << "another \"" << field << "\" has the key of " << same->second;
  });
  for (const auto& [begin, reason] : undecisive)
    EXPECT_GT(met[begin], 0) << "no field is \"" << begin << "\"";
}

}  // namespace ssphh::test
