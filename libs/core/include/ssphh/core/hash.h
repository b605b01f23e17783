#pragma once
/// Content hashes (XXH3-128): identity of scenes, parameters and files. Not a cryptographic hash.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace ssphh {

struct Hash128 {
  std::uint64_t high = 0, low = 0;
  friend bool operator==(const Hash128&, const Hash128&) = default;
  /// 32 lower-case hexadecimal digits.
  std::string hex() const;
};

/// Feeds values one after the other; the result depends on their bytes and order.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  Hasher& bytes(std::span<const std::byte> data);
  /// Length and characters.
  Hasher& text(std::string_view text);
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) Hasher& value(const T& v) {
    return bytes(std::as_bytes(std::span<const T>(&v, 1)));
  }
  /// Size and elements of a vector of trivially copyable values without padding.
  template <class T>
  Hasher& array(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(values.size()));
    return bytes(std::as_bytes(std::span<const T>(values)));
  }
  Hash128 finish() const;

 private:
  void* state_;
};

}  // namespace ssphh
