#pragma once
/// A JSON document whose float arrays may lie behind it as raw floats.
///
/// Binary: "SSPHHMSG", u32 bytes of the document (padded with blanks to a multiple of 4), the document, then
/// little-endian floats; an array in the document is {"f32": [first, count]}.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <ssphh/core/json_cursor.h>
#include <ssphh/core/math.h>
#include <ssphh/farm/job_codec.h>

namespace ssphh::farm {

class MessageWriter {
 public:
  explicit MessageWriter(ContentType type) : type_(type) {}
  json::Value floats(std::span<const float> values);
  json::Value vectors(std::span<const vec3> values) {
    return floats({reinterpret_cast<const float*>(values.data()), 3 * values.size()});
  }
  std::string finish(const json::Value& document) const;

 private:
  ContentType type_;
  std::vector<float> raw_;
};

/// A float as the shortest decimal of nine digits, which reads back to the same float.
json::Value exact(float value);
json::Value exact(const vec3& v);

/// The floats behind a document. Each is read once, so that a small message cannot ask for much memory.
struct RawFloats {
  std::span<const std::byte> bytes;  ///< refers to the body that was parsed
  mutable std::size_t read = 0;
};

/// A place in a document, whose arrays of floats may lie behind it.
class Field : public json::Cursor {
 public:
  Field(const json::Cursor& at, const RawFloats& raw) : Cursor(at), raw_(&raw) {}

  Field operator[](const char* name) const { return {Cursor::operator[](name), *raw_}; }
  Field operator[](std::size_t i) const { return {Cursor::operator[](i), *raw_}; }
  Field operator[](int i) const { return {Cursor::operator[](i), *raw_}; }
  /// None when the member is missing.
  std::optional<Field> find(const char* name) const;

  std::size_t float_count() const;
  /// Exactly `out.size()` finite numbers.
  void floats(std::span<float> out) const;
  void vectors(std::span<vec3> out) const { floats({reinterpret_cast<float*>(out.data()), 3 * out.size()}); }

 private:
  const RawFloats* raw_;
};

struct Message {
  std::string where;  ///< names it in errors
  json::Value document;
  RawFloats raw;
  Field root() const { return {json::Cursor(document, where), raw}; }
};

/// Throws Error for bytes that are no such document. `body` must outlive the result.
Message parse_message(std::string_view body, const std::string& where);

}  // namespace ssphh::farm
