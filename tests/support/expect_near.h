#pragma once
/// Vectors that are equal but for rounding.

#include <gtest/gtest.h>

#include <ssphh/core/math.h>

namespace ssphh::test {

/// Fails the test where the vectors are further apart than `tolerance`, or hold no numbers.
inline void expect_near(const vec3& actual, const vec3& expected, float tolerance = 1e-5f) {
  EXPECT_LE(glm::distance(actual, expected), tolerance)
      << actual.x << ' ' << actual.y << ' ' << actual.z << " is not " << expected.x << ' ' << expected.y
      << ' ' << expected.z;
}

}  // namespace ssphh::test
