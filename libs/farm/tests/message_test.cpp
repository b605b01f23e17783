/// What is read from a document, value by value: each with its limits and with what is said of others.

#include "message.h"

#include <limits>

#include <gtest/gtest.h>

#include "error_message.h"

namespace ssphh::farm {
namespace {

using ssphh::test::message_of;

/// "no error", or what is said of the value of `json` under "v" when it is read so.
template <class Read>
std::string said_of(const std::string& json, const Read& read) {
  const Message message = parse_message(R"({"v":)" + json + "}", "m");
  return message_of([&] { read(message.root("m")["v"]); });
}

std::string binary(std::string text, std::size_t trailing, std::uint32_t size) {
  return "SSPHHMSG" + std::string(reinterpret_cast<const char*>(&size), 4) + text +
         std::string(trailing, '\0');
}

TEST(Message, BinaryOnesAreCutAsTheirHeadSays) {
  const auto read = [](const std::string& body) { return message_of([&] { parse_message(body, "m"); }); };
  EXPECT_EQ(read(binary("{}  ", 0, 4)), "no error");
  EXPECT_EQ(read(binary("{}  ", 8, 4)), "no error");
  EXPECT_EQ(read("SSPHHMSG"), "m: is cut off");
  EXPECT_EQ(read(std::string("SSPHHMSG\0\0\0", 11)), "m: is cut off");
  EXPECT_EQ(read(binary("", 0, 0)), "m: is no JSON object") << "a head and nothing else";
  EXPECT_EQ(read(binary("{}  ", 0, 8)), "m: its sizes do not fit") << "longer than the message";
  EXPECT_EQ(read(binary("{}  ", 3, 4)), "m: its sizes do not fit") << "no whole float behind it";
  EXPECT_EQ(read(binary("{}", 4, 2)), "m: its sizes do not fit") << "no multiple of four";
  const std::string eight = binary("{}  ", 8, 4);
  EXPECT_EQ(parse_message(eight, "m").raw.bytes.size(), 8u);
  EXPECT_EQ(read("[]"), "m: is no JSON object");
  EXPECT_EQ(read("{}" + std::string(max_json_bytes - 1, ' ')), "m: is too large");
}

TEST(Message, WrittenOnesHaveTheirFloatsBehindThem) {
  const std::vector<float> values = {1.5f, -2, 0.1f}, more = {7};
  for (const ContentType type : {ContentType::json, ContentType::binary}) {
    MessageWriter out(type);
    Json document = {{"a", out.floats(values)}, {"b", out.floats(more)}};
    const std::string body = out.finish(document);
    EXPECT_EQ(content_type(body), type);
    const Message message = parse_message(body, "m");
    std::vector<float> a(3), b(1);
    EXPECT_EQ(message.root("m")["a"].float_count(), 3u);
    message.root("m")["a"].floats(a), message.root("m")["b"].floats(b);
    EXPECT_EQ(a, values);
    EXPECT_EQ(b, more);
    if (type == ContentType::json) {
      EXPECT_EQ(body, R"({"a":[1.5,-2.0,0.100000001],"b":[7.0]})") << "nine digits";
    } else {
      EXPECT_EQ(body.size(), 12 + 40 + 4 * sizeof(float));
      EXPECT_EQ(body.substr(12, 40), R"({"a":{"f32":[0,3]},"b":{"f32":[3,1]}}   )");
    }
  }
}

TEST(Field, WholeNumbersLieBetweenTheirLimits) {
  const auto read = [](const Field& f) { f.integer(-3, 9); };
  for (const char* good : {"-3", "0", "9"}) EXPECT_EQ(said_of(good, read), "no error") << good;
  for (const char* bad : {"-4", "10", "1.0", "\"1\"", "true", "null", "[1]", "18446744073709551615"})
    EXPECT_EQ(said_of(bad, read), "m/v: must be a whole number in -3..9") << bad;
  const auto all = [](const Field& f) { EXPECT_EQ(f.integer(INT64_MIN, INT64_MAX), INT64_MAX); };
  EXPECT_EQ(said_of("9223372036854775807", all), "no error");
  EXPECT_NE(said_of("9223372036854775808", all), "no error") << "is no negative number";
}

TEST(Field, TextsAndArraysHaveALength) {
  const auto three = [](const Field& f) { EXPECT_EQ(f.text(3), "abc"); };
  EXPECT_EQ(said_of("\"abc\"", three), "no error");
  EXPECT_EQ(said_of("\"abcd\"", three), "m/v: is too long");
  EXPECT_EQ(said_of("3", three), "m/v: must be a string");
  const auto usual = [](const Field& f) { f.text(); };
  EXPECT_EQ(said_of('"' + std::string(4096, 'x') + '"', usual), "no error");
  EXPECT_EQ(said_of('"' + std::string(4097, 'x') + '"', usual), "m/v: is too long");
  const auto two = [](const Field& f) { EXPECT_EQ(f.size(2), 2u); };
  EXPECT_EQ(said_of("[1,2]", two), "no error");
  EXPECT_EQ(said_of("[1,2,3]", two), "m/v: has more than 2 elements");
  EXPECT_EQ(said_of("{}", two), "m/v: must be an array");
}

TEST(Field, HexadecimalDigitsAreCounted) {
  const auto number = [](const Field& f) { EXPECT_EQ(f.hex64(), 0xfedcba9876543210u); };
  EXPECT_EQ(said_of("\"fedcba9876543210\"", number), "no error");
  for (const char* bad : {"\"\"", "\"0x1\"", "\"12g\"", "\"-1\""})
    EXPECT_EQ(said_of(bad, number), "m/v: must be hexadecimal digits") << bad;
  EXPECT_EQ(said_of("\"0fedcba9876543210\"", number), "m/v: is too long");
  const auto hash = [](const Field& f) {
    EXPECT_EQ(f.hash(), (Hash128{0x0123456789abcdef, 0xfedcba9876543210}));
  };
  EXPECT_EQ(said_of("\"0123456789abcdeffedcba9876543210\"", hash), "no error");
  for (const char* bad : {"\"\"", "\"0123456789abcdeffedcba987654321\"",
                          "\"0123456789abcdegfedcba9876543210\"", "\"0123456789abcdeffedcba987654321g\""})
    EXPECT_EQ(said_of(bad, hash), "m/v: must be 32 hexadecimal digits") << bad;
  EXPECT_EQ(said_of("\"0123456789abcdeffedcba98765432100\"", hash), "m/v: is too long");
}

TEST(Field, NumbersAreFinite) {
  const auto number = [](const Field& f) { EXPECT_EQ(f.number(), 0.25f); };
  EXPECT_EQ(said_of("0.25", number), "no error");
  EXPECT_EQ(said_of("1e39", number), "m/v: must be a finite number");
  EXPECT_EQ(said_of("\"1\"", number), "m/v: must be a number");
  const auto vector = [](const Field& f) { EXPECT_EQ(f.vector3(), vec3(1, 2, 3)); };
  EXPECT_EQ(said_of("[1,2,3]", vector), "no error");
  EXPECT_EQ(said_of("[1,2]", vector), "m/v: must be three numbers");
  EXPECT_EQ(said_of("[1,2,3,4]", vector), "m/v: has more than 3 elements");
  EXPECT_EQ(said_of("[1,2,1e39]", vector), "m/v/2: must be a finite number");
  const auto floats = [](const Field& f) {
    std::vector<float> out(2);
    f.floats(out);
  };
  EXPECT_EQ(said_of("[1,1e39]", floats), "m/v: [1] must be a finite number");
  EXPECT_EQ(said_of("[null,1]", floats), "m/v: [0] must be a finite number");
  EXPECT_EQ(said_of("[1,2,3]", floats), "m/v: must be 2 numbers, not 3");
}

TEST(Field, SaysWhatIsMissingAndWhatIsNoObject) {
  const auto inner = [](const Field& f) { f["x"]; };
  EXPECT_EQ(said_of("{\"x\":1}", inner), "no error");
  EXPECT_EQ(said_of("{}", inner), "m/v: \"x\" is missing");
  EXPECT_EQ(said_of("[]", inner), "m/v: must be an object");
  const auto flag = [](const Field& f) { EXPECT_TRUE(f.flag()); };
  EXPECT_EQ(said_of("true", flag), "no error");
  EXPECT_EQ(said_of("1", flag), "m/v: must be true or false");
}

// Three floats lie behind the document.
TEST(Field, RangesOfRawFloatsLieWithinThem) {
  const auto count_in = [](const std::string& range, std::size_t wanted) {
    std::string text = R"({"v":{"f32":)" + range + "}}";
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string body = binary(text, 12, static_cast<std::uint32_t>(text.size()));
    const Message message = parse_message(body, "m");
    return message_of([&] { EXPECT_EQ(message.root("m")["v"].float_count(), wanted); });
  };
  EXPECT_EQ(count_in("[0,3]", 3), "no error");
  EXPECT_EQ(count_in("[1,2]", 2), "no error");
  EXPECT_EQ(count_in("[3,0]", 0), "no error");
  EXPECT_EQ(count_in("[1,3]", 0), "m/v/f32/1: must be a whole number in 0..2");
  EXPECT_EQ(count_in("[4,0]", 0), "m/v/f32/0: must be a whole number in 0..3");
  EXPECT_EQ(count_in("[-1,1]", 0), "m/v/f32/0: must be a whole number in 0..3");
  EXPECT_EQ(count_in("[0]", 0), "m/v: \"f32\" must be [first, count]");
  EXPECT_EQ(count_in("[0,1,2]", 0), "m/v/f32: has more than 2 elements");
}

TEST(Field, RawFloatsThatAreNotFiniteAreRefused) {
  const std::vector<float> values = {1, std::numeric_limits<float>::infinity()};
  MessageWriter out(ContentType::binary);
  const Json document = {{"v", out.floats(values)}};
  const std::string body = out.finish(document);
  const Message message = parse_message(body, "m");
  std::vector<float> read(2);
  EXPECT_EQ(message_of([&] { message.root("m")["v"].floats(read); }),
            "m/v: holds a number that is not finite");
}

}  // namespace
}  // namespace ssphh::farm
