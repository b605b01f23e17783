#pragma once
/// Structures that shaders read, laid out as std140 and std430 ask; their twins stand in shaders/.

#include <cstddef>

#include <ssphh/core/math.h>

namespace ssphh::realtime {

using glm::ivec4;
using glm::uvec4;

/// FrameBlock of common.glsl.
struct FrameBlock {
  vec4 camera_position, camera_right, camera_up, camera_forward;
  ivec4 counts, switches, degrees, grid_size;
  vec4 grid_origin, tone, environment;
  ivec4 maps, map_tiles;
  vec4 map_near, extra;
};
static_assert(sizeof(FrameBlock) == 15 * 16);
static_assert(offsetof(FrameBlock, grid_origin) == 8 * 16 && offsetof(FrameBlock, extra) == 14 * 16);

/// TextureUse, Material, Instance of material.glsl.
struct GpuTextureUse {
  vec4 matrix{1, 0, 0, 1};
  vec4 offset{0};
};
struct GpuMaterial {
  vec4 base, emission, rough, alpha;
  GpuTextureUse base_use, rough_use, emission_use, normal_use;
};
static_assert(sizeof(GpuMaterial) == 12 * 16 && offsetof(GpuMaterial, normal_use) == 10 * 16);

struct GpuInstance {
  mat4 world;
  vec4 normal[3];
  uvec4 material;
};
static_assert(sizeof(GpuInstance) == 8 * 16 && offsetof(GpuInstance, material) == 7 * 16);

/// Emitter, AreaSample, SunMap of lights.glsl.
enum class EmitterKind : int { point, directional, sphere, mesh, environment, sphl };
struct GpuEmitter {
  vec4 place{0}, light{0}, cone{0}, more{0};
  ivec4 items{0}, count{0};
};
static_assert(sizeof(GpuEmitter) == 6 * 16 && offsetof(GpuEmitter, items) == 4 * 16);

struct GpuAreaSample {
  vec4 place{0}, normal{0}, light{0};
};
static_assert(sizeof(GpuAreaSample) == 3 * 16);

struct GpuSunMap {
  vec4 origin{0}, right{0}, up{0}, forward{0};
};
static_assert(sizeof(GpuSunMap) == 4 * 16);

/// DistantBlock of lights.glsl.
inline constexpr int max_parallel_maps = 128;
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

/// Where shaders expect what.
namespace binding {
inline constexpr unsigned materials = 0, instances = 1, group_scales = 2;
inline constexpr unsigned emitters = 3, area_samples = 4, emitter_corners = 5;
inline constexpr unsigned probe_places = 0, probe_irradiance = 1, probe_radiance = 2, probe_grid = 6,
                          probe_emission = 7;
inline constexpr unsigned frame_block = 0, distant_block = 1;
}  // namespace binding
namespace unit {
inline constexpr unsigned gbuffer0 = 0, gbuffer1 = 1, gbuffer_depth = 2, albedo_table = 3, light_maps = 4,
                          area_maps = 5, parallel_maps = 6, probe_maps = 7, glossy_bands = 12,
                          environment = 13, occlusion = 14;
inline constexpr unsigned base_texture = 8, rough_texture = 9, emission_texture = 10, normal_texture = 11;
inline constexpr unsigned emitted = 8, direct = 9, irradiance = 10, glossy = 11;
}  // namespace unit

}  // namespace ssphh::realtime
