#include <gtest/gtest.h>

#include <ssphh/core/nearest_word.h>

namespace ssphh {
namespace {

TEST(NearestWord, WantsHalfOfTheName) {
  EXPECT_EQ(nearest_word("recieve", {"receive", "relative"}), "receive");
  EXPECT_EQ(nearest_word("zzzz", {"receive", "relative"}), "");
  EXPECT_EQ(nearest_word("a", {}), "");
}

TEST(NearestWord, HintNamesOneOrAll) {
  EXPECT_EQ(nearest_hint("recieve", {"receive", "relative"}), "did you mean \"receive\"?");
  EXPECT_EQ(nearest_hint("zzzz", {"receive", "relative"}), "known: receive, relative");
}

}  // namespace
}  // namespace ssphh
