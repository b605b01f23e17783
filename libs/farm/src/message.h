#pragma once
/// A JSON document whose float arrays may lie behind it as raw floats.
///
/// Binary: "SSPHHMSG", u32 bytes of the document (padded with blanks to a multiple of 4), the document, then
/// little-endian floats; an array in the document is {"f32": [first, count]}.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <ssphh/core/error.h>
#include <ssphh/core/math.h>
#include <ssphh/farm/job_codec.h>

namespace ssphh::farm {

using Json = nlohmann::ordered_json;

class MessageWriter {
 public:
  explicit MessageWriter(ContentType type) : type_(type) {}
  Json floats(std::span<const float> values);
  Json vectors(std::span<const vec3> values) {
    return floats({reinterpret_cast<const float*>(values.data()), 3 * values.size()});
  }
  std::string finish(const Json& document) const;

 private:
  ContentType type_;
  std::vector<float> raw_;
};

/// A float as the shortest decimal of nine digits, which reads back to the same float.
Json exact(float value);
Json exact(const vec3& v);

/// The floats behind a document. Each is read once, so that a small message cannot ask for much memory.
struct RawFloats {
  std::span<const std::byte> bytes;  ///< refers to the body that was parsed
  mutable std::size_t read = 0;
};

/// A value in a document and where it stands, for errors.
class Field {
 public:
  Field(const Json& value, std::string where, const RawFloats& raw)
      : value_(value), where_(std::move(where)), raw_(raw) {}

  Field operator[](const char* key) const;
  /// None when the key is missing.
  std::optional<Field> find(const char* key) const;
  Field at(std::size_t i) const;
  /// Throws unless it is an array of at most `limit` elements.
  std::size_t size(std::size_t limit) const;

  std::string text(std::size_t limit = 4096) const;
  bool flag() const;
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  /// A string of 1 to 16 hexadecimal digits.
  std::uint64_t hex64() const;
  Hash128 hash() const;
  float number() const;
  double real() const;
  vec3 vector3() const;
  /// Exactly `count` finite numbers.
  void floats(std::span<float> out) const;
  std::size_t float_count() const;
  void vectors(std::span<vec3> out) const { floats({reinterpret_cast<float*>(out.data()), 3 * out.size()}); }
  [[noreturn]] void fail(const std::string& problem) const { throw Error(where_, problem); }

 private:
  const Json& value_;
  std::string where_;
  const RawFloats& raw_;
};

struct Message {
  Json document;
  RawFloats raw;
  Field root(const char* name) const { return {document, name, raw}; }
};

/// Throws Error for bytes that are no such document. `body` must outlive the result.
Message parse_message(std::string_view body, const std::string& where);

}  // namespace ssphh::farm
