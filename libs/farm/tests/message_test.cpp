/// What is read from a document, value by value: each with its limits and with what is said of others.

#include "message.h"

#include <limits>

#include <gtest/gtest.h>

#include "error_message.h"

namespace ssphh::farm {
namespace {

using ssphh::test::message_of;

/// "no error", or what is said of the value under "v" when it is read so.
template <class Read>
std::string said_of(const std::string& value, const Read& read) {
  const Message message = parse_message(R"({"v":)" + value + "}", "m");
  return message_of([&] { read(message.root()["v"]); });
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
  EXPECT_TRUE(read(binary("", 0, 0)).starts_with("m: is not valid JSON")) << "a head and nothing else";
  EXPECT_EQ(read(binary("{}  ", 0, 8)), "m: its sizes do not fit") << "longer than the message";
  EXPECT_EQ(read(binary("{}  ", 3, 4)), "m: its sizes do not fit") << "no whole float behind it";
  EXPECT_EQ(read(binary("{}", 4, 2)), "m: its sizes do not fit") << "no multiple of four";
  const std::string eight = binary("{}  ", 8, 4);
  EXPECT_EQ(parse_message(eight, "m").raw.bytes.size(), 8u);
  EXPECT_EQ(read("{}" + std::string(max_json_bytes - 2, ' ')), "no error");
  EXPECT_TRUE(read("{}" + std::string(max_json_bytes - 1, ' ')).starts_with("m: the JSON is too large"));
}

TEST(Message, WrittenOnesHaveTheirFloatsBehindThem) {
  const std::vector<float> values = {1.5f, -2, 0.1f}, more = {7};
  for (const ContentType type : {ContentType::json, ContentType::binary}) {
    MessageWriter out(type);
    json::Value document = {{"a", out.floats(values)}, {"b", out.floats(more)}};
    const std::string body = out.finish(document);
    EXPECT_EQ(content_type(body), type);
    const Message message = parse_message(body, "m");
    std::vector<float> a(3), b(1);
    EXPECT_EQ(message.root()["a"].float_count(), 3u);
    message.root()["a"].floats(a), message.root()["b"].floats(b);
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

TEST(Field, NumbersOfAnArrayAreAsManyAsWantedAndFinite) {
  const auto floats = [](const Field& f) {
    std::vector<float> out(2);
    f.floats(out);
    EXPECT_EQ(out, (std::vector<float>{1, 0.5f}));
  };
  EXPECT_EQ(said_of("[1,0.5]", floats), "no error");
  EXPECT_EQ(said_of("[1,1e39]", floats), "m: v[1]: 1e+39 is too large a number");
  EXPECT_EQ(said_of("[null,1]", floats), "m: v[0]: must be a number, not null");
  EXPECT_EQ(said_of("[1,2,3]", floats), "m: v: must be 2 numbers, not 3");
  const auto inner = [](const Field& f) { EXPECT_EQ(f.find("x").has_value(), f["x"].float_count() == 1); };
  EXPECT_EQ(said_of("{\"x\":[1]}", inner), "no error");
  EXPECT_EQ(said_of("{}", inner), "m: v: \"x\" is missing");
}

// Three floats lie behind the document.
TEST(Field, RangesOfRawFloatsLieWithinThem) {
  const auto count_in = [](const std::string& range, std::size_t wanted) {
    std::string text = R"({"v":{"f32":)" + range + "}}";
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string body = binary(text, 12, static_cast<std::uint32_t>(text.size()));
    const Message message = parse_message(body, "m");
    return message_of([&] { EXPECT_EQ(message.root()["v"].float_count(), wanted); });
  };
  EXPECT_EQ(count_in("[0,3]", 3), "no error");
  EXPECT_EQ(count_in("[1,2]", 2), "no error");
  EXPECT_EQ(count_in("[3,0]", 0), "no error");
  EXPECT_EQ(count_in("[1,3]", 0), "m: v.f32[1]: 3 must be an integer from 0 to 2");
  EXPECT_EQ(count_in("[4,0]", 0), "m: v.f32[0]: 4 must be an integer from 0 to 3");
  EXPECT_EQ(count_in("[-1,1]", 0), "m: v.f32[0]: -1 must be an integer from 0 to 3");
  EXPECT_EQ(count_in("[0]", 0), "m: v: \"f32\" must be [first, count]");
  EXPECT_EQ(count_in("[0,1,2]", 0), "m: v: \"f32\" must be [first, count]");
}

TEST(Field, RawFloatsThatAreNotFiniteAreRefused) {
  const std::vector<float> values = {1, std::numeric_limits<float>::infinity()};
  MessageWriter out(ContentType::binary);
  const json::Value document = {{"v", out.floats(values)}};
  const std::string body = out.finish(document);
  const Message message = parse_message(body, "m");
  std::vector<float> read(2);
  EXPECT_EQ(message_of([&] { message.root()["v"].floats(read); }), "m: v: holds a number that is not finite");
}

}  // namespace
}  // namespace ssphh::farm
