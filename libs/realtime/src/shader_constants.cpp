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
    whole("GLASS_EXITS", GlassLayer::exits),
    whole("GLASS_BENT", GlassLayer::bent),
    whole("GLASS_THROUGH", GlassLayer::through),
    whole("GLASS_FROSTED", GlassLayer::frosted),
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
    // Where uniform blocks and buffers are bound, and textures and images
    whole("BINDING_FRAME_BLOCK", binding::frame_block),
    whole("BINDING_DISTANT_BLOCK", binding::distant_block),
    whole("BINDING_EMITTER_BLOCK", binding::emitter_block),
    whole("BINDING_MATERIAL_BLOCK", binding::material_block),
    whole("BINDING_INSTANCE_BLOCK", binding::instance_block),
    whole("BINDING_LISTED_PIXELS", binding::listed_pixels),
    whole("BINDING_CONE_BLOCK", binding::cone_block),
    whole("BINDING_CONES", binding::cones),
    whole("BINDING_VIRTUAL_LIGHTS", binding::virtual_lights),
    whole("UNIT_GBUFFER0", unit::gbuffer0),
    whole("UNIT_GBUFFER1", unit::gbuffer1),
    whole("UNIT_ALBEDO_TABLE", unit::albedo_table),
    whole("UNIT_LIGHT_MAPS", unit::light_maps),
    whole("UNIT_AREA_MAPS", unit::area_maps),
    whole("UNIT_PARALLEL_MAPS", unit::parallel_maps),
    whole("UNIT_PROBE_MAPS", unit::probe_maps),
    whole("UNIT_BASE_TEXTURE", unit::base_texture),
    whole("UNIT_ROUGH_TEXTURE", unit::rough_texture),
    whole("UNIT_EMISSION_TEXTURE", unit::emission_texture),
    whole("UNIT_NORMAL_TEXTURE", unit::normal_texture),
    whole("UNIT_TRANSMISSION_TEXTURE", unit::transmission_texture),
    whole("UNIT_IRRADIANCE", unit::irradiance),
    whole("UNIT_GLOSSY", unit::glossy),
    whole("UNIT_CELLS", unit::cells),
    whole("UNIT_SHADOW_IMAGE", unit::shadow_image),
    whole("UNIT_OCCLUSION", unit::occlusion),
    whole("UNIT_EXITS", unit::exits),
    whole("UNIT_BEHIND_GLASS", unit::behind_glass),
    whole("UNIT_BEHIND_GBUFFER1", unit::behind_gbuffer1),
    whole("UNIT_LEFT_BY_GLASS", unit::left_by_glass),
    whole("UNIT_LIGHT_GLASS", unit::light_glass),
    whole("UNIT_AREA_GLASS", unit::area_glass),
    whole("UNIT_PARALLEL_GLASS", unit::parallel_glass),
    whole("UNIT_LAMP_PROFILES", unit::lamp_profiles),
    whole("UNIT_FITTED_RANGES", unit::fitted_ranges),
    whole("UNIT_FITTED_LISTS", unit::fitted_lists),
    whole("UNIT_FITTED_LIGHT", unit::fitted_light),
    whole("UNIT_FITTED_POINTS", unit::fitted_points),
    whole("UNIT_IRRADIANCE_TILES", unit::irradiance_tiles),
    whole("UNIT_RADIANCE_TILES", unit::radiance_tiles),
    whole("UNIT_ENVIRONMENT", unit::environment),
    whole("UNIT_ENVIRONMENT_TILES", unit::environment_tiles),
    whole("UNIT_PROBE_CELLS", unit::probe_cells),
    whole("UNIT_DEPTH_BOUNDS", unit::depth_bounds),
    whole("UNIT_COLOR_IMAGE", unit::color_image),
    whole("UNIT_GBUFFER0_IMAGE", unit::gbuffer0_image),
    whole("UNIT_GBUFFER1_IMAGE", unit::gbuffer1_image),
    whole("UNIT_PICTURE", unit::picture),
    whole("UNIT_TAKEN", unit::taken),
    whole("UNIT_VOXELS", unit::voxels),
    whole("UNIT_VIRTUAL_LIGHT_MAPS", unit::virtual_light_maps),
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
