#pragma once

namespace ssphh::test {

/// √4π: the coefficient of band 0 of radiance 1 from every direction, ∫ Y₀₀ dω.
inline constexpr double root_4pi_d = 3.5449077018110318;
inline constexpr float root_4pi = 3.5449077018110318f;

}  // namespace ssphh::test
