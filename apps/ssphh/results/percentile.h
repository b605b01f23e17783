#pragma once

#include <vector>

namespace ssphh::app {

/// The smallest of the values that a share of them (0..1) does not exceed; 0 without values.
double percentile(std::vector<double> values, double share);

}  // namespace ssphh::app
