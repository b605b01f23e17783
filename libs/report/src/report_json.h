#pragma once
/// The report as JSON, for report.json and, with where its pictures are, for the page; and numbers as people
/// read them.

#include <ssphh/core/json.h>
#include <ssphh/report/report.h>

namespace ssphh::report {

json::Value json_of(const Report& report);

/// Throws Error for a cell of a scene or method that the plan does not have.
void require_sound(const Report& report);

/// Numbers for people: four significant digits; "" for NaN.
std::string number_text(double value);

/// The number that was published for this cell, or NaN.
double published_value(const Report& report, const ReportCell& cell, const std::string& column);

}  // namespace ssphh::report
