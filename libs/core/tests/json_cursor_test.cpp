#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/json_cursor.h>

#include "error_message.h"

namespace ssphh::json {
namespace {

using test::message_of;

/// What is said of "v" when it is read so.
template <class Read>
std::string said_of(const std::string& value, const Read& read) {
  const std::string file = "f";
  const Value document = parse(R"({"v":)" + value + "}", file);
  return message_of([&] { read(Cursor(document, file)["v"]); });
}

TEST(JsonCursor, AFormatAndItsVersionAreThoseThatAreRead) {
  const auto format = [](const Cursor& v) { v.expect_format("a-thing", 3); };
  EXPECT_EQ(said_of(R"({"format":"a-thing","version":3})", format), "no error");
  EXPECT_EQ(said_of(R"({"format":"a-thin","version":3})", format), "f: v.format: must be \"a-thing\"");
  EXPECT_EQ(said_of(R"({"format":"a-thing"})", format), "f: v: \"version\" is missing");
  for (const char* other : {"2", "4", "3.5", "\"3\"", "[3]"}) {
    EXPECT_EQ(said_of(fmt::format(R"({{"format":"a-thing","version":{}}})", other), format),
              fmt::format("f: v.version: the version is {}; this program reads version 3", other));
  }
}

TEST(JsonCursor, WholeNumbersLieBetweenTheirLimits) {
  const auto integer = [](const Cursor& v) { v.integer(-3, 7); };
  for (const char* good : {"-3", "0", "7", "7.0", "-3.0"})
    EXPECT_EQ(said_of(good, integer), "no error") << good;
  for (const char* bad : {"-4", "8", "7.5", "8.0", "18446744073709551615"})
    EXPECT_EQ(said_of(bad, integer), "f: v: " + std::string(bad) + " must be an integer from -3 to 7");
  EXPECT_EQ(said_of("\"1\"", integer), "f: v: must be a number, not string");
  const auto all = [](const Cursor& v) { EXPECT_EQ(v.integer(INT64_MIN, INT64_MAX), INT64_MAX); };
  EXPECT_EQ(said_of("9223372036854775807", all), "no error");
  EXPECT_NE(said_of("9223372036854775808", all), "no error") << "is no negative number";
  const auto whole = [](const Cursor& v) { v.unsigned_integer(); };
  for (const char* good : {"0", "9007199254740992"}) EXPECT_EQ(said_of(good, whole), "no error") << good;
  for (const char* bad : {"-1", "9007199254740993"}) EXPECT_NE(said_of(bad, whole), "no error") << bad;
  const auto few = [](const Cursor& v) { EXPECT_EQ(v.unsigned_integer(7), 7u); };
  EXPECT_EQ(said_of("7", few), "no error");
  EXPECT_EQ(said_of("8", few), "f: v: 8 must be an integer from 0 to 7");
  const auto index = [](const Cursor& v) { EXPECT_EQ(v.index(3, "things"), 2); };
  EXPECT_EQ(said_of("2", index), "no error");
  EXPECT_EQ(said_of("3", index), "f: v: index 3 out of range, the file has 3 things");
  const auto far = [](const Cursor& v) { EXPECT_EQ(v.index(std::size_t{1} << 40, "things"), INT32_MAX); };
  EXPECT_EQ(said_of("2147483647", far), "no error");
  EXPECT_EQ(said_of("2147483648", far),
            "f: v: index 2147483648 out of range, the file has 1099511627776 things");
}

TEST(JsonCursor, NumbersFitAFloat) {
  const auto number = [](const Cursor& v) { v.number(); };
  EXPECT_EQ(said_of("-3e38", number), "no error");
  EXPECT_EQ(said_of("3.40282347e+38", number), "no error") << "the largest in nine digits";
  EXPECT_EQ(said_of("4e38", number), "f: v: 4e+38 is too large a number");
  EXPECT_EQ(said_of("true", number), "f: v: must be a number, not boolean");
  const auto precise = [](const Cursor& v) { EXPECT_EQ(v.precise_number(), 0.1); };
  EXPECT_EQ(said_of("0.1", precise), "no error");
  const auto between = [](const Cursor& v) { v.number(1, 2); };
  for (const char* good : {"1", "2"}) EXPECT_EQ(said_of(good, between), "no error");
  for (const char* bad : {"0.5", "2.5"})
    EXPECT_EQ(said_of(bad, between), "f: v: " + std::string(bad) + " must be from 1 to 2");
  const auto least = [](const Cursor& v) { v.number(1, std::numeric_limits<float>::infinity()); };
  EXPECT_EQ(said_of("0.5", least), "f: v: 0.5 must be at least 1");
  const auto any = [](const Cursor& v) { v.number(1, std::numeric_limits<float>::max()); };
  EXPECT_EQ(said_of("0.5", any), "f: v: 0.5 must be at least 1") << "a limit that says nothing is not told";
}

TEST(JsonCursor, ValuesAreOfTheKindThatIsRead) {
  EXPECT_EQ(said_of("true", [](const Cursor& v) { EXPECT_TRUE(v.boolean()); }), "no error");
  EXPECT_EQ(said_of("1", [](const Cursor& v) { v.boolean(); }), "f: v: must be true or false, not number");
  EXPECT_EQ(said_of("1", [](const Cursor& v) { v.text(); }), "f: v: must be a string, not number");
  EXPECT_EQ(said_of("1", [](const Cursor& v) { v.size(); }), "f: v: must be an array, not number");
  EXPECT_EQ(said_of("[]", [](const Cursor& v) { v.find("x"); }), "f: v: must be an object, not array");
  EXPECT_EQ(said_of("[]", [](const Cursor& v) { v.only({"x"}); }), "f: v: must be an object, not array");
  EXPECT_EQ(said_of("{}", [](const Cursor& v) { v["x"]; }), "f: v: \"x\" is missing");
}

TEST(JsonCursor, TextsHaveALength) {
  const auto three = [](const Cursor& v) { EXPECT_EQ(v.text(3), "abc"); };
  EXPECT_EQ(said_of("\"abc\"", three), "no error");
  EXPECT_EQ(said_of("\"abcd\"", three), "f: v: is longer than 3 bytes");
}

TEST(JsonCursor, HexadecimalDigitsAreCounted) {
  const auto number = [](const Cursor& v) { EXPECT_EQ(v.hexadecimal(), 0xfedcba9876543210u); };
  EXPECT_EQ(said_of("\"fedcba9876543210\"", number), "no error");
  for (const char* bad : {"\"\"", "\"0x1\"", "\"12g\"", "\"-1\"", "\"A\"", "\"0fedcba9876543210\""})
    EXPECT_EQ(said_of(bad, number), "f: v: must be 1 to 16 lower-case hexadecimal digits") << bad;
  const auto hash = [](const Cursor& v) {
    EXPECT_EQ(v.hash(), (Hash128{0x0123456789abcdef, 0xfedcba9876543210}));
  };
  EXPECT_EQ(said_of("\"0123456789abcdeffedcba9876543210\"", hash), "no error");
  for (const char* bad : {"\"\"", "\"0123456789abcdef\"", "\"0123456789abcdeffedcba987654321\"",
                          "\"0123456789abcdegfedcba9876543210\"", "\"0123456789abcdeffedcba987654321g\"",
                          "\"0123456789abcdeffedcba98765432100\""})
    EXPECT_EQ(said_of(bad, hash), "f: v: must be 32 lower-case hexadecimal digits") << bad;
}

TEST(JsonCursor, MembersAreThoseThatAreKnown) {
  const auto known = [](const Cursor& v) { v.members({"position"}, {"radius", "name"}); };
  EXPECT_EQ(said_of(R"({"position":1,"name":2})", known), "no error");
  EXPECT_EQ(said_of(R"({"name":2})", known), "f: v: \"position\" is missing");
  EXPECT_EQ(said_of(R"({"position":1,"radios":2})", known),
            "f: v: unknown member \"radios\" (did you mean \"radius\"?)");
  EXPECT_EQ(said_of(R"({"position":1,"z":2})", known),
            "f: v: unknown member \"z\" (known: position, radius, name)");
  const std::string long_name(64, 'z');
  EXPECT_EQ(said_of("{\"position\":1,\"" + long_name + "\":2}", known),
            "f: v: unknown member \"" + long_name + "\" (known: position, radius, name)");
  EXPECT_EQ(said_of("{\"position\":1,\"" + long_name + "z\":2}", known),
            "f: v: unknown member \"" + long_name + "…\" (known: position, radius, name)");
  const auto entries = [](const Cursor& v) { EXPECT_EQ(v.entries().at(1).first, "name"); };
  EXPECT_EQ(said_of(R"({"position":1,"name":2})", entries), "no error");
  EXPECT_EQ(said_of("1", entries), "f: v: must be an object, not number");
}

TEST(JsonCursor, ArraysHaveAsManyElementsAsAreWanted) {
  const auto two_to_three = [](const Cursor& v) { v.size(2, 3); };
  EXPECT_EQ(said_of("[1,2]", two_to_three), "no error");
  EXPECT_EQ(said_of("[1,2,3]", two_to_three), "no error");
  EXPECT_EQ(said_of("[1]", two_to_three), "f: v: must have at least 2 elements, not 1");
  EXPECT_EQ(said_of("[1,2,3,4]", two_to_three), "f: v: must have at most 3 elements, not 4");
  EXPECT_EQ(said_of("[1,2,3]", [](const Cursor& v) { EXPECT_EQ(v.vector3(), vec3(1, 2, 3)); }), "no error");
  EXPECT_EQ(said_of("[1,2,3]", [](const Cursor& v) { v.vector2(); }), "f: v: must have 2 elements, not 3");
  EXPECT_EQ(said_of("[1,2,3]", [](const Cursor& v) { v.vector4(); }), "f: v: must have 4 elements, not 3");
  EXPECT_EQ(said_of("[1,\"2\"]", [](const Cursor& v) { v.vector2(); }),
            "f: v[1]: must be a number, not string");
  EXPECT_EQ(said_of("[[1,2],[3,1e39]]", [](const Cursor& v) { v[1].vector2(); }),
            "f: v[1][1]: 1e+39 is too large a number");
  const auto third = [](const Cursor& v) { EXPECT_EQ(v[2].number(), 3); };
  EXPECT_EQ(said_of("[1,2,3]", third), "no error");
  EXPECT_EQ(said_of("[1,2]", third), "f: v: must have at least 3 elements, not 2");
  EXPECT_EQ(said_of("{\"2\":3}", third), "f: v: must be an array, not object");
}

TEST(JsonCursor, ElementsAreAllInTheirOrder) {
  const auto numbers = [](const Cursor& v) {
    std::vector<float> found;
    for (const Cursor& element : elements(v, 2, 3)) found.push_back(element.number());
    EXPECT_EQ(found, (std::vector<float>{3, 1, 2}));
  };
  EXPECT_EQ(said_of("[3,1,2]", numbers), "no error");
  EXPECT_EQ(said_of("[3]", numbers), "f: v: must have at least 2 elements, not 1");
  EXPECT_EQ(said_of("[3,1,2,4]", numbers), "f: v: must have at most 3 elements, not 4");
  EXPECT_EQ(said_of("[3,true]", numbers), "f: v[1]: must be a number, not boolean");
}

TEST(JsonCursor, MembersThatAreMissingAreWhatStandsForThem) {
  const std::string file = "f";
  const Value document = parse(R"({"t":"text","n":2,"b":true,"a":[1,2]})", file);
  const Cursor at(document, file);
  EXPECT_EQ(at.text_or("t", "x"), "text");
  EXPECT_EQ(at.text_or("none", "x"), "x");
  EXPECT_EQ(at.text_or("none"), "");
  EXPECT_EQ(at.number_or("n", 7), 2);
  EXPECT_EQ(at.number_or("none", 7), 7);
  EXPECT_EQ(at.boolean_or("b", false), true);
  EXPECT_EQ(at.boolean_or("none", true), true);
  EXPECT_EQ(at.size_of("a"), 2u);
  EXPECT_EQ(at.size_of("none"), 0u);
  EXPECT_TRUE(at.has("a"));
  EXPECT_FALSE(at.has("none"));
}

}  // namespace
}  // namespace ssphh::json
