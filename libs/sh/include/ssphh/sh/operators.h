#pragma once
/// What ⊗ of S′_i = S_i ⊕ Σ_j H_{j→i} ⊗ S_j can mean: `coefficient`, `raw`, `mean` and `matrix`. Each adds to
/// a sum of the same degree, so that a hierarchy is a loop without allocation. H is the response at probe i
/// to the sphere at j, which shines alike in all directions; S_j is the light of probe j.

#include <vector>

#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

/// Mean of the function over the sphere, S[0]/√4π.
vec3 mean(const RadianceSh& radiance);

/// a ⊕ b: the sum of two functions of one degree.
RadianceSh add(const RadianceSh& a, const RadianceSh& b);

/// sum[k] += H[k]·S[k]/√4π (Metzgar & Semwal). The factor makes two constant functions multiply right.
/// Neither a product nor a convolution of functions: it depends on the axes and on the signs of the basis.
void add_coefficient_product(RadianceSh& sum, const RadianceSh& response, const RadianceSh& source);

/// sum[k] += H[k]·S[k], as the paper writes it: √4π times the above.
void add_raw_product(RadianceSh& sum, const RadianceSh& response, const RadianceSh& source);

/// sum[k] += H[k]·S[0]/√4π: the response's directions with the mean of the source.
void add_mean_product(RadianceSh& sum, const RadianceSh& response, const RadianceSh& source);

/// Linear map from coefficients of the radiance that a sphere gives off to those of the radiance that
/// arrives, one factor per colour channel.
struct TransferMatrix {
  int arriving_degree = -1, emitted_degree = -1;
  std::vector<vec3> values;  ///< [k · coefficient_count(emitted_degree) + k′]

  TransferMatrix() = default;
  /// All zero.
  TransferMatrix(int arriving_degree_, int emitted_degree_);
  TransferMatrix& operator+=(const TransferMatrix& other);
};

/// values[k, k′] += throughput · Y_k(arriving) · Y_k′(emitted), for one traced path that arrives from the
/// unit direction `arriving` and left the sphere in the unit direction `emitted`.
void add_path(TransferMatrix& transfer, const vec3& throughput, const vec3& arriving, const vec3& emitted);

/// sum += T·S. `sum` has the arriving degree, `source` the emitted degree.
void add_matrix_product(RadianceSh& sum, const TransferMatrix& transfer, const RadianceSh& source);

}  // namespace ssphh::sh
