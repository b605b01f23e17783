#include <ssphh/core/sphere.h>

#include "property.h"

namespace ssphh::test {
namespace {

double distance(const vec3& a, const vec3& b) {
  return static_cast<double>(glm::distance(a, b));
}

TEST(SphereProperty, PlacesOnTheCubeComeBackFromTheirDirections) {
  // Away from the edges, where a rounding may choose the neighbour.
  EXPECT_TRUE(for_all(integers(0, 5), floats(0.001f, 0.999f), floats(0.001f, 0.999f), floats(0.01f, 100))
                  .cases(200)
                  .holds([](int face, float s, float t, float length) {
                    const CubePoint back = cube_point(length * cube_direction({face, s, t}));
                    if (back.face != face) return at_most(back.face, -1) << ": face, not " << face;
                    // Coordinates of ±1 and a quotient, rounded four times.
                    return at_most(static_cast<double>(std::max(std::abs(back.s - s), std::abs(back.t - t))),
                                   4 * 0x1p-23);
                  }));
}

TEST(SphereProperty, DirectionsComeBackFromTheirPlacesOnTheCube) {
  EXPECT_TRUE(for_all(directions()).cases(300).holds([](const vec3& d) {
    const CubePoint place = cube_point(d);
    if (!(place.s >= 0 && place.s <= 1 && place.t >= 0 && place.t <= 1)) return at_most(1, 0);
    return at_most(distance(cube_direction(place), d), 8 * 0x1p-24);  // as above, and its normalisation
  }));
}

TEST(SphereProperty, FramesAreOrthonormalRightHandedAndUndoThemselves) {
  EXPECT_TRUE(for_all(directions(), vectors3(-1, 1)).cases(300).holds([](const vec3& n, const vec3& v) {
    const Frame frame = Frame::around(n);
    const double off = distance(glm::cross(frame.x, frame.y), n) +
                       distance(frame.to_world(frame.to_local(v)), v) +
                       distance(frame.to_world(vec3(0, 0, 1)), n);
    return at_most(off, 2e-6);  // float rounding of a few products of numbers up to 1 (Duff et al. §3)
  }));
}

TEST(SphereProperty, SolidAnglesAreThoseOfTheirFourQuarters) {
  EXPECT_TRUE(for_all(integers(1, 64), seeds()).cases(100).holds([](int size, std::uint64_t place) {
    const int x = static_cast<int>(place % static_cast<std::uint64_t>(size)),
              y = static_cast<int>(place / 64 % static_cast<std::uint64_t>(size));
    double quarters = 0;
    for (const int i : {0, 1, 2, 3}) quarters += texel_solid_angle(2 * x + i % 2, 2 * y + i / 2, 2 * size);
    const double whole = texel_solid_angle(x, y, size);
    // Differences of arc tangents up to π/2, each rounded.
    return at_most(std::abs(quarters - whole), 20 * 2.3e-16 * 1.6);
  }));
}

TEST(SphereProperty, TheUnitCircleIsAtItsStatedDistance) {
  EXPECT_TRUE(for_all(floats(0, 1)).cases(1000).holds([](float t) {
    const double angle = 2 * pi_d * static_cast<double>(t);
    const vec2 p = unit_circle(t);
    return at_most(std::max(std::abs(static_cast<double>(p.x) - std::cos(angle)),
                            std::abs(static_cast<double>(p.y) - std::sin(angle))),
                   2e-7);
  }));
}

}  // namespace
}  // namespace ssphh::test
