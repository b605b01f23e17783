/// Values that one thread publishes while others read.

#include <array>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <ssphh/core/snapshots.h>

namespace ssphh {
namespace {

TEST(Snapshots, GiveTheNewestAndKeepWhatIsRead) {
  Snapshots<int> numbers(1);
  EXPECT_EQ(*numbers.read(), 1);
  EXPECT_EQ(numbers.read().version(), 0u);
  const auto first = numbers.read();
  for (int i = 2; i < 10; ++i) {
    EXPECT_TRUE(numbers.publish([&](int& next) { next = i; }));
    const auto now = numbers.read();
    EXPECT_EQ(*now, i);
    EXPECT_EQ(now.version(), static_cast<std::uint64_t>(i - 1));
  }
  EXPECT_EQ(*first, 1);
}

TEST(Snapshots, PublishNothingWhereAllIsReadOrWritingFails) {
  Snapshots<int> numbers(1, 2);
  const auto old = numbers.read();
  EXPECT_TRUE(numbers.publish([](int& next) { next = 2; }));
  EXPECT_FALSE(numbers.publish([](int& next) { next = 3; })) << "one is read, the other the newest";
  EXPECT_EQ(*numbers.read(), 2);
  EXPECT_THROW(Snapshots<int>(0, 1), Error);
  Snapshots<int> three(1);
  EXPECT_THROW(three.publish([](int& next) {
    next = 7;
    throw Error("here", "broken");
  }),
               Error);
  EXPECT_EQ(*three.read(), 1);
}

TEST(Snapshots, AReaderIsMoved) {
  Snapshots<int> numbers(5);
  auto first = numbers.read();
  const auto second = std::move(first);
  EXPECT_EQ(*second, 5);
  EXPECT_THROW(*first, Error);
}

// Under ThreadSanitizer this finds a copy that is written while it is read.
TEST(Snapshots, AreWholeWhereverTheyAreRead) {
  constexpr int last = 20000;
  Snapshots<std::array<int, 64>> values({});
  std::vector<std::thread> readers;
  std::vector<int> torn(3), backward(3);
  for (std::size_t r = 0; r < torn.size(); ++r) {
    readers.emplace_back([&, r] {
      for (int seen = 0; seen < last;) {
        const auto now = values.read();
        for (const int v : *now) torn[r] += v != (*now)[0];
        backward[r] += (*now)[0] < seen;
        seen = (*now)[0];
      }
    });
  }
  for (int i = 1; i <= last;) i += values.publish([&](auto& next) { next.fill(i); });
  for (std::thread& reader : readers) reader.join();
  for (std::size_t r = 0; r < torn.size(); ++r) EXPECT_EQ(torn[r] + backward[r], 0) << r;
}

}  // namespace
}  // namespace ssphh
