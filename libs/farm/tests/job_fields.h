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
void fields(auto& visit, transport::TransportParams& p) {
  auto& [directions, surfel_size, link_rays, samples, surfels_per_radius, most_surfels, grow] = p;
  visit("directions", directions), visit("surfel_size", surfel_size), visit("link_rays", link_rays);
  visit("samples", samples), visit("surfels_per_radius", surfels_per_radius);
  visit("most_surfels", most_surfels), visit("grow", grow);
}
void fields(auto& visit, transport::SolveParams& p) {
  auto& [tolerance, max_iterations, settle] = p;
  visit("tolerance", tolerance), visit("max_iterations", max_iterations), visit("settle", settle);
}
void fields(auto& visit, transport::LinkVizParams& p) {
  auto& [neighbors, threshold, source, solve] = p;
  visit("neighbors", neighbors), visit("threshold", threshold), visit("source", source);
  visit("solve", solve);
}
void fields(auto& visit, probes::TileBox& b) {
  auto& [min, max] = b;
  visit("min", min), visit("max", max);
}
void fields(auto& visit, transport::GatherParams& p) {
  auto& [points, rays, poses, baked, within] = p;
  visit("points", points), visit("rays", rays), visit("poses", poses), visit("baked", baked);
  visit("within", within);
}
/// But for what stays at home.
void fields(auto& visit, bake::TransportBakeParams& p) {
  auto& [op, bounce, transport, solve, viz, viz_params, records, fit, fit_params, own_probes] = p;
  visit("transport", transport), visit("solve", solve), visit("viz", viz), visit("viz_params", viz_params);
  visit("records", records), visit("own_probes", own_probes);
}
void fields(auto& visit, farm::TransportJob& j) {
  auto& [scene, degree, light_known, params, places] = j;
  visit("scene", scene), visit("degree", degree), visit("light_known", light_known);
  visit("params", params), visit("places", places);
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

inline TransportJob some_transport_job() {
  TransportJob job;
  job.scene = some_scene();
  job.degree = 3;
  job.light_known = true;
  bake::TransportBakeParams& p = job.params;
  p.transport = {111, 0.3f, 55, 7, 21.5f, 4321, true};
  p.solve = {0.02f, 99, false};
  p.viz = true;
  p.viz_params = {5, 1.0f / 7, probes::VizSource::radiance, {0.05f, 33, true}};
  p.records = {77, 88, 3, {0, 2}, {{1.5f, -1e30f, 0.1f}, {2.5f, 3, 4}}};
  p.own_probes = 2;
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
