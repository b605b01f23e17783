#include <algorithm>
#include <cmath>

#include <ssphh/core/math.h>
#include <ssphh/sh/evaluate.h>

#include "recurrence.h"

namespace ssphh::sh {
namespace {

template <class Real>
RecurrenceTable<Real> make_table() {
  RecurrenceTable<Real> table{};
  // N_mm (2m−1)!! √2, by the ratio of neighbours; √2 enters at m = 1.
  double diagonal = std::sqrt(1 / (4 * pi_d));
  for (int m = 0; m <= max_degree; ++m) {
    if (m > 0) diagonal *= std::sqrt((m == 1 ? 2.0 : 1.0) * (2 * m + 1) / (2.0 * m));
    table.diagonal[m] = static_cast<Real>(diagonal);
    for (int l = m + 1; l <= max_degree; ++l) {
      const double rise = std::sqrt((4.0 * l * l - 1) / (l * l - m * m));
      const double below = std::sqrt(((l - 1.0) * (l - 1.0) - m * m) / (4.0 * (l - 1) * (l - 1) - 1));
      const auto k = static_cast<std::size_t>(coefficient_index(l, m));
      table.rise[k] = static_cast<Real>(rise);
      table.fall[k] = l == m + 1 ? Real(0) : static_cast<Real>(rise * below);
    }
  }
  return table;
}

void check_degree(int degree, std::size_t room) {
  require_degree(degree, "basis functions");
  require(room >= static_cast<std::size_t>(coefficient_count(degree)), "basis functions",
          "there is no room for all of them");
}

}  // namespace

const RecurrenceTable<float>& recurrence_table_float() {
  static const RecurrenceTable<float> table = make_table<float>();
  return table;
}

const RecurrenceTable<double>& recurrence_table_double() {
  static const RecurrenceTable<double> table = make_table<double>();
  return table;
}

void eval_basis(int degree, const vec3& direction, std::span<float> out) {
  check_degree(degree, out.size());
  eval_recurrence(recurrence_table_float(), degree, direction.x, direction.y, direction.z, out.data());
}

void eval_basis(int degree, const glm::dvec3& direction, std::span<double> out) {
  check_degree(degree, out.size());
  eval_recurrence(recurrence_table_double(), degree, direction.x, direction.y, direction.z, out.data());
}

void eval_basis(int degree, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                std::span<float> out) {
  const std::size_t count = x.size();
  require_degree(degree, "basis functions");
  const auto coefficients = static_cast<std::size_t>(coefficient_count(degree));
  require(y.size() == count && z.size() == count, "basis functions", "x, y and z differ in number");
  require(out.size() >= coefficients * count, "basis functions", "there is no room for all of them");
  const RecurrenceTable<float>& table = recurrence_table_float();
  for_this_cpu([&]() SSPHH_IN_LOOP {
    float8 values[max_coefficient_count];
    for (std::size_t first = 0; first < count; first += lane_count) {
      const std::size_t n = std::min<std::size_t>(lane_count, count - first);
      float8 dx{}, dy{}, dz{};
      const auto load = [&](std::span<const float> from, float8& to) SSPHH_IN_LOOP {
        n == lane_count ? void(__builtin_memcpy(&to, &from[first], sizeof to))
                        : void(__builtin_memcpy(&to, &from[first], n * sizeof(float)));
      };
      load(x, dx), load(y, dy), load(z, dz);
      eval_recurrence(table, degree, dx, dy, dz, values);
      for (std::size_t k = 0; k < coefficients; ++k) {
        float* to = out.data() + k * count + first;
        n == lane_count ? void(__builtin_memcpy(to, &values[k], sizeof(float8)))
                        : void(__builtin_memcpy(to, &values[k], n * sizeof(float)));
      }
    }
  });
}

}  // namespace ssphh::sh
