/// The property checker itself: planted false claims shrink to the least that breaks them.

#include "property.h"

#include <stdexcept>

#include <gmock/gmock.h>

namespace ssphh::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The line of the simplest counterexample.
std::string counterexample(const testing::AssertionResult& verdict) {
  const std::string text = verdict.message();
  const std::size_t from = text.find("\nfor  ");
  return from == std::string::npos ? "none" : text.substr(from + 6, text.find('\n', from + 1) - from - 6);
}

TEST(Property, WhatIsTrueHoldsForEveryCase) {
  int calls = 0;
  EXPECT_TRUE(for_all(integers(-9, 9)).cases(37).holds([&](int n) { return ++calls, n * n >= 0; }));
  EXPECT_EQ(calls, 37);
}

TEST(Property, IntegersShrinkToTheFirstThatFails) {
  EXPECT_EQ(counterexample(for_all(integers(0, 1000)).holds([](int n) { return n < 17; })), "17  ");
  EXPECT_EQ(counterexample(for_all(integers(-50, 50)).holds([](int n) { return n > -5; })), "-5  ");
  EXPECT_EQ(counterexample(for_all(integers(20, 90)).holds([](int) { return false; })), "20  ");
  EXPECT_EQ(counterexample(for_all(integers<std::uint64_t>(0, ~std::uint64_t{0})).holds([](std::uint64_t n) {
              return n < 1000000007;
            })),
            "1000000007  ");
}

TEST(Property, FloatsShrinkToFewDigits) {
  EXPECT_EQ(counterexample(for_all(floats(-100, 100)).holds([](float x) { return x < 2.5f; })), "3  ");
  EXPECT_EQ(counterexample(for_all(floats(-1, 1)).holds([](float x) { return x > -0.25f; })), "-0.25  ");
}

TEST(Property, ListsLoseWhatDoesNotMatter) {
  const auto numbers = lists(integers(0, 1000), 0, 40);
  EXPECT_EQ(counterexample(for_all(numbers).holds([](const std::vector<int>& list) {
              return std::all_of(list.begin(), list.end(), [](int n) { return n < 7; });
            })),
            "[7]  ");
  EXPECT_EQ(counterexample(for_all(numbers).holds(
                [](const std::vector<int>& list) { return std::is_sorted(list.begin(), list.end()); })),
            "[1, 0]  ");
  EXPECT_EQ(counterexample(for_all(lists(integers(0, 9), 3, 8)).holds([](const std::vector<int>& list) {
              return list.size() < 2 || list[1] < 6;
            })),
            "[0, 6, 0]  ");
}

TEST(Property, EveryArgumentShrinksAndTheOthersStay) {
  const auto verdict =
      for_all(integers(0, 100), one_of<char>({'a', 'b', 'c'}), vectors3(0, 9))
          .holds([](int n, char letter, const vec3& v) { return n < 10 || letter == 'a' || v.y < 4; });
  EXPECT_EQ(counterexample(verdict), "10  'b' (98, 0x62)  (0, 4, 0)  ");
}

TEST(Property, TheReportNamesClaimSeedAndCaseAndOneCaseRunsAlone) {
  const auto claim = [](float x) { return at_most(static_cast<double>(x), 0.5); };
  const auto verdict = for_all(floats(0, 1)).seed(7).holds(claim);
  EXPECT_THAT(verdict.message(), AllOf(HasSubstr("is more than 0.5"), HasSubstr("of seed 7")));
  int index = -1;
  const std::string text = verdict.message();
  ASSERT_EQ(std::sscanf(text.c_str() + text.find(".only("), ".only(%d)", &index), 1);
  EXPECT_STREQ(for_all(floats(0, 1)).seed(7).only(index).holds(claim).message(), text.c_str());
}

TEST(Property, AnExceptionIsAFailureThatShrinks) {
  const auto verdict = for_all(integers(0, 99)).holds([](int n) {
    if (n > 30) throw std::runtime_error("boom at " + std::to_string(n));
    return true;
  });
  EXPECT_EQ(counterexample(verdict), "31  ");
  EXPECT_THAT(verdict.message(), HasSubstr("throws boom at 31"));
}

TEST(Property, NotANumberIsMoreThanAnyLimit) {
  EXPECT_FALSE(at_most(NAN, 1e300));
  EXPECT_FALSE(at_most(1.01, 1));
  EXPECT_TRUE(at_most(1, 1));
}

TEST(Generators, ReachTheirEndsAndStayWithin) {
  int lowest = 0, highest = 0, zero = 0;
  EXPECT_TRUE(for_all(floats(-2, 3), directions()).cases(500).holds([&](float x, const vec3& d) {
    lowest += x == -2, highest += x == 3, zero += x == 0;
    return x >= -2 && x <= 3 && std::abs(glm::length(d) - 1) < 1e-6f;
  }));
  // One in 24 each: fewer than 5 of 500 has a chance of 1e-5.
  EXPECT_GT(std::min({lowest, highest, zero}), 4);
}

}  // namespace
}  // namespace ssphh::test
