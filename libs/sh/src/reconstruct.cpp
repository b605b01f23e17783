#include <array>

#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/reconstruct.h>

namespace ssphh::sh {
namespace {

template <class Quantity>
vec3 eval_sum(const RgbSh<Quantity>& sh, int degree, const vec3& direction) {
  if (degree < 0) return vec3(0);
  std::array<float, max_coefficient_count> basis;
  eval_basis(degree, direction, basis);
  vec3 sum(0);
  for (int k = 0; k < coefficient_count(degree); ++k) sum += basis[k] * sh[k];
  return sum;
}

template <class Quantity>
void eval_all(const RgbSh<Quantity>& sh, std::span<const vec3> directions, std::span<vec3> out) {
  require(out.size() == directions.size(), "reconstruction", "there is not one value for each direction");
  const int degree = sh.degree();
  for (std::size_t i = 0; i < directions.size(); ++i) out[i] = eval_sum(sh, degree, directions[i]);
}

}  // namespace

vec3 eval(const RadianceSh& radiance, const vec3& direction) {
  return eval_sum(radiance, radiance.degree(), direction);
}

vec3 eval(const IrradianceSh& irradiance, const vec3& normal) {
  return eval_sum(irradiance, irradiance.degree(), normal);
}

void eval(const RadianceSh& radiance, std::span<const vec3> directions, std::span<vec3> out) {
  eval_all(radiance, directions, out);
}

void eval(const IrradianceSh& irradiance, std::span<const vec3> normals, std::span<vec3> out) {
  eval_all(irradiance, normals, out);
}

}  // namespace ssphh::sh
