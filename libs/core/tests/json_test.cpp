#include <limits>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <ssphh/core/json.h>

#include "error_message.h"
#include "property.h"

namespace ssphh::json {
namespace {

using test::message_of;

std::string nested(int depth) {
  const auto n = static_cast<std::size_t>(depth);
  return std::string(n, '[') + std::string(n, ']');
}

TEST(Json, BracesBuildObjectsOfPairsAndArraysOfAllElse) {
  const std::vector<float> floats = {0.5f, 2};
  const std::array<double, 2> doubles = {1, 2.25};
  const Value value = {{"name", "lamp"},
                       {"count", 3},
                       {"on", true},
                       {"nothing", nullptr},
                       {"below", -4},
                       {"most", std::numeric_limits<std::uint64_t>::max()},
                       {"at", {1.0, 2.5, 3}},
                       {"floats", floats},
                       {"doubles", doubles},
                       {"map", std::map<std::string, int>{{"b", 1}, {"a", 2}}},
                       {"words", {"a", "b", "c"}},
                       {"one", Value::array({1})},
                       {"none", Value::array()},
                       {"empty", Value::object()}};
  EXPECT_EQ(print(value),
            R"({"name":"lamp","count":3,"on":true,"nothing":null,"below":-4,"most":18446744073709551615,)"
            R"("at":[1.0,2.5,3],"floats":[0.5,2.0],"doubles":[1.0,2.25],"map":{"a":2,"b":1},)"
            R"("words":["a","b","c"],"one":[1],"none":[],"empty":{}})");
}

TEST(Json, ValuesAreReadAsTheKindThatTheyAre) {
  const Value value = parse(R"({"a":[1,-2,0.5],"t":"x","b":false,"n":null})", "f");
  EXPECT_EQ(value["a"].size(), 3u);
  for (const char* scalar : {"t", "b", "n"}) EXPECT_EQ(value[scalar].size(), 0u) << scalar;
  EXPECT_EQ(value["a"][0].integer(), 1);
  EXPECT_EQ(value["a"][1].integer(), -2);
  EXPECT_EQ(value["a"][2].integer(), std::nullopt);
  EXPECT_EQ(value["a"][2].number(), 0.5);
  EXPECT_EQ(value["a"][1].number(), -2);
  EXPECT_EQ(value["t"].string(), "x");
  EXPECT_FALSE(value["b"].boolean());
  EXPECT_TRUE(value["n"].is_null());
  EXPECT_EQ(value.find("none"), nullptr);
  EXPECT_EQ(value["a"].find("x"), nullptr);
  EXPECT_THROW(value["none"], std::logic_error);
  EXPECT_THROW(value["t"].number(), std::logic_error);
  EXPECT_THROW(value["a"][3], std::out_of_range);
  EXPECT_EQ(parse("9007199254740992.0", "f").integer(), std::int64_t{1} << 53);
  EXPECT_EQ(parse("9007199254740994.0", "f").integer(), std::nullopt) << "may have been another number";
}

TEST(Json, MembersAreAddedReplacedAndTakenAway) {
  Value value;
  value["a"]["b"] = 1;
  value["list"].push_back(2);
  value["list"].push_back("x");
  value["a"]["b"] = 3;
  EXPECT_EQ(print(value), R"({"a":{"b":3},"list":[2,"x"]})");
  value.update({{"list", 0}, {"c", 1}});
  value.erase("a");
  EXPECT_EQ(print(value), R"({"list":0,"c":1})");
  EXPECT_THROW(value["c"].push_back(1), std::logic_error);
}

TEST(Json, NumbersAreEqualAsNumbers) {
  EXPECT_EQ(Value(1), Value(1.0));
  EXPECT_EQ(Value(1), Value(1u));
  EXPECT_FALSE(Value(-1) == Value(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_EQ(parse("[1,{\"a\":2.0}]", "f"), (Value{1, Value{{"a", 2}}}));
  EXPECT_FALSE(Value(1) == Value(true));
}

TEST(Json, TextsAreNestedTo128Levels) {
  const auto said = [](const std::string& text) { return message_of([&] { parse(text, "f"); }); };
  EXPECT_EQ(said(nested(128)), "no error");
  EXPECT_EQ(said(nested(129)), "f: the JSON is nested deeper than 128 levels");
  EXPECT_EQ(said(R"({"a":")" + std::string(200, '[') + R"(\"[","b":[[],[]]})"), "no error")
      << "brackets of a text are none";
  EXPECT_THAT(said("{"), testing::StartsWith("f: is not valid JSON: parse error at line 1"));
  EXPECT_THAT(said(""), testing::StartsWith("f: is not valid JSON"));
  EXPECT_THAT(said("1 2"), testing::StartsWith("f: is not valid JSON"));
  EXPECT_THAT(said("1e999"), testing::StartsWith("f: is not valid JSON"));
}

TEST(Json, LimitsAreKept) {
  const auto said = [](const std::string& text, const Limits& limits) {
    return message_of([&] { parse(text, "f", limits); });
  };
  EXPECT_EQ(said("[1]", {.bytes = 3}), "no error");
  EXPECT_EQ(said("[10]", {.bytes = 3}), "f: the JSON is too large: 4 bytes, the limit is 3");
  EXPECT_EQ(said("[[],{}]", {.containers = 3}), "no error");
  EXPECT_EQ(said("[[],{},[]]", {.containers = 3}), "f: the JSON has more than 3 arrays and objects");
  EXPECT_EQ(said("[1,2,3,4,null,true,\"7\",8.5]", {.containers = 1}), "no error");
  EXPECT_EQ(said("[1,2,3,4,5,6,7,8,9]", {.containers = 1}), "f: the JSON has more than 8 values");
  EXPECT_EQ(said("[[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]]", {.containers = 2}),
            "f: the JSON has more than 16 values");
  EXPECT_EQ(said("[[1]]", {.depth = 1}), "f: the JSON is nested deeper than 1 levels");
  EXPECT_FALSE(try_parse("[10]", {.bytes = 3}));
  EXPECT_EQ(try_parse("[10]")->size(), 1u);
}

TEST(Json, OfMembersOfOneNameTheLastCounts) {
  EXPECT_EQ(print(parse(R"({"a":1,"b":2,"a":3})", "f")), R"({"a":3,"b":2})");
  std::string many = "{";
  for (int i = 0; i < 100000; ++i) many += "\"" + std::to_string(i % 50000) + "\":1,";
  many.back() = '}';
  EXPECT_EQ(parse(many, "f").size(), 50000u) << "in a time that grows with their number alone";
}

TEST(Json, PrintsWhatIsNoUtf8OrNoNumberHarmlessly) {
  EXPECT_EQ(print("a\xff\"\n"), "\"a\xef\xbf\xbd\\\"\\n\"");
  EXPECT_EQ(print("é", -1, Letters::ascii), "\"\\u00e9\"");
  EXPECT_EQ(print(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(print(std::numeric_limits<double>::infinity()), "null");
}

/// Any value of few levels.
Value draw(Pcg32& random, int depth) {
  const auto below = [&](std::uint32_t n) { return random.next() % n; };
  switch (below(depth > 0 ? 8 : 6)) {
    case 0:
      return nullptr;
    case 1:
      return below(2) == 0;
    case 2:
      return static_cast<std::int64_t>(below(1000)) - 500;
    case 3:
      return std::uint64_t{below(1u << 31)} << below(33);
    case 4:
      return std::ldexp(static_cast<double>(below(1u << 30)), static_cast<int>(below(60)) - 40);
    case 5:
      return std::string(below(4), static_cast<char>('a' + below(26)));
    case 6: {
      Value array = Value::array();
      for (std::uint32_t n = below(4); n > 0; --n) array.push_back(draw(random, depth - 1));
      return array;
    }
    default: {
      Value object = Value::object();
      for (std::uint32_t n = below(4); n > 0; --n)
        object[std::string(1, static_cast<char>('a' + below(26)))] = draw(random, depth - 1);
      return object;
    }
  }
}

TEST(JsonProperty, PrintsWhatNlohmannPrintsAndReadsItBack) {
  EXPECT_TRUE(test::for_all(test::integers(0, 1 << 30)).cases(300).holds([](int seed) {
    Pcg32 random(static_cast<std::uint64_t>(seed), 0);
    const Value value = draw(random, 3);
    const auto theirs = nlohmann::ordered_json::parse(print(value));
    return print(value) == theirs.dump() && print(value, 2) == theirs.dump(2) &&
           print(value, 0) == theirs.dump(0) && parse(print(value, 1), "f") == value;
  }));
}

}  // namespace
}  // namespace ssphh::json
