#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include <ssphh/core/memory.h>

namespace ssphh {
namespace {

TEST(Memory, OfTheMachineIsAtMostWhatTheKernelTells) {
  std::ifstream file("/proc/meminfo");
  std::string name;
  std::uint64_t kilobytes = 0;
  ASSERT_TRUE(file >> name >> kilobytes);
  ASSERT_EQ(name, "MemTotal:");
  EXPECT_LE(memory_of_machine(), kilobytes * 1024);
  EXPECT_GT(memory_of_machine(), 64u << 20) << "this test itself runs";
}

}  // namespace
}  // namespace ssphh
