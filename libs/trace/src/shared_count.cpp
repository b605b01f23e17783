#include "shared_count.h"

namespace ssphh::trace {
namespace {

unsigned next_shard() {
  static std::atomic<unsigned> next{0};
  return next.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

void SharedCount::add(std::uint64_t n) noexcept {
  thread_local const unsigned shard = next_shard();
  shards_[shard % shards_.size()].value.fetch_add(n, std::memory_order_relaxed);
}

std::uint64_t SharedCount::total() const noexcept {
  std::uint64_t sum = 0;
  for (const Shard& shard : shards_) sum += shard.value.load(std::memory_order_relaxed);
  return sum;
}

}  // namespace ssphh::trace
