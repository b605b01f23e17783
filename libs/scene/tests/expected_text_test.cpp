// What counts as the same text, for the tests that compare long ones.

#include "expected_text.h"

#include <gtest/gtest.h>

#include "scene_text.h"

namespace ssphh::test {
namespace {

TEST(ExpectedText, NumbersMayDifferByRoundingAndNothingElseAtAll) {
  EXPECT_TRUE(same_line("a 0.5 b -1e-9", "a 0.500001 b 0"));
  EXPECT_TRUE(same_line("x=12345.6", "x=12345.7"));
  EXPECT_FALSE(same_line("a 0.5", "a 0.5001"));
  EXPECT_FALSE(same_line("a 0.5", "a -0.5"));
  EXPECT_FALSE(same_line("a 0.5", "b 0.5"));
  EXPECT_FALSE(same_line("a 0.5", "a 0.5 "));
  EXPECT_FALSE(same_line("a 0.5 0.5", "a 0.5"));
  EXPECT_FALSE(same_line("1 2", "2 1"));
  EXPECT_FALSE(same_line("node-1", "node1"));
  EXPECT_EQ(lines_of("a\n\nb"), (std::vector<std::string>{"a", "", "b"}));
}

TEST(ExpectedText, LongArraysTellTheirElementsApart) {
  std::vector<float> values(100, 1);
  values[40] = 2;
  const std::string before = field_text(values);
  std::swap(values[40], values[41]);
  EXPECT_FALSE(same_line(field_text(values), before));
  EXPECT_FALSE(same_line(field_text(std::vector<float>(99, 1)), field_text(std::vector<float>(100, 1))));
}

}  // namespace
}  // namespace ssphh::test
