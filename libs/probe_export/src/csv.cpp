#include <fmt/format.h>

#include "writers.h"

namespace ssphh::probe_export {
namespace {

/// Quoted as RFC 4180 has it.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

}  // namespace

Exported write_csv(const ExportSource& source, const std::string&, const Control&) {
  const std::vector<sh::RadianceSh> light = written_light(source);
  std::string text = "name,x,y,z,radius";
  for (int k = 0; k < sh::coefficient_count(source.set.degree); ++k)
    text += fmt::format(",r{0},g{0},b{0}", k);
  text += '\n';
  for (std::size_t i = 0; i < light.size(); ++i) {
    const probes::Probe& probe = source.set.probes[i];
    text += fmt::format("{},{},{},{},{}", quoted(probe.name), probe.position.x, probe.position.y,
                        probe.position.z, probe.radius);
    for (const vec3& v : light[i].values) text += fmt::format(",{},{},{}", v.x, v.y, v.z);
    text += '\n';
  }
  return {{{"", bytes_of(text)}}, light.size(), 0, {}};
}

}  // namespace ssphh::probe_export
