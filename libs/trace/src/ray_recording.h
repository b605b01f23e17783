#pragma once
/// Keeps the rays of a render, so that a benchmark can replay them through bare Embree.

#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::trace {

struct RecordedRay {
  vec3 origin;
  float t_max;
  vec3 direction;
  bool occlusion;  ///< any hit wanted, else the nearest
};

/// Rays in the order in which each task traced them, tasks (image rows) in order.
class RayRecording {
 public:
  void add(std::uint64_t task, std::vector<RecordedRay> rays) {
    const std::lock_guard lock(mutex_);
    tasks_[task] = std::move(rays);
  }
  const std::map<std::uint64_t, std::vector<RecordedRay>>& tasks() const { return tasks_; }

 private:
  std::mutex mutex_;
  std::map<std::uint64_t, std::vector<RecordedRay>> tasks_;
};

/// While set, every render() and cube request of this process records into `recording` (null: off). Not for
/// use while work runs.
void set_ray_recording(RayRecording* recording);

}  // namespace ssphh::trace
