#pragma once
/// The error of a lookup as commands tell it.

#include <string>

#include <ssphh/core/json.h>
#include <ssphh/study/lookup_error.h>

namespace ssphh::app {

/// Each figure as a list of three, red, green and blue; "luminance" and "worst" hold the same names as
/// numbers, "chromaticity" its own. A ratio that is none is null.
json::Value to_json(const study::LookupError& error);

/// The three ratios, each in a column of seven.
std::string ratio_columns(const study::LookupError& error);

}  // namespace ssphh::app
