#pragma once
/// What a SceneGeometry holds.

#include <map>

#include <embree3/rtcore.h>

#include <ssphh/trace/scene_geometry.h>

#include "scene_parts.h"
#include "triangle_records.h"

namespace ssphh::trace {

struct ReleaseEmbree {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseEmbree>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseEmbree>;

/// An instance in the frame of its part. What is shared holds neither vertices nor records.
struct InstanceGeometry {
  const scene::Mesh* mesh = nullptr;
  bool shared = false;
  bool filtered = false;  ///< rays ask whether it lets them pass
  mat4 to_frame{1};
  mat3 normal_matrix{1};
  std::vector<vec3> vertices;
  TriangleRecords records;
};

struct SceneGeometry::Data {
  Data(const scene::Scene& scene_in, std::uint64_t flatten_limit);

  /// Whether the other scene has the same surfaces at the same places of the same parts, and materials that
  /// ask nothing of them which the structures cannot answer.
  bool fits(const scene::Scene& other) const;

  const scene::Scene& scene;
  SceneParts layout;
  std::vector<InstanceGeometry> instances;
  bool filters = false;  ///< some instance is filtered
  EmbreeDevice device;
  std::vector<EmbreeScene> parts;  ///< geometry ids are the instances' indices

 private:
  struct SharedMesh {
    std::vector<vec3> positions;  ///< padded
    EmbreeScene scene;
  };
  void add_flat(std::size_t instance);
  void add_shared(std::size_t instance);
  void build(std::uint64_t flatten_limit);
  void check(const char* what) const;

  std::map<int, SharedMesh> shared_meshes_;
};

/// Lets a candidate hit pass: by chance where coverage is partial, or glass (shaded_geometry.cpp).
void passage_filter(const RTCFilterFunctionNArguments* arguments);

}  // namespace ssphh::trace
