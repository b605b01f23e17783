#pragma once
/// The recurrence of evaluate.h, for scalars and for SIMD vectors alike.

#include <ssphh/core/for_this_cpu.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

/// Eight floats side by side (GCC and Clang vector extension; one AVX register, or two SSE ones).
using float8 = float __attribute__((vector_size(32)));
inline constexpr int lane_count = 8;

/// Constants of p_mm = diagonal[m] and p_lm = rise[k] z p_(l−1)m − fall[k] p_(l−2)m with k =
/// coefficient_index(l, m).
template <class Real>
struct RecurrenceTable {
  Real diagonal[max_degree + 1];
  Real rise[max_coefficient_count];
  Real fall[max_coefficient_count];
};

const RecurrenceTable<float>& recurrence_table_float();
const RecurrenceTable<double>& recurrence_table_double();

/// `Value` is Real or a vector of it; out[k · stride] = Y_k(x, y, z).
template <class Value, class Real>
SSPHH_IN_LOOP inline void eval_recurrence(const RecurrenceTable<Real>& table, int degree, const Value& x_,
                                          const Value& y_, const Value& z_, Value* out) {
  const Value x = x_, y = y_, z = z_;        // `out` cannot alias these
  Value cosine = Value{} + Real(1), sine{};  // Re and Im of (x + iy)^m
  for (int m = 0; m <= degree; ++m) {
    Value older{}, p = Value{} + table.diagonal[m];
    for (int l = m; l <= degree; ++l) {
      const int k = coefficient_index(l, m);
      if (l > m) {
        const Value next = table.rise[k] * z * p - table.fall[k] * older;
        older = p;
        p = next;
      }
      out[k] = p * cosine;
      if (m > 0) out[k - 2 * m] = p * sine;
    }
    const Value c = x * cosine - y * sine;
    sine = x * sine + y * cosine;
    cosine = c;
  }
}

}  // namespace ssphh::sh
