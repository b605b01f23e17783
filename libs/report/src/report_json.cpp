#include "report_json.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/json_cursor.h>

namespace ssphh::report {
namespace {

json::Value finite(double x) {
  return std::isfinite(x) ? json::Value(x) : json::Value(nullptr);
}

json::Value scenes_data(const Report& report) {
  json::Value scenes = json::Value::array();
  for (std::size_t s = 0; s < report.plan.scenes.size(); ++s) {
    const PlanScene& scene = report.plan.scenes[s];
    json::Value insets = json::Value::array();
    for (const Inset& i : scene.insets)
      insets.push_back({{"name", i.name}, {"at", {i.x0, i.y0, i.x1, i.y1}}});
    const auto hash = report.provenance.scene_hashes.find(scene.name);
    scenes.push_back(
        {{"name", scene.name},
         {"title", scene.title},
         {"exposure", exposure_of(report, s)},
         {"insets", std::move(insets)},
         {"hash", hash == report.provenance.scene_hashes.end() ? json::Value() : json::Value(hash->second)}});
  }
  return scenes;
}

json::Value cell_data(const Report& report, const ReportCell& cell) {
  const Plan& plan = report.plan;
  const PlanMethod& method = cell.method < 0 ? plan.reference : plan.methods[cell.method];
  json::Value parameters = json::Value::object(), values = json::Value::object(),
              steps = json::Value::array();
  for (const auto& [name, text] : cell.parameters) parameters[name] = text;
  for (const auto& [name, value] : cell.values) {
    values[name] = {{"mean", finite(value.mean)},
                    {"median", finite(value.median)},
                    {"deviation", finite(value.deviation)},
                    {"count", value.count}};
  }
  for (const StepRun& step : cell.steps) {
    steps.push_back({{"name", step.name},
                     {"repetition", step.repetition},
                     {"command", step.command},
                     {"key", step.key},
                     {"seconds", step.seconds},
                     {"peak_bytes", step.peak_bytes},
                     {"started", step.started},
                     {"machine", step.machine}});
  }
  return {{"scene", plan.scenes[cell.scene].name},
          {"method", method.name},
          {"title", method.title},
          {"about", method.about},
          {"label", cell.label},
          {"reference", cell.method < 0},
          {"parameters", std::move(parameters)},
          {"failure", cell.failure.empty() ? json::Value() : json::Value(cell.failure)},
          {"values", std::move(values)},
          {"steps", std::move(steps)}};
}

void require_scene(const Report& report, std::size_t scene) {
  if (scene >= report.plan.scenes.size())
    throw Error("report", fmt::format("there is no scene {} of {}", scene, report.plan.scenes.size()));
}

}  // namespace

std::string number_text(double value) {
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  return std::isnan(value) ? "" : fmt::format("{:.4g}", value);
}

void require_sound(const Report& report) {
  for (const ReportCell& cell : report.cells) {
    require_scene(report, cell.scene);
    if (cell.method >= static_cast<int>(report.plan.methods.size())) {
      throw Error("report",
                  fmt::format("a cell is of method {} of {}", cell.method, report.plan.methods.size()));
    }
  }
}

double exposure_of(const Report& report, std::size_t scene) {
  require_scene(report, scene);
  if (report.plan.scenes[scene].exposure) return *report.plan.scenes[scene].exposure;
  const ReportCell* chosen = nullptr;
  for (const ReportCell& cell : report.cells) {
    if (cell.scene == scene && !cell.pictures.empty() &&
        (!chosen || (cell.method < 0 && chosen->method >= 0)))
      chosen = &cell;
  }
  return chosen ? chosen->exposure : 0;
}

double published_value(const Report& report, const ReportCell& cell, const std::string& column) {
  for (const Published& row : report.plan.published) {
    const auto it = row.values.find(column);
    if (row.scene == report.plan.scenes[cell.scene].name && row.method == cell.label &&
        it != row.values.end())
      return it->second;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

json::Value json_of(const Report& report) {
  require_sound(report);
  const Provenance& p = report.provenance;
  json::Value columns = json::Value::array(), charts = json::Value::array(), published = json::Value::array(),
              cells = json::Value::array(), variables = json::Value::object();
  for (const Column& c : columns_of(report))
    columns.push_back({{"value", c.value}, {"title", c.title}, {"unit", c.unit}, {"better", c.better}});
  for (const Chart& c : report.plan.charts)
    charts.push_back({{"title", c.title}, {"x", c.x}, {"y", c.y}, {"log_x", c.log_x}, {"log_y", c.log_y}});
  for (const Published& row : report.plan.published)
    published.push_back({{"scene", row.scene}, {"method", row.method}, {"values", row.values}});
  for (const auto& [name, text] : report.plan.variables) variables[name] = text;
  for (const ReportCell& cell : report.cells) cells.push_back(cell_data(report, cell));
  return {{"title", report.plan.title},
          {"about", report.plan.about},
          {"provenance",
           {{"identity", p.identity},
            {"version", p.version},
            {"build", p.build},
            {"commit", p.commit},
            {"machine", p.machine},
            {"created", p.created},
            {"command", p.command}}},
          {"notes", report.notes},
          {"variables", std::move(variables)},
          {"block", report.plan.block},
          {"layers", report.plan.layers},
          {"scenes", scenes_data(report)},
          {"columns", std::move(columns)},
          {"charts", std::move(charts)},
          {"published", {{"source", report.plan.published_source}, {"rows", std::move(published)}}},
          {"cells", std::move(cells)}};
}

std::string report_json(const Report& report) {
  return json::print(json_of(report), 2) + "\n";
}

std::string identity_of(const std::string& text) {
  try {
    const std::string where = "report";
    const json::Value report = json::parse(text, where);
    return json::Cursor(report, where)["provenance"].text_or("identity");
  } catch (const Error&) {
    return "";
  }
}

}  // namespace ssphh::report
