#pragma once
/// Random functions and turns for the properties of this module.

#include <glm/gtc/quaternion.hpp>

#include "generators.h"
#include "random_sh.h"

namespace ssphh::sh {

template <class Quantity>
std::string describe(const RgbSh<Quantity>& f) {
  return test::describe(f.values);
}

}  // namespace ssphh::sh

namespace ssphh::test {

template <class Sh>
Sh truncated(const Sh& f, int degree) {
  Sh result(degree);
  std::copy_n(f.values.begin(), result.values.size(), result.values.begin());
  return result;
}

/// Degree fewest..most, coefficients in [−1, 1); simpler have fewer bands, then fewer coefficients.
template <class Sh = sh::RadianceSh>
Generator<Sh> functions(int fewest = 0, int most = sh::max_degree) {
  const Generator<int> degree = integers(fewest, most);
  const auto draw = [=](Pcg32& random) {
    const int d = degree.draw(random);
    return random_sh<Sh>(d, random.next());
  };
  const auto simpler = [=](const Sh& f) {
    std::vector<Sh> result;
    for (int d = fewest; d < f.degree(); ++d) result.push_back(truncated(f, d));
    for (std::size_t k = 0; k < f.values.size(); ++k) {
      if (f.values[k] != vec3(0)) (result.emplace_back(f)).values[k] = vec3(0);
    }
    return result;
  };
  return {draw, simpler};
}

inline Generator<float> angles() {
  return floats(0, 6.25f);
}

inline glm::dmat3 turn(const vec3& axis, float angle) {
  return glm::mat3_cast(glm::angleAxis(static_cast<double>(angle), glm::normalize(glm::dvec3(axis))));
}

/// √Σ_k f[k]² of the largest channel: what rounding of f is relative to.
template <class Sh>
double size_of(const Sh& f) {
  glm::dvec3 squares(0);
  for (const vec3& v : f.values) squares += glm::dvec3(v) * glm::dvec3(v);
  return std::sqrt(std::max({squares.x, squares.y, squares.z}));
}

/// Largest difference of two functions' coefficients, double.
template <class Sh>
double apart(const Sh& a, const Sh& b) {
  return static_cast<double>(largest_difference(a, b));
}

/// Half a unit in the last place, relative: what one rounding to float may do.
inline constexpr double rounding = 0x1p-24;

}  // namespace ssphh::test
