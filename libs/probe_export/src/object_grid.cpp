#include "object_grid.h"

#include <ssphh/core/json.h>

namespace ssphh::probe_export {

Exported write_object_grid(const ExportSource& source, const std::string& name, const std::string& engine,
                           const std::array<ObjectColor, 9>& colors, const Control& control) {
  const LightGrid grid = make_grid(source, control);
  ByteWriter numbers;
  for (const sh::RadianceSh& light : grid.light) {
    for (const ObjectColor& color : colors)
      numbers.vector3(static_cast<float>(color.factor) * light[color.coefficient]);
  }
  const json::Value header = {
      {"format", "ssphh-" + engine + "-grid"},
      {"version", 1},
      {"min", json_triple(grid.shape.low)},
      {"max", json_triple(grid.shape.high())},
      {"resolution", json::Value::array({grid.shape.size.x, grid.shape.size.y, grid.shape.size.z})},
      {"light", json::Value{{"file", name + ".bin"}, {"type", "float32"}, {"numbers", 3 * colors.size()}}}};
  return {{{"", bytes_of(json::print(header, 2) + "\n")}, {".bin", numbers.take()}},
          grid.light.size(),
          grid.filled.size(),
          {"an object is lit by the light at one place: the page asks the grid for it as the object moves"}};
}

}  // namespace ssphh::probe_export
