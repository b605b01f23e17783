#include <algorithm>
#include <cmath>

#include <ssphh/core/log.h>
#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>
#include <ssphh/trace/path_tracer.h>

#include "tracer_data.h"

namespace ssphh::trace {
namespace {

std::atomic<RayRecording*> ray_recording{nullptr};

}  // namespace

void set_ray_recording(RayRecording* recording) {
  ray_recording = recording;
}

TracerData::TracerData(SharedGeometry geometry_in, std::shared_ptr<const scene::Scene> scene_in,
                       float time_in)
    : kept(std::move(scene_in)),
      scene(*kept),
      time(time_in),
      world(scene::world_matrices(scene, time_in)),
      lights(scene, world, time),
      shaded(std::move(geometry_in), scene),
      geometry(shaded, shaded.layout().poses(scene, time_in)),
      mirrors(find_panes(shaded), scene) {}

const Hash128& TracerData::scene_hash() const {
  std::call_once(hash_once, [this] { hash = scene::scene_hash(scene); });
  return hash;
}

TaskScope::TaskScope(const TracerData& data, std::atomic<std::uint64_t>& invalid, std::uint64_t task_id)
    : data_(data), invalid_(invalid), task_id_(task_id) {
  if (ray_recording.load(std::memory_order_relaxed)) task.record = &recorded_;
}

TaskScope::~TaskScope() {
  data_.rays.add(task.rays);
  if (task.invalid) invalid_.fetch_add(task.invalid, std::memory_order_relaxed);
  if (RayRecording* recording = ray_recording.load(std::memory_order_relaxed); recording && task.record) {
    recording->add(task_id_, std::move(recorded_));
  }
}

std::vector<int> group_indices(const std::vector<std::string>& groups, std::span<const std::string> names) {
  std::vector<int> indices;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (std::ranges::find(names, groups[g]) != names.end()) indices.push_back(static_cast<int>(g));
  }
  return indices;
}

void report_invalid(std::uint64_t invalid) {
  if (invalid) log_warning("path tracer: {} contributions were not finite and were left out", invalid);
}

void check_path_params(const rays::PathParams& params) {
  if (params.max_depth < 0) throw Error("max depth", "it must not be negative");
  if (params.passes < 0) throw Error("passes", "their number must not be negative");
  if (params.spp < 1) throw Error("spp", "at least one sample is needed");
  if (static_cast<std::uint64_t>(params.passes) * static_cast<std::uint64_t>(params.spp) > UINT32_MAX) {
    throw Error("passes", "more than 2^32 samples per pixel");
  }
}

void check_image_memory(const std::string& where, std::uint64_t pixels, std::uint64_t floats_per_pixel) {
  constexpr std::uint64_t limit = std::uint64_t{8} << 30;
  if (pixels > limit / (sizeof(float) * floats_per_pixel)) {
    throw Error(where, "the images would need more than 8 GiB", "ask for fewer pixels or light groups");
  }
}

PathTracer::PathTracer(SharedGeometry geometry, std::shared_ptr<const scene::Scene> scene, float time) {
  require(scene != nullptr, "path tracer", "there is no scene");
  if (!std::isfinite(time)) throw Error("time", "it must be a finite number of seconds");
  scene::check_indices(*scene);
  data_ = std::make_unique<Data>(std::move(geometry), std::move(scene), time);
}

PathTracer::PathTracer(SharedGeometry geometry, const scene::Scene& scene, float time)
    : PathTracer(std::move(geometry), std::shared_ptr<const scene::Scene>(std::shared_ptr<void>(), &scene),
                 time) {}

PathTracer::PathTracer(const scene::Scene& scene, float time)
    : PathTracer(std::make_shared<const SceneGeometry>(scene), scene, time) {}

PathTracer::~PathTracer() = default;
PathTracer::PathTracer(PathTracer&&) noexcept = default;
PathTracer& PathTracer::operator=(PathTracer&&) noexcept = default;

const std::vector<std::string>& PathTracer::light_groups() const {
  return data_->lights.groups();
}

void PathTracer::count_as_indirect(std::span<const std::string> groups) {
  data_->looked_up = group_indices(light_groups(), groups);
}

std::uint64_t PathTracer::rays_traced() const {
  return data_->rays.total();
}

namespace {

bool nothing_between(const TracerData& data, const vec3& a, const vec3& b, PassedGlass glass) {
  // Shorten both ends, which may lie on surfaces, by more than their rounding error.
  const vec3 d = b - a;
  const float length = glm::length(d);
  const float error = position_error(std::max(max_abs_component(a), max_abs_component(b)));
  const float gap = 1e-4f * length + 2 * error;
  if (!(length > 2 * gap)) return true;
  const vec3 direction = d / length;
  RayTask task;
  const Ray way{a + gap * direction, direction, length - 2 * gap};
  const bool blocked = data.geometry.occluded(way, {0, glass}, task);
  data.rays.add(task.rays);
  return !blocked;
}

}  // namespace

bool PathTracer::visible(const vec3& a, const vec3& b) const {
  return nothing_between(*data_, a, b, PassedGlass::all);
}

bool PathTracer::joined(const vec3& a, const vec3& b) const {
  return nothing_between(*data_, a, b, PassedGlass::none);
}

float PathTracer::backface_fraction(const vec3& position) const {
  constexpr int count = 128;
  int backs = 0;
  RayTask task;
  for (int i = 0; i < count; ++i) {
    const Ray ray{position, spherical_fibonacci(i, count)};
    Hit hit;
    if (data_->geometry.intersect(ray, 0, task, hit) && data_->geometry.is_back(hit, ray.direction)) ++backs;
  }
  data_->rays.add(task.rays);
  return static_cast<float>(backs) / count;
}

}  // namespace ssphh::trace
