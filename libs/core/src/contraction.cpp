#include <algorithm>
#include <limits>
#include <vector>

#include <ssphh/core/contraction.h>

namespace ssphh {

Contraction contraction(std::size_t rows, const ApplyMatrix& apply, int steps) {
  // x stays positive by a small share of its old value everywhere: rows that nothing reaches would make the
  // lower bound 0 and stop the upper one from falling.
  Contraction bounds;
  if (rows == 0) return bounds;
  std::vector<double> x(rows, 1), y(rows);
  double best_upper = std::numeric_limits<double>::infinity();
  for (int step = 0; step < steps; ++step) {
    apply(x, y);
    double lower = std::numeric_limits<double>::infinity(), upper = 0, largest = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      lower = std::min(lower, y[i] / x[i]);
      upper = std::max(upper, y[i] / x[i]);
      largest = std::max(largest, y[i]);
    }
    bounds.lower = std::max(bounds.lower, lower);
    best_upper = std::min(best_upper, upper);
    if (!(largest > 0)) break;
    for (std::size_t i = 0; i < rows; ++i) x[i] = std::max(y[i] / largest, 1e-6);
  }
  bounds.upper = best_upper;
  return bounds;
}

}  // namespace ssphh
