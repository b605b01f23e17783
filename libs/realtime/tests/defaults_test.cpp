/// What is asked for when nobody says otherwise, what stands in a value before anything is put into it, and
/// the numbers by which C++ and shaders find each other.

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include <ssphh/realtime/renderer.h>

#include "frame_images.h"
#include "gpu_types.h"
#include "method_types.h"
#include "shadow_maps.h"
#include "upload_count.h"
#include "virtual_light_maps.h"
#include "volume_layout.h"

namespace ssphh::realtime {
namespace {

TEST(RealtimeDefaults, OfRenderers) {
  const RendererParams params;
  EXPECT_EQ(params.light_map_size, 1024);
  EXPECT_EQ(params.area_map_size, 256);
  EXPECT_EQ(params.sun_map_size, 2048);
  EXPECT_EQ(params.sun_map_bytes, std::size_t{192} << 20);
  EXPECT_EQ(params.environment_map_size, 1024);
  EXPECT_EQ(params.probe_map_bytes, std::size_t{64} << 20);
  EXPECT_EQ(params.voxel_bytes, std::size_t{2} << 30);
  EXPECT_EQ(params.virtual_light_map_bytes, std::size_t{256} << 20);
  EXPECT_EQ(params.area_samples, 16);
  EXPECT_EQ(params.sun_samples, 7);
  EXPECT_EQ(params.environment_samples, 32);
  EXPECT_EQ(params.maps_per_frame, 1 << 30);
  const Target target;
  EXPECT_EQ(target.width, 1280);
  EXPECT_EQ(target.height, 720);
  EXPECT_EQ(target.framebuffer, Target::none);
  EXPECT_EQ(target.x, 0);
  EXPECT_EQ(target.y, 0);
}

TEST(RealtimeDefaults, OfFrames) {
  const FrameSettings settings;
  EXPECT_TRUE(settings.direct && settings.indirect);
  EXPECT_EQ(settings.lookup, probes::LookupMethod::irradiance);
  EXPECT_EQ(settings.weights, probes::WeightMethod::surface);
  EXPECT_EQ(settings.indirect_scale, 1);
  EXPECT_EQ(settings.indirect_tolerance, 0.1f);
  EXPECT_EQ(settings.supersample, 1);
  EXPECT_FALSE(settings.ambient_occlusion);
  EXPECT_EQ(settings.occlusion_radius, 0.5f);
  EXPECT_EQ(settings.view, View::lit);
  EXPECT_EQ(settings.sky, Sky::environment);
  EXPECT_FALSE(settings.wireframe);
}

TEST(RealtimeDefaults, CountsBeginAtNothing) {
  const FrameStats stats;
  EXPECT_EQ(stats.cpu_ms, 0);
  EXPECT_EQ(stats.draw_calls + stats.triangles + stats.bytes_uploaded, 0u);
  EXPECT_EQ(stats.shadow_maps_drawn, 0);
  EXPECT_EQ(stats.shadow_maps_waiting, 0);
  const FrameCounters counters;
  EXPECT_EQ(counters.draw_calls + counters.triangles + counters.bytes_uploaded, 0u);
  const MapView view;
  for (const vec3& v : {view.origin, view.right, view.up, view.forward}) EXPECT_EQ(v, vec3(0));
  EXPECT_EQ(view.near_plane, 0) << "parallel";
}

TEST(GpuValues, BeginAtNothing) {
  const GpuTextureUse use;
  EXPECT_EQ(use.matrix, vec4(1, 0, 0, 1));
  EXPECT_EQ(use.offset, vec4(0));
  EXPECT_EQ(GpuInstance().emission_scale, vec4(1, 1, 1, 0));
  const GpuAreaSample sample;
  for (const vec4& v : {sample.place, sample.normal, sample.light}) EXPECT_EQ(v, vec4(0));
  const auto emitter = std::make_unique<GpuEmitter>();
  for (const vec4& v : {emitter->place, emitter->light, emitter->cone, emitter->more, emitter->corners[0]})
    EXPECT_EQ(v, vec4(0));
  EXPECT_EQ(emitter->items, ivec4(0));
  EXPECT_EQ(emitter->count, ivec4(0));
  const GpuSunMap map;
  for (const vec4& v : {map.origin, map.right, map.up, map.forward}) EXPECT_EQ(v, vec4(0));
  const GpuVertex vertex;
  EXPECT_EQ(vertex.normal, vec3(0));
  EXPECT_EQ(vertex.uv, vec4(0));
  EXPECT_EQ(vertex.tangent, vec4(0));
  EXPECT_EQ(vertex.color, vec4(1));
  EXPECT_EQ(empty_list, ListHead(0, 1, 1, 0)) << "no group of one by one, and no pixel";
}

// What one pass reads together stands in units of its own.
TEST(GpuValues, PassesFindTheirTexturesInUnitsOfTheirOwn) {
  const auto expect_apart = [](std::vector<unsigned> units) {
    std::ranges::sort(units);
    EXPECT_EQ(std::ranges::adjacent_find(units), units.end());
    EXPECT_LT(units.back(), unit::count);
  };
  using namespace unit;
  expect_apart({gbuffer0, gbuffer1, occlusion, albedo_table, light_maps, area_maps, parallel_maps, probe_maps,
                fitted_ranges, fitted_lists, fitted_light, irradiance_tiles, radiance_tiles, probe_cells,
                depth_bounds});
  expect_apart({gbuffer0, gbuffer1, albedo_table, light_maps, area_maps, parallel_maps, environment_tiles,
                environment, depth_bounds, shadow_image});
  expect_apart({gbuffer0, gbuffer1, occlusion, irradiance, glossy, cells});
  expect_apart({gbuffer1, albedo_table, exits, behind_glass, base_texture, rough_texture, emission_texture,
                normal_texture, transmission_texture});
}

}  // namespace
}  // namespace ssphh::realtime
