#pragma once

#include <ssphh/core/enum_names.h>

namespace ssphh::rays {

/// What may lie between a light and a probe, in Heckbert's notation: L{D|S}*, every scattering; or L{D}*, the
/// diffuse lobes of opaque surfaces alone, so that mirrors are as black as glass.
enum class PathSet { all, diffuse };
constexpr auto enum_table(PathSet) {
  using enum PathSet;
  return std::to_array<EnumName<PathSet>>({{all, "all"}, {diffuse, "diffuse"}});
}

}  // namespace ssphh::rays
