#include <stdexcept>

#include <gtest/gtest.h>

#include <ssphh/gl/timer.h>

#include "gl_context.h"

namespace ssphh::gl {
namespace {

class GlTimer : public test::WithGl {};

template <class Query>
void end_early(Query& query) {
  try {
    const During looking(query);
    throw std::runtime_error("a shader does not compile");
  } catch (const std::runtime_error&) {
  }
}

TEST_F(GlTimer, ASpanThatEndsEarlyRefusesNoneThatComesAfterIt) {
  for (const bool software : {true, false}) {
    Timer timer(software);
    SampleCounter counter(software), other(software);
    end_early(timer);
    end_early(counter);
    end_early(timer);
    { const During looking(other); }
    EXPECT_NO_THROW(gl().throw_on_error("counting"));
  }
}

}  // namespace
}  // namespace ssphh::gl
