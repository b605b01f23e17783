#include "commands/probe_convert.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/probes/probe_file.h>

#include "commands/command.h"
#include "options/probe_options.h"
#include "results/json_values.h"

namespace ssphh::app {
namespace {

int degree_to_keep(const ProbeConvertOptions& o, int of_file) {
  int highest = of_file;
  while (highest >= 0 && !sh::packs(o.pack, highest)) --highest;
  const int degree = o.degree.value_or(highest < 0 ? of_file : highest);
  if (degree > of_file)
    throw Error(o.input, fmt::format("is of degree {}: there is no band {}", of_file, degree),
                "leave --degree out, or choose a lower one");
  if (!sh::packs(o.pack, degree))
    throw Error("--pack",
                fmt::format("{} is of degree {}, not {}", name_of(o.pack),
                            o.pack == sh::Packing::zh3 ? "2" : "2 or 4", degree),
                degree < 2 ? "rgb9e5 is as small for fewer bands" : "leave --degree out");
  return degree;
}

std::uint64_t light_bytes(const probes::ProbeSet& set, sh::Packing pack) {
  std::uint64_t functions = set.hierarchy ? set.probes.size() : 0;
  for (const probes::Probe& probe : set.probes)
    for (const probes::GroupLight& light : probe.groups) functions += light.emitted.empty() ? 1 : 2;
  return functions * sh::packed_bytes(pack, set.degree);
}

std::vector<std::string> left_out(const ProbePackingLoss& loss, sh::Packing pack, int degree) {
  std::vector<std::string> lines;
  if (pack == sh::Packing::bc6h && degree > 2) lines.push_back("band 3, which irradiance does not have");
  if (degree < loss.degree)
    lines.push_back(degree + 1 == loss.degree ? fmt::format("band {}", loss.degree)
                                              : fmt::format("bands {} to {}", degree + 1, loss.degree));
  if (loss.edges > 0)
    lines.push_back(counted(loss.edges, "edge") + " between probes, which `ssphh hier` needs");
  if (loss.baseline) lines.push_back("the baseline, which `ssphh bake --update` needs");
  return lines;
}

}  // namespace

ProbeConvertResult run_probe_convert(const ProbeConvertOptions& o, const Control&) {
  const probes::ProbeSet set = probes::read_probe_file(o.input);
  ProbeConvertResult result;
  result.probes = set.probes.size();
  result.degree = degree_to_keep(o, set.degree);
  const probes::ProbeSet* written = &set;
  std::optional<probes::ProbeSet> compact;
  if (o.pack != sh::Packing::none || result.degree < set.degree)
    written = &compact.emplace(probes::compacted(set, result.degree));
  probes::write_probe_file(*written, o.output, o.pack);
  result.light_bytes = light_bytes(*written, o.pack);
  if (compact)
    result.loss = {set.degree, probes::edge_count(set), set.baseline.has_value(),
                   probes::irradiance_loss(set, probes::read_probe_file(o.output))};
  result.bytes = std::filesystem::file_size(o.output);
  return result;
}

json::Value to_json(const ProbeConvertResult& result, const ProbeConvertOptions& o) {
  json::Value object = {{"output", o.output},
                        {"probes", result.probes},
                        {"bytes", result.bytes},
                        {"pack", name_of(o.pack)},
                        {"degree", result.degree},
                        {"function_bytes", sh::packed_bytes(o.pack, result.degree)},
                        {"light_bytes", result.light_bytes}};
  if (!result.loss) return object;
  json::Value lines = json::Value::array();
  for (const std::string& line : left_out(*result.loss, o.pack, result.degree)) lines.push_back(line);
  const probes::IrradianceLoss& irradiance = result.loss->irradiance;
  object["left_out"] = std::move(lines);
  object["irradiance_error"] = {{"mean", to_json(irradiance.mean)},
                                {"p95", to_json(irradiance.most_of_95)},
                                {"max", to_json(irradiance.largest)},
                                {"dark_probes", irradiance.dark}};
  return object;
}

std::string to_text(const ProbeConvertResult& result, const ProbeConvertOptions& o) {
  std::string text =
      fmt::format("{}: {}, {}", o.output, counted(result.probes, "probe"), counted(result.bytes, "byte"));
  if (!result.loss) return text;
  const ProbePackingLoss& loss = *result.loss;
  const auto percent = [](const vec3& v) {
    return fmt::format("{:.3g}, {:.3g}, {:.3g} %", 100 * v.x, 100 * v.y, 100 * v.z);
  };
  text += fmt::format("\n{} of degree {}: {} a function, {} of light", name_of(o.pack), result.degree,
                      counted(sh::packed_bytes(o.pack, result.degree), "byte"),
                      counted(result.light_bytes, "byte"));
  text += fmt::format(
      "\nirradiance is off by (R, G, B, in shares of each probe's mean)\n  mean  {}\n  95 %  {}\n  most  {}",
      percent(loss.irradiance.mean), percent(loss.irradiance.most_of_95), percent(loss.irradiance.largest));
  for (const std::string& line : left_out(loss, o.pack, result.degree)) text += "\nleft out: " + line;
  return text;
}

void add_probe_convert_command(Command group, Context& context) {
  auto [command, o] =
      add_command(group, context, "convert",
                  "Convert between .sphl (binary) and .sphl.json, and to fewer bytes", run_probe_convert);
  add_probe_file(command, "FILE", o.input, "Probe file to read").required();
  add_probe_output(command, "-o,--output", o.output, "Probe file to write").required();
  command.choice(
      "--pack", o.pack,
      "How .sphl holds light: floats; half floats; RGB9E5 and bytes; the same of ZH3 (degree 2); maps of "
      "irradiance in BC6H (degree 2 or 4)");
  command
      .option("--degree", o.degree,
              "Highest band to keep; default: the file's, or the highest that the packing has")
      .range(0, sh::max_degree);
  command.footer(
      "With either, edges and the baseline are left out, and it is told how far irradiance is from the "
      "file's "
      "that was\nread. docs/compact-probes.md tells what each packing loses in real scenes.");
}

}  // namespace ssphh::app
