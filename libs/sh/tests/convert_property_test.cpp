#include <ssphh/sh/convert.h>
#include <ssphh/sh/rotate.h>

#include "property.h"
#include "sh_generators.h"

namespace ssphh::test {
namespace {

using sh::Convention;
using sh::RadianceSh;

Generator<Convention> conventions() {
  std::vector<Convention> all;
  for (const std::string& name : names_of<Convention>()) all.push_back(*parse_enum<Convention>(name));
  return one_of(all);
}

TEST(ConvertProperty, EveryDegreeComesBackUpToTheLastThatIsStored) {
  EXPECT_TRUE(
      for_all(functions(), conventions()).cases(60).holds([](const RadianceSh& f, Convention convention) {
        const RadianceSh kept = truncated(f, std::min(f.degree(), sh::convention_max_degree(convention)));
        const RadianceSh back = from_convention(to_convention(f, convention), convention);
        if (back.degree() != kept.degree())
          return at_most(back.degree(), -1) << ": degree, not " << kept.degree();
        double worst = 0;
        for (std::size_t k = 0; k < kept.values.size(); ++k) {
          for (glm::length_t c = 0; c < 3; ++c)
            worst = std::max(worst, static_cast<double>(std::abs(back.values[k][c] - kept.values[k][c])) /
                                        std::max(1e-30, std::abs(double(kept.values[k][c]))));
        }
        // A product and a quotient by the same float.
        return at_most(worst, 2.01 * rounding);
      }));
}

TEST(ConvertProperty, StoredValuesOfASumAreTheSumOfStoredValues) {
  EXPECT_TRUE(for_all(functions(2, 2), functions(2, 2), conventions())
                  .cases(60)
                  .holds([](const RadianceSh& a, const RadianceSh& b, Convention convention) {
                    RadianceSh sum = a;
                    sum += b;
                    const std::vector<vec3> x = to_convention(a, convention),
                                            y = to_convention(b, convention),
                                            s = to_convention(sum, convention);
                    double worst = 0;
                    for (std::size_t k = 0; k < s.size(); ++k)
                      worst = std::max(worst, static_cast<double>(largest_difference(s[k], x[k] + y[k])));
                    return at_most(worst, 2 * 5 * rounding);  // values up to 2, factors up to 1
                  }));
}

TEST(ConvertProperty, MirroredFilesAreThoseOfTheMirrorImage) {
  glm::dmat3 mirror(1);
  mirror[0][0] = -1;  // x ↦ −x
  EXPECT_TRUE(for_all(functions()).cases(30).holds([&](const RadianceSh& f) {
    return to_convention(sh::Rotation(f.degree(), mirror).apply(f), Convention::filament) ==
           to_convention(f, Convention::filament_mirrored);
  }));
}

}  // namespace
}  // namespace ssphh::test
