#pragma once
/// Claims about every argument, checked with random ones. What fails is made simpler as long as it still
/// fails:
///
///   EXPECT_TRUE(for_all(integers(0, 9), floats(-1, 1)).holds([](int n, float x) {
///     return at_most(std::abs(std::pow(x, n)), 1);
///   }));
///
/// The environment widens the search: SSPHH_PROPERTY_CASES=10000 SSPHH_PROPERTY_SEED=42 test_sh ...

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "generators.h"

namespace ssphh::test {

/// NaN is more than anything.
inline ::testing::AssertionResult at_most(double value, double limit) {
  if (value <= limit) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << value << " is more than " << limit;
}

template <class... Values>
class ForAll {
 public:
  explicit ForAll(Generator<Values>... generators) : generators_(std::move(generators)...) {}

  ForAll& cases(int count) { return cases_ = count, *this; }
  ForAll& seed(std::uint64_t seed) { return seed_ = seed, *this; }
  /// One case alone.
  ForAll& only(int index) { return first_ = index, *this; }

  /// `property(const Values&...)` returns bool or AssertionResult; what it throws is a failure.
  template <class Property>
  ::testing::AssertionResult holds(const Property& property) const {
    const std::uint64_t seed = setting("SSPHH_PROPERTY_SEED", seed_);
    const auto count = static_cast<int>(setting("SSPHH_PROPERTY_CASES", static_cast<std::uint64_t>(cases_)));
    for (int index = std::max(first_, 0); index < (first_ < 0 ? count : first_ + 1); ++index) {
      Pcg32 random(seed, static_cast<std::uint64_t>(index));
      // Braces: drawn from left to right.
      Arguments arguments = std::apply(
          [&](const auto&... generator) { return Arguments{generator.draw(random)...}; }, generators_);
      ::testing::AssertionResult verdict = judge(property, arguments);
      if (verdict) continue;
      const std::string drawn = text(arguments);
      int tries = 0;
      while (simplify(property, arguments, verdict, tries, std::index_sequence_for<Values...>())) {
      }
      return ::testing::AssertionFailure()
             << verdict.message() << "\nfor  " << text(arguments) << "\nfrom " << drawn << "\ncase " << index
             << " of seed " << seed << "; alone again with .seed(" << seed << ").only(" << index << ")";
    }
    return ::testing::AssertionSuccess();
  }

 private:
  using Arguments = std::tuple<Values...>;
  static constexpr int most_tries = 2000;

  static std::uint64_t setting(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 0) : otherwise;
  }

  template <class Property>
  static ::testing::AssertionResult judge(const Property& property, const Arguments& arguments) {
    try {
      return ::testing::AssertionResult(std::apply(property, arguments));
    } catch (const std::exception& e) {
      return ::testing::AssertionFailure() << "throws " << e.what();
    }
  }

  /// Takes the first simpler value of any argument with which the property still fails.
  template <class Property, std::size_t... i>
  bool simplify(const Property& property, Arguments& arguments, ::testing::AssertionResult& verdict,
                int& tries, std::index_sequence<i...>) const {
    const auto one = [&](auto place) {
      auto& value = std::get<place()>(arguments);
      const auto before = value;
      for (const auto& candidate : std::get<place()>(generators_).simpler(before)) {
        if (++tries > most_tries) break;
        value = candidate;
        ::testing::AssertionResult next = judge(property, arguments);
        if (!next) return verdict = next, true;
      }
      value = before;
      return false;
    };
    return (one(std::integral_constant<std::size_t, i>()) || ...);
  }

  static std::string text(const Arguments& arguments) {
    std::ostringstream out;
    std::apply([&](const auto&... value) { ((out << describe(value) << "  "), ...); }, arguments);
    return out.str();
  }

  std::tuple<Generator<Values>...> generators_;
  int cases_ = 100, first_ = -1;
  std::uint64_t seed_ = 1;
};

template <class... Values>
ForAll<Values...> for_all(Generator<Values>... generators) {
  return ForAll<Values...>(std::move(generators)...);
}

}  // namespace ssphh::test
