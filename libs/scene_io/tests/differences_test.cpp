// Differences of another renderer are told in one line a kind, however many names it concerns.

#include "export/differences.h"

#include <gmock/gmock.h>

namespace ssphh::scene_io {
namespace {

using testing::ElementsAre;

TEST(Differences, NameTheFirstFiveAndCountTheRest) {
  Differences told;
  for (const char* name : {"a", "b", "", "d", "e"}) told.add("mirrors", name);
  told.add("lamps", "x");
  EXPECT_THAT(told.lines(), ElementsAre("lamps: x", "mirrors: a, b, (unnamed), d, e"));
  told.add("mirrors", "f");
  told.add("mirrors", "g");
  EXPECT_THAT(told.lines(), ElementsAre("lamps: x", "mirrors: a, b, (unnamed), d, e and 2 more"));
}

}  // namespace
}  // namespace ssphh::scene_io
