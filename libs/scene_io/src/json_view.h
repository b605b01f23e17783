#pragma once
/// A checked cursor into a JSON document: every access either yields a value of the asked type and range or
/// throws an Error that names file and place ("nodes[3].mesh: index 7 out of range, the file has 2 meshes").

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include <ssphh/core/math.h>

namespace ssphh::scene_io {

/// Parses a JSON text. Nesting deeper than 128 and texts over 256 MiB are errors, so that no later recursion
/// over the document can exhaust stack or memory. `file` names the source in messages.
nlohmann::json parse_json(std::string_view text, const std::string& file);

class JsonView {
 public:
  /// Keeps references: `value` and `file` must outlive the view.
  JsonView(const nlohmann::json& value, const std::string& file, std::string path = {})
      : value_(&value), file_(&file), path_(std::move(path)) {}

  const nlohmann::json& raw() const { return *value_; }
  const std::string& file() const { return *file_; }
  const std::string& path() const { return path_; }
  [[noreturn]] void fail(const std::string& problem, const std::string& hint = {}) const;

  bool is_object() const { return value_->is_object(); }
  bool is_string() const { return value_->is_string(); }

  /// Member of this object; fails when this is no object. `at` fails when the member is absent.
  std::optional<JsonView> find(const char* key) const;
  JsonView at(const char* key) const;
  /// Fails when this object has a member that is not listed.
  void only_keys(std::initializer_list<std::string_view> known) const;

  /// Elements of this array; fails when this is no array.
  std::size_t size() const;
  JsonView operator[](std::size_t i) const;

  /// Integer in [0, limit]; a float with an integral value counts (JSON has one kind of number).
  std::uint64_t integer(std::uint64_t limit = std::uint64_t{1} << 53) const;
  /// Integer below `count`; `noun` is the plural of what it refers to.
  int index(std::size_t count, const char* noun) const;
  /// Number that a float can hold.
  float number() const;
  /// The same with all of its digits.
  double precise_number() const;
  float number(float min, float max) const;
  bool boolean() const;
  const std::string& string() const;
  /// Array of exactly `count` numbers.
  void numbers(float* out, std::size_t count) const;
  vec2 vector2() const;
  vec3 vector3() const;
  vec4 vector4() const;

 private:
  const nlohmann::json* value_;
  const std::string* file_;
  std::string path_;
};

/// Elements of the array member `key`; 0 when it is absent.
std::size_t array_size(const JsonView& object, const char* key);
/// Text member `key`, or the given default.
std::string text_or(const JsonView& object, const char* key, const std::string& fallback = {});
float number_or(const JsonView& object, const char* key, float fallback);
bool boolean_or(const JsonView& object, const char* key, bool fallback);

}  // namespace ssphh::scene_io
