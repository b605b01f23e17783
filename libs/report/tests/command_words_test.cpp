#include "command_words.h"

#include <gmock/gmock.h>

#include "error_message.h"

namespace ssphh::report {
namespace {

using test::message_of;
using testing::ElementsAre;

TEST(Words, ArePartedByBlanksOutsideOfQuotes) {
  EXPECT_THAT(split_words("  a\tb\nc  ", "p"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(split_words(R"(a 'b "c' "d 'e" f"g h"i)", "p"), ElementsAre("a", "b \"c", "d 'e", "fg hi"));
  EXPECT_THAT(split_words(R"('' a "")", "p"), ElementsAre("", "a", ""));
  EXPECT_THAT(split_words("", "p"), ElementsAre());
  EXPECT_EQ(message_of([] { split_words("a \"b", "p"); }), "p: a quote is not closed");
}

TEST(Words, NamesStandBetweenBraces) {
  EXPECT_THAT(names_in("{a}x{bc}{}", "p"), ElementsAre("a", "bc", ""));
  EXPECT_THAT(names_in("a}b", "p"), ElementsAre());
  EXPECT_EQ(message_of([] { names_in("{a}{b", "p"); }), "p: '{' without '}' in {a}{b");
}

TEST(Words, NamesGiveWayToTheirLastValue) {
  const Parameters values = {{"a", "1"}, {"b", "{a}"}, {"a", "2"}};
  EXPECT_EQ(substitute("x{a}-{b}{c}{", values), "x2-{a}{c}{");
  EXPECT_EQ(substitute("{}", {{"", "nothing"}}), "{}");
  EXPECT_EQ(substitute("a", {{"a", "1"}}), "a");
}

TEST(Words, AreJoinedAsAShellWouldNeedThem) {
  EXPECT_EQ(join_words({"render", "a b", "it's", "", "--x=1,2", "$HOME", "@k/p.exr"}),
            R"(render 'a b' 'it'\''s' '' --x=1,2 '$HOME' @k/p.exr)");
  EXPECT_EQ(join_words({}), "");
  // Every character that may stand outside of quotes, and none of the others in ASCII.
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+./:,@%";
  for (char c = 33; c < 127; ++c)
    EXPECT_EQ(join_words({std::string(1, c)}).size() == 1, plain.find(c) != std::string::npos) << c;
}

}  // namespace
}  // namespace ssphh::report
