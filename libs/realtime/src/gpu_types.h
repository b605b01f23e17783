#pragma once
/// Structures that shaders read, laid out as std140 and std430 ask; their twins stand in shaders/.

#include <array>
#include <cstddef>

#include <ssphh/core/math.h>

namespace ssphh::realtime {

/// Of a method's light: variants of method.glsl.
enum class MethodKind : int { cones, virtual_lights };
inline constexpr int method_kinds = 2;

using glm::ivec4;
using glm::uvec4;

/// FrameBlock of common.glsl.
struct FrameBlock {
  vec4 camera_position, camera_right, camera_up, camera_forward;
  ivec4 grid_size;
  vec4 grid_origin, tone, environment;
  ivec4 maps, map_tiles;
  vec4 map_near, extra, shift;
};
static_assert(sizeof(FrameBlock) == 13 * 16);
static_assert(offsetof(FrameBlock, grid_origin) == 5 * 16 && offsetof(FrameBlock, extra) == 11 * 16);

/// TextureUse, MaterialBlock, InstanceBlock of material.glsl; each stands where a uniform block may begin.
struct GpuTextureUse {
  vec4 matrix{1, 0, 0, 1};
  vec4 offset{0};
};
struct GpuMaterial {
  vec4 base, emission, rough, alpha, glass, inside;
  GpuTextureUse base_use, rough_use, emission_use, normal_use, transmission_use;
};
static_assert(sizeof(GpuMaterial) == 16 * 16 && offsetof(GpuMaterial, transmission_use) == 14 * 16);

struct GpuInstance {
  mat4 world;
  vec4 normal[3];
  vec4 emission_scale{1, 1, 1, 0};
  vec4 middle{0};
};
static_assert(sizeof(GpuInstance) == 9 * 16 && offsetof(GpuInstance, middle) == 8 * 16);
inline constexpr std::size_t block_stride = 256;
static_assert(sizeof(GpuMaterial) <= block_stride && sizeof(GpuInstance) <= block_stride);

/// AreaSample and EmitterBlock of lights.glsl.
/// A disc is a sun with an extent.
/// `lobe`: an SPHL of the scene that shines; `sphl`: a probe to which somebody gave light.
enum class EmitterKind : int { point, sphl, sun, disc, sphere, mesh, environment, lobe };
inline constexpr int emitter_kinds = 8;
struct GpuAreaSample {
  vec4 place{0}, normal{0}, light{0};
};
inline constexpr int max_area_samples = 64, max_corners = 121;
struct GpuEmitter {
  vec4 place{0}, light{0}, cone{0}, more{0};
  ivec4 items{0}, count{0};
  GpuAreaSample samples[max_area_samples];
  vec4 corners[max_corners] = {};
};
static_assert(offsetof(GpuEmitter, items) == 4 * 16 && offsetof(GpuEmitter, samples) == 6 * 16);
static_assert(offsetof(GpuEmitter, corners) == 6 * 16 + max_area_samples * 3 * 16);
/// Emitters stand in one buffer, each where a uniform block may begin.
inline constexpr std::size_t emitter_stride = 5120;
static_assert(sizeof(GpuEmitter) <= emitter_stride && emitter_stride % 256 == 0);

/// Shadow maps of a sun, each of a part of what the view sees; the last of the whole scene.
inline constexpr int sun_cascades = 6;

/// SunMap of lights.glsl.
struct GpuSunMap {
  vec4 origin{0}, right{0}, up{0}, forward{0};
};
static_assert(sizeof(GpuSunMap) == 4 * 16);

/// DistantBlock of lights.glsl.
inline constexpr int max_parallel_maps = 192;
struct DistantBlock {
  GpuSunMap maps[max_parallel_maps];
  vec4 environment_sh[25];
};
static_assert(offsetof(DistantBlock, environment_sh) == max_parallel_maps * sizeof(GpuSunMap));
static_assert(sizeof(DistantBlock) <= 16384, "what every driver offers for a uniform block");

/// Attributes other than the position.
struct GpuVertex {
  vec3 normal{0};
  vec4 uv{0};
  vec4 tangent{0};
  vec4 color{1};
};
static_assert(sizeof(GpuVertex) == 60);

/// Lists stand in textures as wide as this power of two.
inline constexpr int list_width_log2 = 11, list_width = 1 << list_width_log2;

/// Roughnesses of which a probe's radiance is kept; shaders interpolate.
inline constexpr std::array<float, 6> radiance_roughness = {0, 0.3f, 0.45f, 0.6f, 0.8f, 1};

/// What passes over glass draw: what is mostly no glass; where light leaves the nearest body; what that bends
/// of the picture behind it; what other glass leaves of the light; rough sheets, lit from behind; glass as a
/// surface that reflects.
enum class GlassLayer { opaque, exits, bent, through, frosted, reflecting };

/// Of what OpenGL keeps as halves.
inline constexpr float largest_half = 65504;

/// Where shaders expect what: they find it as BINDING_ and UNIT_ with the name (shader_constants.cpp).
namespace binding {
inline constexpr unsigned frame_block = 0, distant_block = 1, emitter_block = 2, material_block = 3,
                          instance_block = 4;
inline constexpr unsigned listed_pixels = 2;  // storage
}  // namespace binding
namespace unit {
/// Of images that shaders write.
inline constexpr unsigned color_image = 0, gbuffer0_image = 0, gbuffer1_image = 1;
/// Of a whole picture, and of the textures of another renderer's G-buffer, the first of six.
inline constexpr unsigned picture = 0, taken = 8;
inline constexpr unsigned gbuffer0 = 0, gbuffer1 = 1, albedo_table = 3, light_maps = 4, area_maps = 5,
                          parallel_maps = 6, probe_maps = 7;
inline constexpr unsigned base_texture = 8, rough_texture = 9, emission_texture = 10, normal_texture = 11,
                          transmission_texture = 12;
/// Of passes over glass: where light leaves bodies, the picture behind, how far away that is, and what glass
/// leaves of it.
inline constexpr unsigned exits = 2, behind_glass = 13, behind_gbuffer1 = 8, left_by_glass = 9;
inline constexpr unsigned irradiance = 8, glossy = 9, cells = 10, shadow_image = 8, occlusion = 2;
inline constexpr unsigned light_glass = 8, area_glass = 9, parallel_glass = 10, lamp_profiles = 11;
inline constexpr unsigned fitted_ranges = 8, fitted_lists = 9, fitted_light = 10, fitted_points = 11;
inline constexpr unsigned irradiance_tiles = 12, radiance_tiles = 13, environment = 13,
                          environment_tiles = 12, probe_cells = 14, depth_bounds = 15;
inline constexpr unsigned count = 16;
}  // namespace unit

/// Head of ListedPixels (std430): groups of a dispatch, and how many pixels follow.
using ListHead = uvec4;
inline constexpr ListHead empty_list{0, 1, 1, 0};

/// What the stencil tells of a pixel: how its surface reflects.
namespace surface_class {
inline constexpr int nothing = 0, lambertian = 1, full = 2, unlit = 3;
/// Beside the class: its indirect light is there.
inline constexpr int lit = 0x80;
}  // namespace surface_class

}  // namespace ssphh::realtime
