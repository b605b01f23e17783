#pragma once
/// What holds of every table of names (core/enum_names.h): a typed test, instantiated with the enums of a
/// program.

#include <algorithm>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include <ssphh/core/enum_names.h>

#include "error_message.h"

namespace ssphh::test {

/// Whether an enum declares this value: compilers print the others as a cast number, "(ssphh::Wrap)7".
template <auto value>
constexpr bool is_enumerator() {
  const std::string_view function = __PRETTY_FUNCTION__;
  const std::string_view start = "value = ";
  return function[function.find(start) + start.size()] != '(';
}

/// The declared ones among the first 64 numbers.
template <class E>
std::set<E> enumerators() {
  std::set<E> declared;
  [&]<int... number>(std::integer_sequence<int, number...>) {
    ((is_enumerator<static_cast<E>(number)>() ? void(declared.insert(static_cast<E>(number))) : void()), ...);
  }
  (std::make_integer_sequence<int, 64>());
  return declared;
}

template <class E>
class EnumTable : public testing::Test {};
TYPED_TEST_SUITE_P(EnumTable);

TYPED_TEST_P(EnumTable, NamesEveryValueThatIsDeclared) {
  std::set<TypeParam> named;
  for (const auto& entry : enum_names<TypeParam>) named.insert(entry.value);
  EXPECT_EQ(named, enumerators<TypeParam>());
}

TYPED_TEST_P(EnumTable, HasDistinctNamesThatAreWords) {
  std::set<std::string_view> names;
  for (const auto& entry : enum_names<TypeParam>) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name << " twice";
    EXPECT_FALSE(entry.name.empty());
    EXPECT_EQ(std::string_view(entry.name.data()), entry.name) << "not the whole literal";
  }
}

TYPED_TEST_P(EnumTable, IsReadAsItIsWritten) {
  for (const auto& entry : enum_names<TypeParam>)
    EXPECT_EQ(parse_enum<TypeParam>(entry.name), entry.value) << entry.name;
  for (const std::string& name : names_of<TypeParam>())
    EXPECT_EQ(name_of(*parse_enum<TypeParam>(name)), name) << "an alias is told";
  EXPECT_EQ(names_of<TypeParam>().size(), enumerators<TypeParam>().size());
}

TYPED_TEST_P(EnumTable, KnowsNothingElse) {
  for (const char* other : {"", " ", "no such name"}) EXPECT_EQ(parse_enum<TypeParam>(other), std::nullopt);
  const std::string problem = message_of([] { enum_named<TypeParam>("--option", "no such name"); });
  EXPECT_TRUE(problem.starts_with("--option: \"no such name\" is none of: ")) << problem;
  for (const std::string& name : names_of<TypeParam>()) EXPECT_NE(problem.find(name), problem.npos);
  EXPECT_EQ(message_of([] { name_of(static_cast<TypeParam>(63)); }),
            "name of a choice: there is none of that number");
}

REGISTER_TYPED_TEST_SUITE_P(EnumTable, NamesEveryValueThatIsDeclared, HasDistinctNamesThatAreWords,
                            IsReadAsItIsWritten, KnowsNothingElse);

}  // namespace ssphh::test
