/// What the store's file gives back of what was put into it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>

#include "store.h"
#include "temp_dir.h"

namespace ssphh::majordomo::test {
namespace {

using ssphh::test::TempDir;
using testing::SizeIs;

Body body(Frames frames) {
  return std::make_shared<const Frames>(std::move(frames));
}

StoreOperation add(const RequestId& id, const std::string& service, Frames frames, Millis attempt_timeout) {
  return {
      StoreOperation::add,
      {.id = id, .service = service, .body = body(std::move(frames)), .attempt_timeout = attempt_timeout}};
}

TEST(StoreFile, HoldsEveryFieldInTheOrderOfArrival) {
  const TempDir dir;
  const std::string odd = std::string("\0'\xff", 3);
  {
    Store store(dir / "store");
    store.apply({add({9, 1}, "gen", {"one", "", odd}, 1234), add({8, 2}, "viz", {"two"}, 0)});
    store.apply({add({7, 3}, "gen", {""}, 5)});
    store.apply({{StoreOperation::finish,
                  {.id = {9, 1},
                   .outcome = Outcome::parked,
                   .reason = "failed on 3 workers",
                   .attempts = 4,
                   .reply = body({"r", odd})}},
                 {StoreOperation::forget, {.id = {8, 2}}}});
  }
  const auto all = Store(dir / "store").load();
  ASSERT_THAT(all, SizeIs(2));
  ASSERT_EQ(all[0].id, (RequestId{9, 1}));
  EXPECT_EQ(all[0].service, "gen");
  EXPECT_EQ(*all[0].body, (Frames{"one", "", odd}));
  EXPECT_EQ(all[0].attempt_timeout, 1234);
  EXPECT_TRUE(all[0].finished);
  EXPECT_EQ(all[0].outcome, Outcome::parked);
  EXPECT_EQ(all[0].reason, "failed on 3 workers");
  EXPECT_EQ(all[0].attempts, 4u);
  EXPECT_EQ(*all[0].reply, (Frames{"r", odd}));
  EXPECT_EQ(all[1].id, (RequestId{7, 3}));
  EXPECT_EQ(*all[1].body, Frames{""});
  EXPECT_EQ(all[1].attempt_timeout, 5);
  EXPECT_FALSE(all[1].finished);
}

TEST(StoreFile, KeepsTheFirstOfTwoRequestsWithOneId) {
  const TempDir dir;
  Store store(dir / "store");
  store.apply({add({1, 1}, "gen", {"first"}, 1), add({1, 1}, "viz", {"second"}, 2)});
  const auto all = store.load();
  ASSERT_THAT(all, SizeIs(1));
  EXPECT_EQ(*all[0].body, Frames{"first"});
}

TEST(StoreFile, IsOneBrokersAtATime) {
  const TempDir dir;
  const Store store(dir / "store");
  EXPECT_THROW(Store(dir / "store"), Error);
}

}  // namespace
}  // namespace ssphh::majordomo::test
