#pragma once
/// Fields of jobs and results (fields.h), and examples in which every number is another.

#include <numeric>

#include <ssphh/farm/job.h>

#include "bake_fields.h"
#include "render_fields.h"

namespace ssphh::test {

void fields(auto& visit, farm::SceneRef& s) {
  auto& [package, manifest_bytes, light, time] = s;
  visit("package", package), visit("manifest_bytes", manifest_bytes), visit("light", light);
  visit("time", time);
}
void fields(auto& visit, farm::ProbeSphere& p) {
  auto& [position, radius] = p;
  visit("position", position), visit("radius", radius);
}
void fields(auto& visit, farm::ProbeJob& j) {
  auto& [scene, renderer, stage, degree, face_size, path, viz_params, probes, places] = j;
  visit("scene", scene), visit("renderer", renderer), visit("stage", stage), visit("degree", degree),
      visit("face_size", face_size);
  visit("path", path), visit("viz_params", viz_params), visit("probes", probes), visit("places", places);
}
void fields(auto& visit, probes::LookupSpec& l) {
  auto& [method, weights, layer] = l;
  visit("method", method), visit("weights", weights), visit("layer", layer);
}
void fields(auto& visit, farm::ProbeLighting& l) {
  auto& [probes, bytes, lookup] = l;
  visit("probes", probes), visit("bytes", bytes), visit("lookup", lookup);
}
void fields(auto& visit, farm::TileJob& j) {
  auto& [scene, params, tiles, layers, lighting] = j;
  visit("scene", scene), visit("params", params), visit("tiles", tiles), visit("layers", layers);
  visit("lighting", lighting);
}
void fields(auto& visit, farm::ProbeJobResult& r) {
  auto& [stage, degree, probes] = r;
  visit("stage", stage), visit("degree", degree), visit("probes", probes);
}
void fields(auto& visit, farm::TileResult& r) {
  auto& [tile, state] = r;
  visit("tile", tile), visit("state", state);
}
void fields(auto& visit, farm::TileJobResult& r) {
  auto& [tiles] = r;
  visit("tiles", tiles);
}
void fields(auto& visit, farm::JobStats& s) {
  auto& [seconds, rays, worker] = s;
  visit("seconds", seconds), visit("rays", rays), visit("worker", worker);
}

}  // namespace ssphh::test

namespace ssphh::farm::test {

inline SceneRef some_scene() {
  return {{0x0123456789abcdef, 0xfedcba9876543210},
          (std::uint64_t{1} << 39) + 7,
          {0x1111222233334444, 0x5555666677778888},
          0.1f};
}

inline ProbeJob some_probe_job(bake::BakeStage stage) {
  ProbeJob job;
  job.scene = some_scene();
  job.stage = stage;
  job.degree = 7;
  job.face_size = 12;
  job.path = {5, 2, 3, 0x9abcdef012345678};
  job.viz_params = {true, 4, 1.0f / 3, probes::VizSource::radiance, rays::PathSet::diffuse};
  job.probes = {0, 1, 2};
  job.places = {{{0.1f, 0.2f, 0.3f}, 0.4f}, {{0.5f, 0.6f, 0.7f}, 0.8f}, {{0.9f, 1.1f, 1.2f}, 1.3f}};
  return job;
}

inline TileJob some_tile_job() {
  TileJob job;
  job.scene = some_scene();
  job.params.width = 70, job.params.height = 41;
  for (int i = 0; i < 16; ++i) job.params.camera.world[i / 4][i % 4] = 0.1f * static_cast<float>(i + 1);
  job.params.camera.camera.orthographic = true;
  job.params.camera.camera.yfov = 0.9f, job.params.camera.camera.yheight = 1.7f;
  job.params.projection = trace::Projection::cube_strip;
  job.params.path = {6, 3, 2, 0x89abcdef01234567};
  job.params.per_group = true;
  job.tiles = {{1, 2, 3, 4}, {32, 8, 31, 30}};
  job.layers = {trace::RenderLayer::direct, trace::RenderLayer::normal, trace::RenderLayer::groups};
  job.lighting = {{0x2468ace013579bdf, 0x0f1e2d3c4b5a6978},
                  12345,
                  {probes::LookupMethod::light, probes::WeightMethod::mls, probes::ProbeLayer::self}};
  return job;
}

}  // namespace ssphh::farm::test
