#include <algorithm>

#include <fmt/format.h>

#include <ssphh/bake/gen.h>

#include "project_cube_map.h"

namespace ssphh::bake {
namespace {

bool is_zero(const sh::RadianceSh& function) {
  return std::ranges::all_of(function.values, [](const vec3& v) { return v == vec3(0); });
}

void check_finite(const sh::RadianceSh& function, const rays::CubeRequest& request,
                  const std::string& group) {
  if (std::ranges::all_of(function.values, [](const vec3& v) { return is_finite(v); })) return;
  throw Error(fmt::format("probe at ({:g}, {:g}, {:g}), light group \"{}\"", request.position.x,
                          request.position.y, request.position.z, group),
              "the traced radiance is not finite");
}

}  // namespace

std::vector<probes::GroupLight> gen(const rays::RadianceSource& source, const rays::CubeRequest& request,
                                    int degree, const Control& control) {
  sh::require_degree(degree, "GEN");
  const std::vector<rays::GroupRadiance> radiance = source.incident_radiance(request, control);
  require(radiance.size() == source.light_groups().size(), "radiance source",
          "it answers with another number of light groups than it names");
  const sh::CubeProjector projector(degree, request.face_size);
  std::vector<probes::GroupLight> groups(radiance.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    groups[g].emitted = project_cube_map(projector, radiance[g].emitted);
    groups[g].reflected = project_cube_map(projector, radiance[g].reflected);
    check_finite(groups[g].emitted, request, source.light_groups()[g]);
    check_finite(groups[g].reflected, request, source.light_groups()[g]);
    if (is_zero(groups[g].emitted)) groups[g].emitted = {};
  }
  return groups;
}

}  // namespace ssphh::bake
