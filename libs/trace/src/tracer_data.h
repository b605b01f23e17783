#pragma once
/// What a PathTracer holds, shared by the files that implement it.

#include <atomic>
#include <mutex>
#include <span>

#include <ssphh/trace/path_tracer.h>

#include "posed_geometry.h"
#include "scene_emitters.h"
#include "shared_count.h"

namespace ssphh::trace {

struct TracerData {
  TracerData(SharedGeometry geometry, std::shared_ptr<const scene::Scene> scene_in, float time_in);
  /// Of a scene that somebody else keeps.
  TracerData(SharedGeometry geometry_in, const scene::Scene& scene_in, float time_in)
      : TracerData(std::move(geometry_in),
                   std::shared_ptr<const scene::Scene>(std::shared_ptr<void>(), &scene_in), time_in) {}

  std::shared_ptr<const scene::Scene> kept;
  const scene::Scene& scene;
  float time;
  std::vector<mat4> world;
  shading::LightSet lights;
  ShadedGeometry shaded;
  PosedGeometry geometry;
  PaneMirrors mirrors;
  std::vector<int> looked_up;  ///< light groups whose direct light counts as indirect at given points
  mutable SharedCount rays;
  mutable std::once_flag hash_once;
  mutable Hash128 hash;

  SceneEmitters emitters() const { return SceneEmitters(lights); }
  const PaneMirrors* panes() const { return mirrors.any() ? &mirrors : nullptr; }
  std::size_t group_count() const { return lights.groups().size(); }
  const Hash128& scene_hash() const;
};

struct PathTracer::Data : TracerData {
  using TracerData::TracerData;
};

/// Books a task's rays and, while a recording is set, keeps them under `task_id`.
class TaskScope {
 public:
  TaskScope(const TracerData& data, std::atomic<std::uint64_t>& invalid, std::uint64_t task_id);
  ~TaskScope();
  TaskScope(const TaskScope&) = delete;
  TaskScope& operator=(const TaskScope&) = delete;

  RayTask task;

 private:
  const TracerData& data_;
  std::atomic<std::uint64_t>& invalid_;
  std::uint64_t task_id_;
  std::vector<RecordedRay> recorded_;
};

/// Of those names that there are.
std::vector<int> group_indices(const std::vector<std::string>& groups, std::span<const std::string> names);

/// Warns when contributions were left out because they were not numbers.
void report_invalid(std::uint64_t invalid);

/// Throw Error for sizes and efforts that make no sense or do not fit into memory.
void check_path_params(const rays::PathParams& params);
void check_image_memory(const std::string& where, std::uint64_t pixels, std::uint64_t floats_per_pixel);

}  // namespace ssphh::trace
