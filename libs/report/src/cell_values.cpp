#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <ssphh/core/json.h>
#include <ssphh/core/parse_number.h>
#include <ssphh/report/report.h>

namespace ssphh::report {
namespace {

constexpr std::size_t longest_list = 16;  ///< of which the elements are values, NAME.0 and so on

void add(const std::string& name, const json::Value& json,
         std::map<std::string, std::vector<double>>& values) {
  if (json.is_object()) {
    for (const auto& [key, child] : json.members()) add(name + "." + key, child, values);
  } else if (json.is_array() && json.size() <= longest_list) {
    for (std::size_t i = 0; i < json.size(); ++i) add(fmt::format("{}.{}", name, i), json[i], values);
  } else if (json.is_boolean()) {
    values[name].push_back(json.boolean() ? 1 : 0);
  } else if (json.is_number()) {
    values[name].push_back(json.number());
  }
}

bool is_time(const std::string& name) {
  return name.ends_with("seconds");
}

}  // namespace

Value value_of(std::vector<double> numbers) {
  Value value;
  value.count = static_cast<int>(numbers.size());
  if (numbers.empty()) return value;
  const double n = static_cast<double>(numbers.size());
  for (const double x : numbers) value.mean += x / n;
  double squares = 0;
  for (const double x : numbers) squares += (x - value.mean) * (x - value.mean);
  if (numbers.size() > 1) value.deviation = std::sqrt(squares / (n - 1));
  if (std::isnan(value.mean)) {  // which cannot be sorted
    value.median = value.mean;
    return value;
  }
  std::ranges::sort(numbers);
  const std::size_t middle = numbers.size() / 2;
  value.median = numbers.size() % 2 != 0 ? numbers[middle] : 0.5 * (numbers[middle - 1] + numbers[middle]);
  return value;
}

double shown(const ReportCell& cell, const std::string& name) {
  if (const auto it = cell.values.find(name); it != cell.values.end())
    return is_time(name) ? it->second.median : it->second.mean;
  for (const auto& [key, text] : cell.parameters) {
    if (key != name) continue;
    if (const auto number = parse_number<double>(text)) return *number;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<Column> columns_of(const Report& report) {
  if (!report.plan.columns.empty()) return report.plan.columns;
  if (!report.plan.has_reference) return {{"seconds", "seconds", "s", -1}};
  return {{"mean_ratio", "mean ratio", "", 0},
          {"mae", "MAE", "", -1},
          {"relmse", "relMSE", "", -1},
          {"relmse_method", "relMSE − reference's noise", "", -1},
          {"flip", "FLIP", "", -1},
          {"ssim", "SSIM", "", 1},
          {"seconds", "run", "s", -1}};
}

void add_numbers(const std::string& step, const std::string& text,
                 std::map<std::string, std::vector<double>>& values) {
  if (const auto printed = json::try_parse(text)) add(step, *printed, values);
}

}  // namespace ssphh::report
