#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/sh/window.h>

#include "property.h"
#include "sh_generators.h"

namespace ssphh::test {
namespace {

using sh::BandScales;
using sh::NonNegative;
using sh::RadianceSh;

Generator<NonNegative> goals() {
  return one_of<NonNegative>({NonNegative::irradiance, NonNegative::radiance});
}

/// A random function, lifted so that its means are positive.
RadianceSh lifted(RadianceSh f, float mean) {
  f[0] = glm::abs(f[0]) + mean;
  return f;
}

double lowest(const RadianceSh& f, NonNegative goal) {
  const vec3 low = goal == NonNegative::radiance ? minimum(f) : minimum(irradiance_from_radiance(f));
  return static_cast<double>(std::min({low.x, low.y, low.z}));
}

TEST(WindowProperty, AWiderWindowKeepsMoreOfEveryBandAndLowBandsMoreThanHighOnes) {
  EXPECT_TRUE(for_all(floats(0.1f, 40), floats(0, 20), integers(0, 1))
                  .cases(200)
                  .holds([](float width, float more, int kind) {
                    const auto window = kind ? sh::hanning_window : sh::lanczos_window;
                    const BandScales narrow = window(static_cast<double>(width)),
                                     wide = window(static_cast<double>(width) + static_cast<double>(more));
                    for (std::size_t l = 0; l < narrow.size(); ++l) {
                      if (!(narrow[l] <= wide[l] && wide[l] <= 1 && narrow[l] >= 0)) return false;
                      if (l > 0 && !(narrow[l] <= narrow[l - 1])) return false;
                    }
                    return narrow[0] == 1;
                  }));
}

TEST(WindowProperty, DeringingKeepsTheMeanAndLeavesNothingNegative) {
  EXPECT_TRUE(for_all(functions(), floats(0.01f, 3), goals())
                  .cases(25)
                  .holds([](const RadianceSh& f, float mean, NonNegative goal) {
                    const RadianceSh ringing = lifted(f, mean), clean = dering(ringing, goal);
                    if (clean[0] != ringing[0]) return at_most(apart(clean, ringing), 0) << " in the mean";
                    return at_most(-lowest(clean, goal), 0);
                  }));
}

TEST(WindowProperty, DeringingTwiceGivesTheBitsOfOnce) {
  EXPECT_TRUE(for_all(functions(), floats(-1, 3), goals())
                  .cases(25)
                  .holds([](const RadianceSh& f, float mean, NonNegative goal) {
                    const RadianceSh clean = dering(lifted(f, mean), goal);
                    return dering(clean, goal) == clean;
                  }));
}

TEST(WindowProperty, DeringingTurnsAndScalesWithTheFunction) {
  EXPECT_TRUE(for_all(functions(), floats(0.1f, 3), directions(), angles(), integers(-20, 20))
                  .cases(25)
                  .holds([](const RadianceSh& f, float mean, const vec3& axis, float angle, int exponent) {
                    const RadianceSh ringing = lifted(f, mean);
                    const sh::Rotation rotation(ringing.degree(), turn(axis, angle));
                    RadianceSh scaled = ringing, expected = dering(ringing);
                    // A power of two scales every step of the search to the bit.
                    scaled *= vec3(std::ldexp(1.0f, exponent));
                    expected *= vec3(std::ldexp(1.0f, exponent));
                    if (dering(scaled) != expected) return at_most(apart(dering(scaled), expected), 0);
                    // Minima are found to 1e-6 of the range, and the width from them.
                    return at_most(apart(dering(rotation.apply(ringing)), rotation.apply(dering(ringing))),
                                   1e-4 * size_of(ringing));
                  }));
}

TEST(WindowProperty, AWindowOnePerMilleMilderWouldLeaveSomethingNegative) {
  EXPECT_TRUE(for_all(functions(1), floats(0.01f, 1), goals())
                  .cases(25)
                  .holds([](const RadianceSh& f, float mean, NonNegative goal) {
                    const RadianceSh ringing = lifted(f, mean);
                    const double width = choose_window(ringing, goal).width;
                    if (!std::isfinite(width)) return at_most(-lowest(ringing, goal), 0);
                    // It keeps 1e-5 of the mean above 0: a wider one must cut into that.
                    const double margin = 1e-5 * static_cast<double>(max_component(ringing[0]));
                    return at_most(lowest(apply_window(ringing, sh::lanczos_window(1.001 * width)), goal),
                                   margin);
                  }));
}

TEST(WindowProperty, RadianceAsksForAtLeastAsMuchAsIrradiance) {
  EXPECT_TRUE(for_all(functions(), floats(0.01f, 3)).cases(25).holds([](const RadianceSh& f, float mean) {
    // A sum of non-negative light is not negative; 1e-4: the margins that the two searches keep.
    return at_most(choose_window(lifted(f, mean), NonNegative::radiance).width,
                   choose_window(lifted(f, mean), NonNegative::irradiance).width * (1 + 1e-4));
  }));
}

}  // namespace
}  // namespace ssphh::test
