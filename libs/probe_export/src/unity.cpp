#include <ssphh/sh/convert.h>

#include "scripts.h"
#include "writers.h"

namespace ssphh::probe_export {

/// As SphericalHarmonicsL2 has them, mirrored: Unity's x points the other way, and so do importers of glTF.
Exported write_unity(const ExportSource& source, const std::string&, const Control&) {
  std::vector<sh::RadianceSh> light = written_light(source);
  json::Value positions = json::Value::array(), numbers = json::Value::array();
  for (std::size_t i = 0; i < light.size(); ++i) {
    const vec3& p = source.set.probes[i].position;
    for (const float x : {-p.x, p.y, p.z}) positions.push_back(x);
    light[i].values.resize(static_cast<std::size_t>(sh::coefficient_count(2)), vec3(0));
    for (int channel = 0; channel < 3; ++channel) {
      for (int k = 0; k < 9; ++k) {
        const bool odd_in_x = k == 3 || k == 4 || k == 7;
        const double factor = sh::convention_factor(sh::Convention::unity, k) * (odd_in_x ? -1 : 1);
        numbers.push_back(static_cast<float>(factor) * light[i][k][channel]);
      }
    }
  }
  const json::Value file = {{"format", "ssphh-unity-probes"},
                            {"version", 1},
                            {"positions", std::move(positions)},
                            {"light", std::move(numbers)}};
  return {{{"", bytes_of(json::print(file) + "\n")}, {".cs", bytes_of(unity_script), true}},
          light.size(),
          0,
          {"lights dynamic objects alone: Unity takes lightmaps for static ones"}};
}

}  // namespace ssphh::probe_export
