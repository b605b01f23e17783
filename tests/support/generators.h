#pragma once
/// Random arguments for property.h, each with what is simpler than it.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>

namespace ssphh::test {

template <class T>
struct Generator {
  std::function<T(Pcg32&)> draw;
  /// Values simpler than one, the boldest first. A chain of them has an end.
  std::function<std::vector<T>(const T&)> simpler;
};

/// How a counterexample is shown. Of other types: an overload in the type's own namespace.
template <class T>
std::string describe(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return std::to_string(static_cast<std::underlying_type_t<T>>(value));
  else
    return ::testing::PrintToString(value);
}
inline std::string describe(float value) {
  std::ostringstream out;
  out.precision(std::numeric_limits<float>::max_digits10);
  out << value;
  return out.str();
}
inline std::string describe(const vec3& v) {
  return "(" + describe(v.x) + ", " + describe(v.y) + ", " + describe(v.z) + ")";
}
template <class T>
std::string describe(const std::vector<T>& values) {
  std::string text;
  for (const T& value : values) text += (text.empty() ? "" : ", ") + describe(value);
  return "[" + text + "]";
}

/// low ≤ n ≤ high, the ends more often than the rest; simplest is what is nearest to 0.
template <class T = int>
Generator<T> integers(T low, T high) {
  const auto draw = [=](Pcg32& random) -> T {
    const std::uint32_t kind = random.next() % 16;
    if (kind < 2) return kind == 0 ? low : high;
    const std::uint64_t bits = (std::uint64_t{random.next()} << 32) | random.next();
    const std::uint64_t span = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1;
    return static_cast<T>(static_cast<std::uint64_t>(low) + (span ? bits % span : bits));
  };
  const T simplest = std::clamp(T(0), low, high);
  const auto simpler = [=](const T& n) {
    std::vector<T> result;
    // The whole way to the simplest, all but half of it, all but a quarter, ... all but one.
    for (T step = static_cast<T>(n - simplest); step != 0; step /= 2)
      result.push_back(static_cast<T>(n - step));
    return result;
  };
  return {draw, simpler};
}

/// Of things drawn inside a property: no seed is simpler than another.
inline Generator<std::uint64_t> seeds() {
  return {[](Pcg32& random) {
            const std::uint64_t high = random.next();
            return (high << 32) | random.next();
          },
          [](std::uint64_t) { return std::vector<std::uint64_t>(); }};
}

/// low ≤ x ≤ high, sometimes exactly an end or 0; simplest is what is nearest to 0 and has few digits.
inline Generator<float> floats(float low, float high) {
  const float simplest = std::clamp(0.0f, low, high);
  const auto draw = [=](Pcg32& random) {
    const std::uint32_t kind = random.next() % 24;
    if (kind < 3) return kind == 0 ? low : kind == 1 ? high : simplest;
    return std::min(low + (high - low) * random.uniform(), high);
  };
  const auto simpler = [=](const float& x) {
    std::vector<float> result;
    const auto propose = [&](float y) {
      if (y >= low && y <= high && std::abs(y - simplest) < std::abs(x - simplest)) result.push_back(y);
    };
    propose(simplest);
    for (const float digits : {1.0f, 10.0f, 100.0f}) propose(std::trunc(x * digits) / digits);
    // Halving ends where it makes nothing simpler any more.
    if (std::abs(x - simplest) > 1e-6f * (high - low)) propose(simplest + (x - simplest) / 2);
    propose(x - std::copysign(1.0f, x - simplest));
    return result;
  };
  return {draw, simpler};
}

/// Simplest is the first.
template <class T>
Generator<T> one_of(std::vector<T> values) {
  const auto draw = [values](Pcg32& random) { return values[random.next() % values.size()]; };
  const auto simpler = [values](const T& value) {
    return std::vector<T>(values.begin(), std::find(values.begin(), values.end(), value));
  };
  return {draw, simpler};
}

/// Parts change one at a time.
inline Generator<vec3> vectors3(float low, float high) {
  const Generator<float> part = floats(low, high);
  const auto draw = [part](Pcg32& random) {
    const float x = part.draw(random), y = part.draw(random);
    return vec3(x, y, part.draw(random));
  };
  const auto simpler = [part](const vec3& v) {
    std::vector<vec3> result;
    for (glm::length_t c = 0; c < 3; ++c) {
      for (const float x : part.simpler(v[c])) (result.emplace_back(v))[c] = x;
    }
    return result;
  };
  return {draw, simpler};
}

/// Uniform on the sphere; simpler are the axes.
inline Generator<vec3> directions() {
  const std::vector<vec3> axes{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}, {-1, 0, 0}};
  const auto draw = [](Pcg32& random) {
    const float z = 2 * random.uniform() - 1, turn = 2 * pi * random.uniform();
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    return glm::normalize(vec3(r * std::cos(turn), r * std::sin(turn), z));
  };
  const auto simpler = [axes](const vec3& d) {
    return std::vector<vec3>(axes.begin(), std::find(axes.begin(), axes.end(), d));
  };
  return {draw, simpler};
}

/// Simpler has fewer elements, or simpler ones.
template <class T>
Generator<std::vector<T>> lists(Generator<T> element, int fewest, int most) {
  const Generator<int> size = integers(fewest, most);
  const auto draw = [=](Pcg32& random) {
    std::vector<T> values(static_cast<std::size_t>(size.draw(random)));
    for (T& value : values) value = element.draw(random);
    return values;
  };
  const auto simpler = [=](const std::vector<T>& values) {
    std::vector<std::vector<T>> result;
    for (std::size_t cut = values.size(); cut > 0; cut /= 2) {
      for (std::size_t at = 0; at + cut <= values.size(); at += cut) {
        if (values.size() - cut < static_cast<std::size_t>(fewest)) break;
        std::vector<T> shorter = values;
        const auto from = shorter.begin() + static_cast<std::ptrdiff_t>(at);
        shorter.erase(from, from + static_cast<std::ptrdiff_t>(cut));
        result.push_back(std::move(shorter));
      }
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (const T& value : element.simpler(values[i])) (result.emplace_back(values))[i] = value;
    }
    return result;
  };
  return {draw, simpler};
}

}  // namespace ssphh::test
