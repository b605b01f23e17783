#include <fmt/format.h>

#include <ssphh/core/json.h>

#include "writers.h"

namespace ssphh::probe_export {
namespace {

/// Seven sub-volumes along z of four of the 27 numbers each, c0 r g b, c1 r g b ...; each with a copy of its
/// outermost slices at either end, so that filtering does not mix it with the next.
std::vector<std::byte> texture_of(const LightGrid& grid) {
  constexpr int volumes = 7, lanes = 4, numbers = 27;
  const glm::ivec3 size = grid.shape.size;
  ByteWriter out;
  for (int t = 0; t < volumes; ++t) {
    for (int slice = -1; slice <= size.z; ++slice) {
      const int z = glm::clamp(slice, 0, size.z - 1);
      for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
          const sh::RadianceSh& light = grid.light[grid.shape.index({x, y, z})];
          for (int lane = 0; lane < lanes; ++lane) {
            const int n = lanes * t + lane;
            write_half(out, n < numbers ? light[n / 3][n % 3] : 0.0f, "grid for three.js");
          }
        }
      }
    }
  }
  return out.take();
}

}  // namespace

Exported write_three(const ExportSource& source, const std::string& name, const Control& control) {
  const LightGrid grid = make_grid(source, control);
  const glm::ivec3 size = grid.shape.size;
  const int depth = 7 * (size.z + 2);
  const json::Value header = {{"format", "ssphh-three-grid"},
                              {"version", 1},
                              {"min", json_triple(grid.shape.low)},
                              {"max", json_triple(grid.shape.high())},
                              {"resolution", json::Value::array({size.x, size.y, size.z})},
                              {"texture", json::Value{{"file", name + ".bin"},
                                                      {"type", "half"},
                                                      {"width", size.x},
                                                      {"height", size.y},
                                                      {"depth", depth}}}};
  Exported result{{{"", bytes_of(json::print(header, 2) + "\n")}, {".bin", texture_of(grid)}},
                  grid.light.size(),
                  grid.filled.size(),
                  {}};
  if (depth > 256) {
    result.notes.push_back(
        fmt::format("the texture is {} texels deep: WebGL 2 promises 256, common GPUs have 2048", depth));
  }
  return result;
}

}  // namespace ssphh::probe_export
