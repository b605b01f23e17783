#include <ssphh/core/hash.h>

#include "property.h"

namespace ssphh::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Lengths beyond 240 bytes take XXH3's long way.
Generator<Bytes> byte_lists(int fewest) {
  return lists(integers<std::uint8_t>(0, 255), fewest, 600);
}

Hash128 hash_of(const Bytes& bytes) {
  return Hasher().bytes(std::as_bytes(std::span(bytes))).finish();
}

std::string_view text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(HashProperty, EveryBitCounts) {
  EXPECT_TRUE(for_all(byte_lists(1), seeds()).cases(200).holds([](Bytes bytes, std::uint64_t at) {
    const Hash128 before = hash_of(bytes);
    bytes[at / 8 % bytes.size()] ^= static_cast<std::uint8_t>(1u << at % 8);
    const Hash128 after = hash_of(bytes);
    // Each half is a hash by itself.
    return after.high != before.high && after.low != before.low && after.high != after.low;
  }));
}

TEST(HashProperty, BytesInPiecesAreTheSameBytesAndTextsInPiecesOtherTexts) {
  EXPECT_TRUE(for_all(byte_lists(0), seeds(), seeds())
                  .cases(200)
                  .holds([](const Bytes& bytes, std::uint64_t first, std::uint64_t second) {
                    const std::size_t cut = first % (bytes.size() + 1), other = second % (bytes.size() + 1);
                    const auto all = std::as_bytes(std::span(bytes));
                    Hasher pieces;
                    pieces.bytes(all.first(cut)).bytes(all.subspan(cut));
                    if (pieces.finish() != hash_of(bytes)) return false;
                    const std::string_view text = text_of(bytes);
                    const auto cut_at = [&](std::size_t n) {
                      return Hasher().text(text.substr(0, n)).text(text.substr(n)).finish();
                    };
                    return (cut_at(cut) == cut_at(other)) == (cut == other);
                  }));
}

TEST(HashProperty, ArraysTellWhereTheyEnd) {
  EXPECT_TRUE(for_all(lists(floats(-1, 1), 0, 20), lists(floats(-1, 1), 0, 20))
                  .cases(100)
                  .holds([](const std::vector<float>& a, const std::vector<float>& b) {
                    std::vector<float> joined = a;
                    joined.insert(joined.end(), b.begin(), b.end());
                    const Hash128 two = Hasher().array(a).array(b).finish();
                    return two != Hasher().array(joined).finish() &&
                           (two == Hasher().array(joined).array(std::vector<float>()).finish()) == b.empty();
                  }));
}

TEST(HashProperty, HexDigitsGiveTheHashBack) {
  EXPECT_TRUE(for_all(seeds(), seeds()).holds([](std::uint64_t high, std::uint64_t low) {
    const std::string hex = Hash128{high, low}.hex();
    return hex.size() == 32 && std::stoull(hex.substr(0, 16), nullptr, 16) == high &&
           std::stoull(hex.substr(16), nullptr, 16) == low;
  }));
}

}  // namespace
}  // namespace ssphh::test
