#pragma once
/// Little-endian encoding of plain values; decoding that checks every size against the bytes that are left.

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <ssphh/core/math.h>
#include <ssphh/core/require.h>

static_assert(std::endian::native == std::endian::little,
              "files are written as the memory of a little-endian machine");

namespace ssphh {

class ByteWriter {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void value(T v) { array(std::span<const T>(&v, 1)); }
  void vector3(const vec3& v) { value(v.x), value(v.y), value(v.z); }
  void text(std::string_view text) {
    value(static_cast<std::uint32_t>(text.size()));
    array(std::span<const char>(text));
  }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void array(std::span<const T> values) {
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + values.size_bytes());
    if (!values.empty()) std::memcpy(bytes_.data() + begin, values.data(), values.size_bytes());
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class ByteReader {
 public:
  ByteReader(std::span<const std::byte> data, std::string where) : data_(data), where_(std::move(where)) {}

  std::size_t left() const { return data_.size() - position_; }

  template <class T>
  requires std::is_arithmetic_v<T> T value(const char* what) {
    T v;
    std::memcpy(&v, take(sizeof(T), what), sizeof(T));
    return v;
  }
  /// A number in [low, high]; NaN is outside.
  template <class T>
  T value_in(const char* what, T low, T high) {
    const T v = value<T>(what);
    if (!(v >= low && v <= high)) fail(what, "is out of range");
    return v;
  }
  vec3 vector3(const char* what) {
    vec3 v;
    array(what, std::span<vec3>(&v, 1));
    return v;
  }
  std::string text(const char* what, std::size_t limit) {
    const std::size_t size = value<std::uint32_t>(what);
    if (size > limit) fail(what, "is too long");
    const std::byte* p = take(size, what);
    return {reinterpret_cast<const char*>(p), size};
  }
  /// A count of things that take at least `bytes_each` bytes, so that it can be allocated.
  std::size_t count(const char* what, std::size_t limit, std::size_t bytes_each) {
    const std::size_t n = value<std::uint32_t>(what);
    if (n > limit) fail(what, "is over the limit of " + std::to_string(limit));
    if (n * bytes_each > left()) fail(what, "needs more bytes than the file has");
    return n;
  }
  /// Finite numbers only.
  void array(const char* what, std::span<vec3> out) {
    const std::byte* p = take(out.size_bytes(), what);
    if (!out.empty()) std::memcpy(out.data(), p, out.size_bytes());
    for (const vec3& v : out)
      if (!is_finite(v)) fail(what, "holds a number that is not finite");
  }
  /// Values of which every bit pattern is allowed, or that the caller checks.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void raw(const char* what, std::span<T> out) {
    const std::byte* p = take(out.size_bytes(), what);
    if (!out.empty()) std::memcpy(out.data(), p, out.size_bytes());
  }
  /// The next `size` bytes, in place.
  std::span<const std::byte> view(const char* what, std::size_t size) { return {take(size, what), size}; }
  void expect_end() const {
    if (left() != 0) fail("end", "has " + std::to_string(left()) + " bytes too many");
  }
  [[noreturn]] void fail(const char* what, const std::string& problem) const {
    refuse(where_ + " at byte " + std::to_string(position_), std::string(what) + " " + problem);
  }

 private:
  const std::byte* take(std::size_t size, const char* what) {
    if (size > left()) fail(what, "is cut off");
    const std::byte* p = data_.data() + position_;
    position_ += size;
    return p;
  }

  std::span<const std::byte> data_;
  std::string where_;
  std::size_t position_ = 0;
};

}  // namespace ssphh
