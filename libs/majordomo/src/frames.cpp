#include <fmt/format.h>
#include <sys/random.h>

#include <ssphh/core/error.h>
#include <ssphh/majordomo/frames.h>

namespace ssphh::majordomo {

std::size_t byte_count(const Frames& frames) {
  std::size_t sum = 0;
  for (const Frame& frame : frames) sum += frame.size();
  return sum;
}

std::string RequestId::hex() const {
  return fmt::format("{:016x}{:016x}", high, low);
}

std::optional<RequestId> RequestId::parse(std::string_view text) {
  if (text.size() != 32) return std::nullopt;
  std::uint64_t half[2] = {0, 0};
  for (std::size_t i = 0; i < 32; ++i) {
    const char c = text[i];
    const int digit = c >= '0' && c <= '9'   ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : -1;
    if (digit < 0) return std::nullopt;
    half[i / 16] = half[i / 16] << 4 | static_cast<std::uint64_t>(digit);
  }
  return RequestId{half[0], half[1]};
}

void fill_random(std::span<std::byte> bytes) {
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Error("random numbers", "the system gives none", "see getrandom(2)");
}

RequestId RequestId::random() {
  RequestId id;
  fill_random(std::as_writable_bytes(std::span(&id, 1)));
  return id;
}

}  // namespace ssphh::majordomo
