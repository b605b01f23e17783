#pragma once

#include <ssphh/methods/parameters.h>

namespace ssphh::methods {

/// Where the probes of a method stand: where it finds places, where the scene has SPHLs, or on a regular
/// grid.
enum class ProbePlaces { found, scene, grid };
constexpr auto enum_table(ProbePlaces) {
  using enum ProbePlaces;
  return std::to_array<EnumName<ProbePlaces>>({{found, "auto"}, {scene, "scene"}, {grid, "grid"}});
}

/// The parameter `places`, for one of `among`, the first of which is the default.
inline MethodParameter places_parameter(std::initializer_list<ProbePlaces> among, const char* about) {
  std::vector<std::string> names;
  for (const ProbePlaces places : among) names.emplace_back(name_of(places));
  return choice_parameter("places", *among.begin(), about, names);
}

inline ProbePlaces probe_places(const MethodParameters& p) {
  return p.choice<ProbePlaces>("places");
}

}  // namespace ssphh::methods
