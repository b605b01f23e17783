#pragma once
/// A count that many threads add to, spread over cache lines.

#include <array>
#include <atomic>
#include <cstdint>

namespace ssphh::trace {

class SharedCount {
 public:
  void add(std::uint64_t n) noexcept;
  std::uint64_t total() const noexcept;

 private:
  struct alignas(64) Shard {
    std::atomic<std::uint64_t> value{0};
  };
  std::array<Shard, 16> shards_;
};

}  // namespace ssphh::trace
