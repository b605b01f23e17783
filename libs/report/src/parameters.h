#pragma once
/// Names and values of a plan: variables, and what a method runs with.

#include <optional>

#include <ssphh/core/json_cursor.h>
#include <ssphh/report/plan.h>

namespace ssphh::report {

/// Numbers and texts by name.
Parameters read_parameters(const json::Cursor& object);

/// An object of lists stands for every combination, a list of objects for itself; absent: one empty variant.
std::vector<Parameters> read_variants(const std::optional<json::Cursor>& variants);

}  // namespace ssphh::report
