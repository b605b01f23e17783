#include <fmt/format.h>

#include "scripts.h"
#include "writers.h"

namespace ssphh::probe_export {

/// A script that makes the probes: Blender has no data of its own for light of probes that can be set.
Exported write_blender(const ExportSource& source, const std::string&, const Control&) {
  const std::vector<sh::RadianceSh> light = written_light(source);
  json::Value probes = json::Value::array();
  for (std::size_t i = 0; i < light.size(); ++i) {
    const probes::Probe& probe = source.set.probes[i];
    json::Value radiance = json::Value::array();
    for (const vec3& v : light[i].values) {
      for (int channel = 0; channel < 3; ++channel) radiance.push_back(v[channel]);
    }
    probes.push_back({{"name", probe.name},
                      {"position", json_triple(probe.position)},
                      {"radius", probe.radius},
                      {"radiance", std::move(radiance)}});
  }
  const json::Value data = {{"degree", source.set.degree}, {"probes", std::move(probes)}};
  // Numbers, arrays, objects and texts of JSON are Python's.
  const std::string script = fmt::format(
      "\"\"\"Light probes of ssphh for Blender: `blender SCENE.blend --python THIS_FILE`.\"\"\"\n\nDATA = "
      "{}\n\n\n{}",
      json::print(data), blender_script);
  return {{{"", bytes_of(script)}},
          light.size(),
          0,
          {"the balls show what white surfaces would, and light nothing"}};
}

}  // namespace ssphh::probe_export
