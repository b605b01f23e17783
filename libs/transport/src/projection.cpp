#include <ssphh/core/for_this_cpu.h>
#include <ssphh/core/require.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/transport/projection.h>

namespace ssphh::transport {
namespace {

using float8 = float __attribute__((vector_size(32)));
constexpr std::size_t lanes = 8;

SSPHH_IN_LOOP inline float8 load(const float* p) {
  float8 v;
  __builtin_memcpy(&v, p, sizeof(v));
  return v;
}

SSPHH_IN_LOOP inline float sum(const float8& v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

/// `Count` coefficients times three channels: that many accumulators stay in registers.
template <std::size_t Count>
SSPHH_IN_LOOP inline void project_tile(const float* basis, const float* radiance, std::size_t stride,
                                       vec3* out) {
  float8 sums[Count][3] = {};
  for (std::size_t q = 0; q < stride; q += lanes) {
    const float8 light[3] = {load(radiance + q), load(radiance + stride + q),
                             load(radiance + 2 * stride + q)};
    for (std::size_t k = 0; k < Count; ++k) {
      const float8 y = load(basis + k * stride + q);
      for (std::size_t c = 0; c < 3; ++c) sums[k][c] += y * light[c];
    }
  }
  for (std::size_t k = 0; k < Count; ++k) out[k] = {sum(sums[k][0]), sum(sums[k][1]), sum(sums[k][2])};
}

}  // namespace

DirectionProjector::DirectionProjector(int degree, std::span<const vec3> directions)
    : degree_(degree), stride_((directions.size() + lanes - 1) / lanes * lanes) {
  sh::require_degree(degree, "projection of probes");
  require(!directions.empty(), "projection of probes", "there are no directions");
  const auto coefficients = static_cast<std::size_t>(sh::coefficient_count(degree));
  basis_.assign(coefficients * stride_, 0);
  const float weight = 4 * pi / static_cast<float>(directions.size());
  std::vector<float> values(coefficients);
  for (std::size_t q = 0; q < directions.size(); ++q) {
    sh::eval_basis(degree, directions[q], values);
    for (std::size_t k = 0; k < coefficients; ++k) basis_[k * stride_ + q] = weight * values[k];
  }
}

void DirectionProjector::project(std::span<const float> radiance, sh::RadianceSh& out) const {
  require(radiance.size() == 3 * stride_ && out.degree() == degree_, "projection of probes",
          "radiance or function are not of the projector's size");
  const std::size_t count = out.values.size(), stride = stride_;
  const float *const basis = basis_.data(), *const light = radiance.data();
  vec3* const values = out.values.data();
  for_this_cpu([=]() SSPHH_IN_LOOP {
    std::size_t k = 0;
    for (; k + 4 <= count; k += 4) project_tile<4>(basis + k * stride, light, stride, values + k);
    for (; k < count; ++k) project_tile<1>(basis + k * stride, light, stride, values + k);
  });
}

sh::RadianceSh project_arriving(std::span<const rays::ArrivingLight> light, int degree) {
  sh::RadianceSh sum(degree);
  std::vector<float> basis(sum.values.size());
  for (const rays::ArrivingLight& part : light) {
    sh::eval_basis(degree, part.toward, basis);
    for (std::size_t k = 0; k < basis.size(); ++k) sum.values[k] += basis[k] * part.irradiance;
  }
  return sum;
}

}  // namespace ssphh::transport
