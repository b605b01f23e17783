/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/cook/cook.h>

namespace ssphh::cook {
namespace {

TEST(Defaults, OfCooking) {
  const CookParams params;
  EXPECT_EQ(params.sight_size, 32);
  EXPECT_EQ(params.places, nullptr);
  const Cooked cooked;
  for (const std::size_t count : {cooked.points, cooked.cells, cooked.entries, cooked.sight_bytes,
                                  cooked.list_bytes, cooked.light_bytes})
    EXPECT_EQ(count, 0u);
}

}  // namespace
}  // namespace ssphh::cook
