#include <gmock/gmock.h>

#include <ssphh/core/parse_number.h>

namespace ssphh {
namespace {

using testing::ElementsAre;

TEST(ParseNumber, IsTheWholeText) {
  EXPECT_EQ(parse_number<float>("-0.5"), -0.5f);
  EXPECT_EQ(parse_number<double>("1e-3"), 1e-3);
  EXPECT_EQ(parse_number<int>("-12"), -12);
  EXPECT_EQ(parse_number<std::uint64_t>("18446744073709551615"), UINT64_MAX);
  for (const char* bad :
       {"", " 1", "1 ", "+1", "1,", "1.5m", "0x1", "one", "inf", "-infinity", "nan", "1e39"})
    EXPECT_EQ(parse_number<float>(bad), std::nullopt) << bad;
  for (const char* bad : {"", "1.0", "2147483648", "1e3", "-"})
    EXPECT_EQ(parse_number<int>(bad), std::nullopt) << bad;
  EXPECT_EQ(parse_number<unsigned>("-1"), std::nullopt);
}

TEST(ParseNumber, EndsWhereTheTextEnds) {
  const std::string_view more = "12345";
  EXPECT_EQ(parse_number<int>(more.substr(0, 2)), 12);
  EXPECT_EQ(parse_number<double>(more.substr(1, 3)), 234);
}

TEST(ParseNumbers, ArePartedByCommas) {
  EXPECT_THAT(*parse_numbers("7"), ElementsAre(7));
  EXPECT_THAT(*parse_numbers("0,2.5,-1"), ElementsAre(0, 2.5f, -1));
  for (const char* bad : {"", ",", "1,", ",1", "1,,2", "1;2", "1, 2", "1,inf"})
    EXPECT_EQ(parse_numbers(bad), std::nullopt) << bad;
}

}  // namespace
}  // namespace ssphh
