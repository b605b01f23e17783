#include <gtest/gtest.h>

#include <ssphh/core/nearest_word.h>

namespace ssphh {
namespace {

TEST(NearestWord, WantsHalfOfTheName) {
  EXPECT_EQ(nearest_word("recieve", {"receive", "relative"}), "receive");
  EXPECT_EQ(nearest_word("zzzz", {"receive", "relative"}), "");
  EXPECT_EQ(nearest_word("a", {}), "");
}

TEST(NearestWord, AcceptsAsManyEditsAsHalfOfTheLetters) {
  EXPECT_EQ(nearest_word("four", {"foxx"}), "foxx") << "two of four";
  EXPECT_EQ(nearest_word("four", {"fxxx"}), "") << "three of four";
  EXPECT_EQ(nearest_word("threx", {"thxxx"}), "thxxx") << "two of five";
  EXPECT_EQ(nearest_word("threx", {"txxxx"}), "") << "three of five";
}

TEST(NearestWord, CountsLettersThatAreMissingAddedOrOthers) {
  EXPECT_EQ(nearest_word("abcd", {"abcdefg", "abcde"}), "abcde") << "one is missing, not three";
  EXPECT_EQ(nearest_word("abcdef", {"abc", "abcde"}), "abcde") << "one is too many, not three";
  EXPECT_EQ(nearest_word("abcd", {"bcde", "abxd"}), "abxd") << "one is another, not two";
  EXPECT_EQ(nearest_word("abcd", {"abcx", "abxd"}), "abcx") << "the first of equals";
}

TEST(NearestWord, HintNamesOneOrAll) {
  EXPECT_EQ(nearest_hint("recieve", {"receive", "relative"}), "did you mean \"receive\"?");
  EXPECT_EQ(nearest_hint("zzzz", {"receive", "relative"}), "known: receive, relative");
}

}  // namespace
}  // namespace ssphh
