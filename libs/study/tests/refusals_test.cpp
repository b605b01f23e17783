/// What entries of the module refuse, word by word; tests/contracts asks that nothing is left half done.

#include <gtest/gtest.h>

#include <ssphh/study/leak.h>
#include <ssphh/study/lookup_error.h>

#include "error_message.h"

namespace ssphh::study {
namespace {

using test::message_of;

TEST(StudyRefusals, OfAnotherNumberOfPoints) {
  EXPECT_EQ(message_of([] { lookup_error(std::vector<vec3>(2), {}); }),
            "lookup error: there is not one lookup for each truth");
  EXPECT_EQ(message_of([] { leak_ratio(std::vector<vec3>(2), {}); }),
            "leak: there is not one lookup for each point");
}

}  // namespace
}  // namespace ssphh::study
