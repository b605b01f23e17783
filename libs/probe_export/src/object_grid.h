#pragma once

#include <array>

#include "writers.h"

namespace ssphh::probe_export {

/// One of the nine colours that an engine lights an object by: a factor times a coefficient of radiance.
struct ObjectColor {
  int coefficient;
  double factor = 0;
};

/// A grid of nine colours a point as 32-bit floats, and a header with its place. `engine` names the format.
Exported write_object_grid(const ExportSource& source, const std::string& name, const std::string& engine,
                           const std::array<ObjectColor, 9>& colors, const Control& control);

}  // namespace ssphh::probe_export
