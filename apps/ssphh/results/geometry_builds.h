#pragma once

#include <ssphh/trace/scene_geometry.h>

namespace ssphh::app {

/// How many acceleration structures of scenes were built in this process since this was made: the
/// `geometry_builds` of a command's JSON.
class GeometryBuilds {
 public:
  std::uint64_t count() const { return trace::SceneGeometry::builds() - before_; }

 private:
  std::uint64_t before_ = trace::SceneGeometry::builds();
};

}  // namespace ssphh::app
