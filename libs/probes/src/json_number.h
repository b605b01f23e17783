#pragma once

#include <string>

namespace ssphh::probes {

/// Appends a finite number as JSON with at most five significant digits, as short as they allow; below 1e-35:
/// 0. Reading the text as float and writing it again gives the same text.
void append_five_digits(std::string& out, float value);

}  // namespace ssphh::probes
