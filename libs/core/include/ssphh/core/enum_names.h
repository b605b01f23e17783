#pragma once
/// Names of an enum's values as options, files and messages spell them: one table beside the enum, from which
/// printing, parsing and lists follow.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <ssphh/core/require.h>

namespace ssphh {

template <class E>
struct EnumName {
  E value;
  std::string_view name;  ///< a literal
};

/// The table of E, which a function in the enum's own namespace returns:
///
///   constexpr auto enum_table(Wrap) {
///     return std::to_array<EnumName<Wrap>>({{Wrap::repeat, "repeat"}, {Wrap::clamp, "clamp"}});
///   }
///
/// Every value has an entry; a second one of the same value is an alias, which is understood but never told.
template <class E>
inline constexpr auto enum_names = enum_table(E{});

/// The first name of a value in a table. Throws Error for a value that has none.
template <class E, std::size_t N>
constexpr std::string_view name_in(const std::array<EnumName<E>, N>& table, E value) {
  for (const EnumName<E>& entry : table)
    if (entry.value == value) return entry.name;
  refuse("name of a choice", "there is none of that number");
}

/// The value of a name in a table; none for a name that is not there.
template <class E, std::size_t N>
constexpr std::optional<E> value_in(const std::array<EnumName<E>, N>& table, std::string_view name) {
  for (const EnumName<E>& entry : table)
    if (entry.name == name) return entry.value;
  return std::nullopt;
}

/// All names of a table in its order, without aliases.
template <class E, std::size_t N>
std::vector<std::string> names_in(const std::array<EnumName<E>, N>& table) {
  std::vector<std::string> names;
  for (const EnumName<E>& entry : table)
    if (name_in(table, entry.value) == entry.name) names.emplace_back(entry.name);
  return names;
}

/// The first name of a value, the value of a name, and all names of an enum's own table.
template <class E>
requires std::is_enum_v<E>
constexpr std::string_view name_of(E value) {
  return name_in(enum_names<E>, value);
}
template <class E>
constexpr std::optional<E> parse_enum(std::string_view name) {
  return value_in(enum_names<E>, name);
}
template <class E>
std::vector<std::string> names_of() {
  return names_in(enum_names<E>);
}

/// What an Error says of a name that is none of `known`: "\"surfl\" is none of: path, surfel, bounce".
std::string none_of(std::string_view name, const std::vector<std::string>& known);

/// The value of that name. Throws Error(where, …) that lists the names there are.
template <class E>
E enum_named(const std::string& where, std::string_view name) {
  const std::optional<E> value = parse_enum<E>(name);
  if (!value) refuse(where, none_of(name, names_of<E>()));
  return *value;
}

}  // namespace ssphh
