#pragma once
/// Names and values of a plan: variables, and what a method runs with.

#include <ssphh/report/plan.h>

#include "json_reader.h"

namespace ssphh::report {

/// Numbers and texts by name.
Parameters read_parameters(const Json& json, const std::string& where);

/// An object of lists stands for every combination, a list of objects for itself; absent: one empty variant.
std::vector<Parameters> read_variants(const Json* json, const std::string& where);

}  // namespace ssphh::report
