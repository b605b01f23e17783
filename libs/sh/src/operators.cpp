#include <array>

#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/operators.h>

namespace ssphh::sh {
namespace {

constexpr float inverse_root_4pi = 0.28209479177387814f;

/// Whether it has the values that its degrees say.
bool is_whole(const TransferMatrix& matrix) {
  return matrix.values.size() == static_cast<std::size_t>(coefficient_count(matrix.arriving_degree)) *
                                     static_cast<std::size_t>(coefficient_count(matrix.emitted_degree));
}

/// sum[k] += factor·H[k]·S[k].
void add_products(RadianceSh& sum, const RadianceSh& response, const RadianceSh& source, float factor,
                  const char* where) {
  const std::size_t count = sum.values.size();
  require(response.values.size() == count && source.values.size() == count, where,
          "sum, response and source must have one degree");
  for (std::size_t k = 0; k < count; ++k) sum.values[k] += factor * response.values[k] * source.values[k];
}

}  // namespace

vec3 mean(const RadianceSh& radiance) {
  return radiance.empty() ? vec3(0) : radiance[0] * inverse_root_4pi;
}

RadianceSh add(const RadianceSh& a, const RadianceSh& b) {
  RadianceSh sum = a;
  sum += b;
  return sum;
}

void add_coefficient_product(RadianceSh& sum, const RadianceSh& response, const RadianceSh& source) {
  add_products(sum, response, source, inverse_root_4pi, "coefficient product");
}

void add_raw_product(RadianceSh& sum, const RadianceSh& response, const RadianceSh& source) {
  add_products(sum, response, source, 1, "raw product");
}

void add_mean_product(RadianceSh& sum, const RadianceSh& response, const RadianceSh& source) {
  const std::size_t count = sum.values.size();
  require(response.values.size() == count && !source.empty(), "mean product",
          "sum and response must have one degree, and the source a mean");
  const vec3 level = mean(source);
  for (std::size_t k = 0; k < count; ++k) sum.values[k] += response.values[k] * level;
}

TransferMatrix::TransferMatrix(int arriving_degree_, int emitted_degree_)
    : arriving_degree(arriving_degree_), emitted_degree(emitted_degree_) {
  require_degree(arriving_degree, "transfer matrix");
  require_degree(emitted_degree, "transfer matrix");
  values.assign(
      static_cast<std::size_t>(coefficient_count(arriving_degree) * coefficient_count(emitted_degree)),
      vec3(0));
}

TransferMatrix& TransferMatrix::operator+=(const TransferMatrix& other) {
  require(arriving_degree == other.arriving_degree && emitted_degree == other.emitted_degree &&
              values.size() == other.values.size(),
          "sum of transfer matrices", "their degrees differ");
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += other.values[i];
  return *this;
}

void add_path(TransferMatrix& transfer, const vec3& throughput, const vec3& arriving, const vec3& emitted) {
  require(is_whole(transfer), "path into a transfer matrix", "its degrees and its size do not agree");
  std::array<float, max_coefficient_count> rows, columns;
  eval_basis(transfer.arriving_degree, arriving, rows);
  eval_basis(transfer.emitted_degree, emitted, columns);
  vec3* value = transfer.values.data();
  const auto column_count = static_cast<std::size_t>(coefficient_count(transfer.emitted_degree));
  for (std::size_t k = 0; k < static_cast<std::size_t>(coefficient_count(transfer.arriving_degree)); ++k) {
    const vec3 row = throughput * rows[k];
    for (std::size_t j = 0; j < column_count; ++j) *value++ += row * columns[j];
  }
}

void add_matrix_product(RadianceSh& sum, const TransferMatrix& transfer, const RadianceSh& source) {
  require(sum.degree() == transfer.arriving_degree && source.degree() == transfer.emitted_degree &&
              transfer.values.size() == sum.values.size() * source.values.size(),
          "matrix product", "sum, matrix and source are not of matching degrees");
  const vec3* value = transfer.values.data();
  for (vec3& target : sum.values) {
    for (const vec3& s : source.values) target += *value++ * s;
  }
}

}  // namespace ssphh::sh
