#pragma once
/// JSON documents: a value to build, read and print. Parsing and printing are those of nlohmann/json, whose
/// templates stay in one source file; `json_cursor.h` reads a document with the place in every message.

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ssphh::json {

class Value;
using Array = std::vector<Value>;
using Member = std::pair<std::string, Value>;
using Members = std::vector<Member>;

/// A value of JSON. Objects keep the order in which their members were added.
///
/// Braces build both kinds of container, as in `Value{{"name", "lamp"}, {"at", {1.0, 2.0, 3.0}}}`: a list is
/// an object where each of its elements is a pair that begins with a text, else an array. `array()` and
/// `object()` say which where a list would be ambiguous.
class Value {
 public:
  Value() noexcept;  ///< null
  Value(std::nullptr_t) noexcept : Value() {}
  template <std::same_as<bool> T>
  Value(T value) : data_(value) {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) Value(T value) {
    set_integer(value < 0, static_cast<std::int64_t>(value), static_cast<std::uint64_t>(value));
  }
  template <std::floating_point T>
  Value(T value) : data_(static_cast<double>(value)) {}
  Value(const char* text) : data_(std::string(text)) {}
  Value(std::string_view text) : data_(std::string(text)) {}
  Value(std::string text) noexcept : data_(std::move(text)) {}
  Value(std::initializer_list<Value> list);
  Value(Array elements) noexcept;
  template <class T>
  Value(const std::vector<T>& elements) : Value(array()) {
    for (const T& element : elements) push_back(Value(element));
  }
  template <class T, std::size_t N>
  Value(std::span<T, N> elements) : Value(array()) {
    for (const auto& element : elements) push_back(Value(element));
  }
  template <class T, std::size_t N>
  Value(const std::array<T, N>& elements) : Value(std::span(elements)) {}
  template <class T>
  Value(const std::map<std::string, T>& members) : Value(object()) {
    for (const auto& [name, value] : members) add(name, Value(value));
  }

  Value(const Value&);
  Value(Value&&) noexcept;
  Value& operator=(const Value&);
  Value& operator=(Value&&) noexcept;
  ~Value();

  static Value array(std::initializer_list<Value> elements = {});
  static Value object();

  bool is_null() const;
  bool is_boolean() const;
  bool is_number() const;
  bool is_string() const;
  bool is_array() const;
  bool is_object() const;
  /// A number that was written, or made, without fraction and exponent.
  bool is_integer() const;
  /// "null", "boolean", "number", "string", "array" or "object".
  const char* type_name() const;

  /// The value as the kind that it is; any other kind is a mistake of the program.
  bool boolean() const;
  double number() const;
  /// None for what is no number, has a fraction, or lies beyond 64 bits (2^53 where it was written with a
  /// point or exponent).
  std::optional<std::int64_t> integer() const;
  /// The decimal digits of a number that is_integer(), with its sign.
  std::string digits() const;
  const std::string& string() const;
  const Array& elements() const;
  const Members& members() const;

  /// Elements of an array, members of an object; 0 of anything else.
  std::size_t size() const;
  bool empty() const { return size() == 0; }

  /// Element of an array.
  const Value& operator[](std::size_t i) const;
  Value& operator[](std::size_t i);
  const Value& operator[](int i) const { return (*this)[static_cast<std::size_t>(i)]; }
  Value& operator[](int i) { return (*this)[static_cast<std::size_t>(i)]; }
  /// Makes an array of null first.
  void push_back(Value element);

  /// Member of an object; null where there is none, or this is no object.
  const Value* find(std::string_view name) const;
  bool contains(std::string_view name) const { return find(name) != nullptr; }
  /// Member of an object that must be there.
  const Value& operator[](const char* name) const;
  /// Member of an object, which is added as null where there is none. Makes an object of null first.
  Value& operator[](std::string_view name);
  Value& operator[](const char* name) { return (*this)[std::string_view(name)]; }
  Value& operator[](const std::string& name) { return (*this)[std::string_view(name)]; }
  void erase(std::string_view name);
  /// Adds the members of another object, or replaces those of the same name.
  void update(const Value& object);

  /// Numbers are equal as numbers, 1 and 1.0 too; objects if their members are, in the same order.
  bool operator==(const Value&) const;

 private:
  friend class Builder;  // of parse()
  void add(std::string name, Value value);
  void set_integer(bool negative, std::int64_t with_sign, std::uint64_t without);

  // Integers below 0 are signed, all others unsigned.
  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array, Members> data_;
};

/// What a document may ask for, so that no text can exhaust stack or memory.
struct Limits {
  std::size_t bytes = std::size_t{256} << 20;
  int depth = 128;                                ///< of arrays and objects within each other
  std::size_t containers = std::size_t{1} << 22;  ///< arrays and objects; other values: eight times as many
};

/// Throws Error, with `where` in its place, for what is no JSON or beyond the limits. Of members of one name
/// the last counts.
Value parse(std::string_view text, const std::string& where, const Limits& limits = {});
/// None where parse() would throw.
std::optional<Value> try_parse(std::string_view text, const Limits& limits = {});

enum class Letters : std::uint8_t {
  utf8,
  ascii,  ///< all others are escaped, so that the text is harmless wherever it goes
};

/// Prints on one line, or with `indent` blanks a level. What is no UTF-8 is replaced by U+FFFD, what is no
/// finite number by null.
std::string print(const Value& value, int indent = -1, Letters letters = Letters::utf8);

}  // namespace ssphh::json
