#pragma once
/// What a TransportScene holds, shared by the files that implement it and by the DirectLights it made.

#include <ssphh/shading/lights.h>
#include <ssphh/trace/transport_scene.h>

#include "panes.h"
#include "posed_geometry.h"
#include "shared_count.h"

namespace ssphh::trace {

struct TransportData {
  TransportData(SharedGeometry geometry, const scene::Scene& scene, const TransportOptions& options);

  const SceneParts& layout() const { return geometry.layout(); }
  const ScenePart& part(int index) const { return layout().part(index); }

  const scene::Scene& scene;
  TransportOptions options;
  ShadedGeometry geometry;
  std::vector<std::string> light_names;
  std::vector<int> light_group;
  int environment_group = -1;
  shading::LightSet lights;  ///< at time 0
  std::vector<Pane> panes;
  float gap = 0;  ///< height above given points from which shadow rays start [m]
  mutable SharedCount rays;
};

struct TransportScene::Data : TransportData {
  using TransportData::TransportData;
};

}  // namespace ssphh::trace
