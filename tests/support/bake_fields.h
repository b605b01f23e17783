#pragma once
/// Fields of a bake and of what one unit of it gives (fields.h).

#include <ssphh/bake/bake.h>

#include "path_fields.h"

namespace ssphh::test {

void fields(auto& visit, bake::VizParams& p) {
  auto& [matrix, neighbors, threshold, source, paths] = p;
  visit("matrix", matrix), visit("neighbors", neighbors), visit("threshold", threshold);
  visit("source", source), visit("paths", paths);
}
void fields(auto& visit, bake::BakeParams& p) {
  auto& [gen, path, face_size, keep_light, viz, viz_params, viz_path, only, only_groups] = p;
  visit("gen", gen), visit("path", path), visit("face_size", face_size), visit("keep_light", keep_light);
  visit("viz", viz), visit("viz_params", viz_params), visit("viz_path", viz_path), visit("only", only);
  visit("only_groups", only_groups);
}
void fields(auto& visit, probes::GeneratorInfo& g) {
  auto& [op, viz, viz_source, gen, max_depth, passes, spp, viz_paths, viz_max_depth, viz_passes, viz_spp,
         face_size, seed, directions, surfel_size, link_rays, scene, scene_hash, time] = g;
  visit("op", op), visit("viz", viz), visit("viz_source", viz_source), visit("gen", gen);
  visit("max_depth", max_depth), visit("passes", passes), visit("spp", spp), visit("viz_paths", viz_paths);
  visit("viz_max_depth", viz_max_depth), visit("viz_passes", viz_passes), visit("viz_spp", viz_spp);
  visit("face_size", face_size), visit("seed", seed);
  visit("directions", directions), visit("surfel_size", surfel_size), visit("link_rays", link_rays);
  visit("scene", scene), visit("scene_hash", scene_hash), visit("time", time);
}
void fields(auto& visit, bake::ProbeStage& s) {
  auto& [stage, probe] = s;
  visit("stage", stage), visit("probe", probe);
}
void fields(auto& visit, sh::RadianceSh& s) {
  auto& [values] = s;
  visit("values", values);
}
void fields(auto& visit, sh::TransferMatrix& m) {
  auto& [arriving_degree, emitted_degree, values] = m;
  visit("arriving_degree", arriving_degree), visit("emitted_degree", emitted_degree);
  visit("values", values);
}
void fields(auto& visit, probes::GroupLight& l) {
  auto& [emitted, reflected] = l;
  visit("emitted", emitted), visit("reflected", reflected);
}
void fields(auto& visit, probes::Edge& e) {
  auto& [from, transfer, h, matrix] = e;
  visit("from", from), visit("transfer", transfer), visit("h", h), visit("matrix", matrix);
}
void fields(auto& visit, bake::ProbeStageResult& r) {
  auto& [done, seconds, rays, groups, edges] = r;
  visit("done", done), visit("seconds", seconds), visit("rays", rays), visit("groups", groups);
  visit("edges", edges);
}

}  // namespace ssphh::test
