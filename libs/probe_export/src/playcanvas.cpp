#include <ssphh/sh/convert.h>

#include "object_grid.h"

namespace ssphh::probe_export {

/// As PlayCanvas' materials have them in `ambientSH`: E/π with the basis constants multiplied in, those of
/// 1, x, y, z, zx, zy, yx, 3z²−1, x²−y².
Exported write_playcanvas(const ExportSource& source, const std::string& name, const Control& control) {
  std::array<ObjectColor, 9> colors = {{{0}, {3}, {1}, {2}, {7}, {5}, {4}, {6}, {8}}};
  for (ObjectColor& color : colors)
    color.factor = sh::convention_factor(sh::Convention::filament, color.coefficient);
  return write_object_grid(source, name, "playcanvas", colors, control);
}

}  // namespace ssphh::probe_export
