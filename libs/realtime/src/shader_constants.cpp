#include "shader_constants.h"

#include <fmt/format.h>

#include <ssphh/methods/vct/cones.h>
#include <ssphh/methods/vpl/virtual_lights.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/realtime/settings.h>
#include <ssphh/shading/bsdf.h>

#include "environment_tiles.h"
#include "gpu_types.h"
#include "method_types.h"

namespace ssphh::realtime {
namespace {

using probes::ShaderConstant;

template <class T>
constexpr ShaderConstant whole(const char* name, T value) {
  return {name, static_cast<float>(value), true};
}

constexpr ShaderConstant constants[] = {
    // Sizes of blocks and textures
    whole("MAX_SAMPLES", max_area_samples),
    whole("MAX_CORNERS", max_corners),
    whole("SUN_CASCADES", sun_cascades),
    whole("MAX_PARALLEL_MAPS", max_parallel_maps),
    whole("LIST_WIDTH_LOG2", list_width_log2),
    whole("ENVIRONMENT_LEVELS", environment_roughness.size()),
    whole("RADIANCE_LEVELS", radiance_roughness.size()),
    whole("MAX_DEGREE", sh::max_degree),
    // Choices
    whole("VIEW_ALBEDO", View::albedo),
    whole("VIEW_NORMAL", View::normal),
    whole("VIEW_DEPTH", View::depth),
    whole("VIEW_SHADOW", View::shadow),
    whole("GLASS_OPAQUE", GlassLayer::opaque),
    whole("GLASS_THROUGH", GlassLayer::through),
    whole("GLASS_REFLECTING", GlassLayer::reflecting),
    // Materials
    whole("ALBEDO_TABLE_SIZE", shading::albedo_table_size),
    {"MIN_ALPHA", shading::min_alpha},
    {"F90_PER_F0", shading::f90_per_f0},
    // Cones through voxels
    whole("VOXEL_LEVELS", methods::vct::VoxelGrid::most_levels),
    whole("LOBE_STEPS", lobe_steps),
    whole("CAP_CONES", methods::vct::cap_cone_count),
    {"ONE_CONE_COSINE", static_cast<float>(methods::vct::one_cone_cosine)},
    // Virtual lights
    whole("SPHERE_RINGS", methods::vpl::sphere_rings),
    whole("SPHERE_SPOKES", methods::vpl::sphere_spokes),
    {"SPHERE_FAR2", methods::vpl::sphere_far2},
    {"SHARPEST_LOBE", methods::vpl::sharpest_lobe},
    {"LEAST_OF_LOBE", methods::vpl::least_of_lobe},
};

std::string line(const ShaderConstant& c) {
  return c.whole ? fmt::format("#define {} {:.0f}\n", c.name, c.value)
                 : fmt::format("#define {} {:#}\n", c.name, c.value);
}

}  // namespace

const std::string& shader_constants() {
  static const std::string lines = [] {
    std::string all;
    for (const ShaderConstant& c : constants) all += line(c);
    for (const ShaderConstant& c : probes::constants_of_shaders) all += line(c);
    return all;
  }();
  return lines;
}

}  // namespace ssphh::realtime
