#pragma once
/// A checked cursor into a JSON document: every access either yields a value of the asked type and range, or
/// throws an Error that names file and place ("scene.gltf: nodes[3].mesh: index 7 out of range, the file has
/// 2 meshes").

#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/hash.h>
#include <ssphh/core/json.h>
#include <ssphh/core/math.h>

namespace ssphh::json {

class Cursor {
 public:
  /// Keeps references: `value` and `file`, which names the document in messages, must outlive the cursor.
  Cursor(const Value& value, const std::string& file, std::string path = {})
      : value_(&value), file_(&file), path_(std::move(path)) {}

  const Value& value() const { return *value_; }
  const std::string& file() const { return *file_; }
  /// "nodes[3].mesh"; empty at the root.
  const std::string& path() const { return path_; }
  /// File and path, as messages begin.
  std::string place() const;
  [[noreturn]] void fail(const std::string& problem, const std::string& hint = {}) const;

  bool is_object() const { return value_->is_object(); }
  bool is_array() const { return value_->is_array(); }
  bool is_string() const { return value_->is_string(); }
  bool is_number() const { return value_->is_number(); }

  /// Member of this object; none when it is absent. Fails when this is no object.
  std::optional<Cursor> find(const char* name) const;
  /// Member of this object; fails when it is absent, too.
  Cursor operator[](const char* name) const;
  bool has(const char* name) const { return find(name).has_value(); }
  /// Fails when this is no object, lacks a member of `required`, or has one that stands in neither list.
  /// Returns itself.
  const Cursor& members(std::initializer_list<std::string_view> required,
                        std::initializer_list<std::string_view> optional = {}) const;
  /// Names and values of all members; fails when this is no object.
  const Members& entries() const;
  /// Members that are all optional.
  const Cursor& only(std::initializer_list<std::string_view> known) const { return members({}, known); }

  /// Elements of this array; fails when this is no array, or has fewer or more than asked for.
  std::size_t size(std::size_t least = 0, std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  Cursor operator[](std::size_t i) const;  ///< fails when this is no array, or has no such element
  Cursor operator[](int i) const { return (*this)[static_cast<std::size_t>(i)]; }

  /// Whole number; one that is written with a fraction of 0 counts (JSON has one kind of number).
  std::int64_t integer(std::int64_t least, std::int64_t most) const;
  std::uint64_t unsigned_integer(std::uint64_t most = std::uint64_t{1} << 53) const;
  /// Index below `count`; `noun` is the plural of what it refers to.
  int index(std::size_t count, const char* noun) const;
  /// Number that a float can hold.
  float number() const;
  float number(double least, double most) const;
  /// Number with all the digits of a double.
  double precise_number() const;
  double precise_number(double least, double most) const;
  bool boolean() const;
  /// Text of at most `most` bytes.
  const std::string& text(std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  /// The value of an enum (enum_names.h) that a text names; fails with the names there are.
  template <class E>
  E named() const {
    const std::optional<E> value = parse_enum<E>(text());
    if (!value) fail(none_of(text(), names_of<E>()));
    return *value;
  }
  /// Fails unless this is the number of the version that is read.
  void expect_version(int version) const;
  /// Fails unless the member `format` is this text and `version` that number.
  void expect_format(const char* format, int version) const;
  /// The number that a text of 1 to 16 lower-case hexadecimal digits tells.
  std::uint64_t hexadecimal() const;
  /// Text of 32 such digits.
  Hash128 hash() const;
  /// Array of exactly as many numbers as `out` takes.
  void numbers(std::span<float> out) const;
  vec2 vector2() const;
  vec3 vector3() const;
  vec4 vector4() const;

  /// Elements of the array that a member is; 0 when it is absent.
  std::size_t size_of(const char* name) const;
  /// Value of a member, or what stands for it when it is absent.
  std::string text_or(const char* name, const std::string& otherwise = {}) const;
  float number_or(const char* name, float otherwise) const;
  bool boolean_or(const char* name, bool otherwise) const;

 private:
  const Value* value_;
  const std::string* file_;
  std::string path_;
};

/// All elements of an array; fails when that is no array, or has fewer or more than asked for.
template <class At>
std::vector<At> elements(const At& array, std::size_t least = 0,
                         std::size_t most = std::numeric_limits<std::size_t>::max()) {
  std::vector<At> all;
  for (std::size_t i = 0, count = array.size(least, most); i < count; ++i) all.push_back(array[i]);
  return all;
}

}  // namespace ssphh::json
