#pragma once
/// Frames, request ids, and the steady clock that the protocol's state machines are driven by.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <ssphh/core/hash.h>

namespace ssphh::majordomo {

/// One frame of a multipart message: opaque bytes.
using Frame = std::string;
using Frames = std::vector<Frame>;
/// A body that several messages share (retries, copies, waiting clients); never null in a message that has
/// one.
using Body = std::shared_ptr<const Frames>;

/// Milliseconds of a steady clock; only differences mean anything. The state machines never read a clock.
using Millis = std::int64_t;
/// The longest time that anybody may ask for, some 9000 years: sums with the clock's stay in range.
inline constexpr Millis most_millis = Millis{1} << 48;

/// Bytes of all frames.
std::size_t byte_count(const Frames& frames);

/// Fills with bytes from the system's random source. Throws Error when there is none.
void fill_random(std::span<std::byte> bytes);

/// A request's name: 128 random bits, so that nobody else can ask for its result. In text 32 lower-case
/// hexadecimal digits, which is also the uuid of 9/TSP.
struct RequestId {
  std::uint64_t high = 0, low = 0;
  friend bool operator==(const RequestId&, const RequestId&) = default;
  std::string hex() const;
  /// From exactly 32 hexadecimal digits of either case; none otherwise.
  static std::optional<RequestId> parse(std::string_view text);
  /// From the system's random source.
  static RequestId random();
};

}  // namespace ssphh::majordomo

template <>
struct std::hash<ssphh::majordomo::RequestId> {
  std::size_t operator()(const ssphh::majordomo::RequestId& id) const noexcept {
    return static_cast<std::size_t>(id.low);  // random as the other half
  }
};
