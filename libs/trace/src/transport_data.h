#pragma once
/// What a TransportScene holds, shared by the files that implement it and by the DirectLights it made.

#include <ssphh/shading/lights.h>
#include <ssphh/trace/transport_scene.h>

#include "embree_scene.h"
#include "shared_count.h"

namespace ssphh::trace {

struct TransportPart {
  int node = -1;  ///< whose frame it is; −1: world
  std::string name;
  std::vector<int> instances;
  scene::Bounds bounds;
  std::unique_ptr<EmbreeScene> embree;
};

struct TransportData {
  TransportData(const scene::Scene& scene, const TransportOptions& options);

  /// World matrix of every node below which a part hangs or that never moves, parts posed by `poses`.
  std::vector<mat4> node_matrices(std::span<const mat4> poses) const;
  const TransportPart& part(int index) const;

  const scene::Scene& scene;
  TransportOptions options;
  std::vector<TransportPart> parts;  ///< the first never moves
  std::vector<int> node_part;        ///< part whose frame holds the node
  std::vector<mat4> node_frame;      ///< node to that frame
  std::vector<std::string> light_names;
  std::vector<int> light_group;
  shading::LightSet lights;  ///< at time 0
  float gap = 0;             ///< height above given points from which shadow rays start [m]
  mutable SharedCount rays;
};

struct TransportScene::Data : TransportData {
  using TransportData::TransportData;
};

}  // namespace ssphh::trace
