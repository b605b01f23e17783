#include <bit>
#include <vector>

#include <gtest/gtest.h>

#include <ssphh/core/for_this_cpu.h>
#include <ssphh/core/random.h>

namespace ssphh::test {
namespace {

/// Products and sums that fused multiply-adds would round otherwise, and lanes in their order.
SSPHH_IN_LOOP inline void sums_of(const std::vector<float>& a, const std::vector<float>& b, float* out) {
  for (std::size_t lane = 0; lane < 8; ++lane) out[lane] = 0;
  for (std::size_t i = 0; i < a.size(); i += 8) {
    for (std::size_t lane = 0; lane < 8; ++lane) out[lane] += a[i + lane] * b[i + lane];
  }
}

TEST(ForThisCpu, HasTheBitsOfAnyOtherCpu) {
  Pcg32 random(7);
  std::vector<float> a(8000), b(8000);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = random.uniform() - 0.5f, b[i] = random.uniform();
  float any[8], this_one[8];
  sums_of(a, b, any);
  for_this_cpu([&]() SSPHH_IN_LOOP { sums_of(a, b, this_one); });
  for (std::size_t lane = 0; lane < 8; ++lane)
    EXPECT_EQ(std::bit_cast<std::uint32_t>(any[lane]), std::bit_cast<std::uint32_t>(this_one[lane]));
}

}  // namespace
}  // namespace ssphh::test
