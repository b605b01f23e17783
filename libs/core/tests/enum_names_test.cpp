/// Tables of an enum of its own: aliases, order, and what is said of other names. What holds of every table:
/// tests/contracts/enum_names_test.cpp.

#include <gmock/gmock.h>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/json_cursor.h>

#include "error_message.h"

namespace ssphh {
namespace shapes {

enum class Shape { box = 3, ball, disc };
constexpr auto enum_table(Shape) {
  using enum Shape;
  return std::to_array<EnumName<Shape>>({{disc, "disc"}, {ball, "ball"}, {ball, "sphere"}, {box, "box"}});
}

}  // namespace shapes
namespace {

using shapes::Shape;
using test::message_of;

TEST(EnumNames, AreFoundBothWays) {
  static_assert(name_of(Shape::disc) == "disc");
  static_assert(parse_enum<Shape>("box") == Shape::box);
  EXPECT_EQ(name_of(Shape::ball), "ball");
  EXPECT_EQ(parse_enum<Shape>("ball"), Shape::ball);
  EXPECT_EQ(parse_enum<Shape>("Ball"), std::nullopt);
  EXPECT_EQ(parse_enum<Shape>("bal"), std::nullopt);
  EXPECT_EQ(message_of([] { name_of(Shape{}); }), "name of a choice: there is none of that number");
}

TEST(EnumNames, OfAnAliasAreUnderstoodAndNotTold) {
  EXPECT_EQ(parse_enum<Shape>("sphere"), Shape::ball);
  EXPECT_THAT(names_of<Shape>(), testing::ElementsAre("disc", "ball", "box"));
}

TEST(EnumNames, OthersAreRefusedWithThoseThereAre) {
  EXPECT_EQ(enum_named<Shape>("--shape", "sphere"), Shape::ball);
  EXPECT_EQ(message_of([] { enum_named<Shape>("--shape", "cube"); }),
            "--shape: \"cube\" is none of: disc, ball, box");
  EXPECT_EQ(none_of(std::string(64, 'x'), {"a"}), "\"" + std::string(64, 'x') + "\" is none of: a");
  EXPECT_EQ(none_of(std::string(65, 'x'), {"a"}), "\"" + std::string(64, 'x') + "…\" is none of: a");
}

TEST(EnumNames, OfADocumentAreReadAtTheirPlace) {
  const json::Value document = {{"shape", "box"}, {"other", "cone"}, {"number", 3}};
  const std::string file = "f";
  const json::Cursor root(document, file);
  EXPECT_EQ(root["shape"].named<Shape>(), Shape::box);
  EXPECT_EQ(message_of([&] { root["other"].named<Shape>(); }),
            "f: other: \"cone\" is none of: disc, ball, box");
  EXPECT_EQ(message_of([&] { root["number"].named<Shape>(); }), "f: number: must be a string, not number");
}

}  // namespace
}  // namespace ssphh
