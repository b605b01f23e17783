// report.csv and report.md.

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "report_json.h"

namespace ssphh::report {
namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(double x) {
  return std::isfinite(x) ? fmt::format("{}", x) : "";
}

std::string markdown_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string indented(const std::string& text) {
  std::string result = "    ";
  for (const char c : text) {
    result += c;
    if (c == '\n') result += "    ";
  }
  return result;
}

void scene_table(const Report& report, std::size_t scene, std::string& out) {
  const std::vector<Column> columns = columns_of(report);
  out += "\n## " + report.plan.scenes[scene].title + "\n\n| method |";
  std::string rule = "|---|";
  for (const Column& column : columns) {
    out += fmt::format(" {}{} |", markdown_text(column.title),
                       column.unit.empty() ? "" : " [" + column.unit + "]");
    rule += "---:|";
  }
  out += "\n" + rule + "\n";
  for (const ReportCell& cell : report.cells) {
    if (cell.scene != scene) continue;
    out += fmt::format("| {}{} |", markdown_text(cell.label), cell.failure.empty() ? "" : " (failed)");
    for (const Column& column : columns) {
      const auto value = cell.values.find(column.value);
      std::string text = number_text(shown(cell, column.value));
      if (value != cell.values.end() && value->second.count > 1)
        text += fmt::format(" ± {:.2g}", value->second.deviation);
      const double published = published_value(report, cell, column.title);
      if (!std::isnan(published)) text += fmt::format(" ({})", number_text(published));
      out += " " + text + " |";
    }
    out += "\n";
  }
}

}  // namespace

std::string report_csv(const Report& report) {
  require_sound(report);
  std::set<std::string> parameters, values;
  for (const ReportCell& cell : report.cells) {
    for (const auto& [name, text] : cell.parameters) parameters.insert(name);
    for (const auto& [name, value] : cell.values) values.insert(name);
  }
  std::string out = "scene,method,label,failed,runs";
  for (const std::string& name : parameters) out += "," + csv_field("parameter " + name);
  for (const std::string& name : values) out += "," + csv_field(name) + "," + csv_field(name + " deviation");
  out += "\r\n";
  for (const ReportCell& cell : report.cells) {
    const Plan& plan = report.plan;
    const PlanMethod& method = cell.method < 0 ? plan.reference : plan.methods[cell.method];
    out += fmt::format("{},{},{},{},{}", csv_field(plan.scenes[cell.scene].name), csv_field(method.name),
                       csv_field(cell.label), cell.failure.empty() ? 0 : 1, method.repetitions);
    for (const std::string& name : parameters) {
      std::string text;
      for (const auto& [key, value] : cell.parameters) text = key == name ? value : text;
      out += "," + csv_field(text);
    }
    for (const std::string& name : values) {
      const auto it = cell.values.find(name);
      const bool many = it != cell.values.end() && it->second.count > 1;
      out += "," + csv_number(it == cell.values.end() ? std::nan("") : shown(cell, name));
      out += "," + csv_number(many ? it->second.deviation : std::nan(""));
    }
    out += "\r\n";
  }
  return out;
}

std::string report_markdown(const Report& report) {
  require_sound(report);
  const Provenance& p = report.provenance;
  std::string out = "# " + report.plan.title + "\n";
  if (!report.plan.about.empty()) out += "\n" + report.plan.about + "\n";
  out += fmt::format("\n`{}`, {}, ssphh {}{}.\n", p.command, p.machine, p.version,
                     p.commit.empty() ? "" : " (" + p.commit + ")");
  if (!report.plan.published_source.empty())
    out += fmt::format("In parentheses: {}.\n", report.plan.published_source);
  for (const std::string& note : report.notes) out += "\n* " + note + "\n";
  for (std::size_t s = 0; s < report.plan.scenes.size(); ++s) {
    for (const ReportCell& cell : report.cells) {
      if (cell.scene != s) continue;
      scene_table(report, s, out);
      break;
    }
  }
  for (const ReportCell& cell : report.cells) {
    if (!cell.failure.empty())
      out += fmt::format("\n## Failed: {}, {}\n\n{}\n", report.plan.scenes[cell.scene].name, cell.label,
                         indented(cell.failure));
  }
  out += "\n## Commands\n\n";
  std::set<std::string> listed;
  for (const ReportCell& cell : report.cells) {
    for (const StepRun& step : cell.steps) {
      if (listed.insert(step.key).second)
        out += fmt::format("* `ssphh {}`: {:.2f} s, {} MiB, {}\n", step.command, step.seconds,
                           step.peak_bytes >> 20, step.started);
    }
  }
  return out;
}

}  // namespace ssphh::report
