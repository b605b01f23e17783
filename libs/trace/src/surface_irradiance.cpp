/// Path traced irradiance at points that the caller gives: the truth for lookups.

#include <algorithm>

#include <ssphh/core/parallel.h>
#include <ssphh/core/sphere.h>

#include "surface_gap.h"
#include "tracer_data.h"

namespace ssphh::trace {
namespace {

constexpr std::size_t max_batches = 16;

/// Sums of one batch at one point.
class BatchSums {
 public:
  BatchSums(std::span<const int> looked_up, RayTask& task) : looked_up_(looked_up), task_(task) {}

  void add(int depth, int group, const vec3& value, const vec3& /*emission*/) {
    if (!is_finite(value)) {
      ++task_.invalid;
      return;
    }
    const bool is_direct = depth < 2 && std::ranges::find(looked_up_, group) == looked_up_.end();
    (is_direct ? direct : indirect) += scale * value;
  }
  void first_hit(const shading::Surface&, const vec3&, const Ray&, const Hit&) {}

  vec3 direct{0}, indirect{0};
  float scale = 1;  ///< of the values that follow

 private:
  std::span<const int> looked_up_;
  RayTask& task_;
};

/// One path from the point, as if it reflected all light evenly: a light sample and a cosine-distributed ray
/// that goes on.
void trace_from(const TracerData& data, const SceneEmitters& emitters, const rays::SurfacePoint& point,
                float gap, const PathSampler& sampler, const PathOptions& options, RayTask& task,
                BatchSums& sums) {
  const vec3 start = above_surface(point.position, point.normal, gap);
  PathVertex vertex{point.position, point.normal};
  SampleSequence random = sampler.camera();
  PathSampler::Vertex u{};
  u.light = random.next(), u.point = random.next2();
  const vec2 u_direction = random.next2();
  const int light_samples = emitters.sample_count(vertex);

  // Sample direct light.
  for (int i = 0; i < light_samples; ++i) {
    if (i > 0) u = sampler.light(i).vertex(0);
    const auto light = emitters.sample(i, vertex, u.light, u.point);
    const float cosine = light && light->pdf > 0 ? glm::dot(light->wi, point.normal) : 0;
    if (!(cosine > 0)) continue;
    const vec3 through = data.geometry.transmittance(shadow_ray(start, point.position, *light),
                                                     sampler.passage(data.geometry, 0, true), task);
    if (!(max_component(through) > 0)) continue;
    const float weight = light->delta ? 1 : shading::power_heuristic(light->pdf, cosine / pi);
    sums.scale = 1;
    sums.add(1, light->group, through * light->radiance * (cosine * weight / light->pdf), -light->wi);
  }
  for (int i = 0; options.panes && options.max_depth >= 2 && i < light_samples; ++i) {
    const PathSampler own = sampler.by_panes().light(i);
    const auto event =
        next_event_by_pane(data.geometry, emitters, i, *options.panes, vertex, start, own.vertex(0), false,
                           own.passage(data.geometry, 0, true), task, [&](const vec3& wi) {
                             const float cosine = std::max(glm::dot(wi, point.normal), 0.0f);
                             return shading::BsdfValue{vec3(cosine), cosine / pi};
                           });
    sums.scale = 1;
    if (event) sums.add(2, event->group, event->value, event->emission);
  }
  if (options.max_depth == 1 && !emitters.found_by_rays(vertex)) return;

  // Follow a scattered ray: ∫ L cos θ dω = π times the mean of L.
  const vec3 local = sample_cosine_hemisphere(u_direction);
  if (!(local.z > 0)) return;
  vertex.bsdf_pdf = local.z / pi;
  sums.scale = pi;
  trace_path(data.geometry, emitters, {start, Frame::around(point.normal).to_world(local)}, sampler, options,
             task, sums, &vertex);
}

struct BatchMean {
  vec3 direct{0}, indirect{0};
};

rays::IrradianceEstimate combine(std::span<const BatchMean> means, std::span<const float> weights) {
  rays::IrradianceEstimate estimate;
  for (std::size_t b = 0; b < means.size(); ++b) {
    estimate.direct += weights[b] * means[b].direct;
    estimate.indirect += weights[b] * means[b].indirect;
  }
  const auto count = static_cast<float>(means.size());
  if (means.size() < 2) {
    estimate.indirect_variance = vec3(std::numeric_limits<float>::infinity());
    return estimate;
  }
  for (std::size_t b = 0; b < means.size(); ++b) {
    const vec3 deviation = weights[b] * (means[b].indirect - estimate.indirect);
    estimate.indirect_variance += count / (count - 1) * deviation * deviation;
    estimate.indirect_covariance +=
        count / (count - 1) * deviation * vec3(deviation.y, deviation.z, deviation.x);
  }
  return estimate;
}

}  // namespace

std::vector<rays::IrradianceEstimate> PathTracer::surface_irradiance(
    std::span<const rays::SurfacePoint> points, const rays::PathParams& path, const Control& control) const {
  check_path_params(path);
  std::vector<rays::IrradianceEstimate> estimates(points.size());
  const std::uint64_t paths = static_cast<std::uint64_t>(path.spp) * static_cast<std::uint64_t>(path.passes);
  if (points.empty() || path.max_depth < 1 || paths == 0) return estimates;

  const auto batches = static_cast<std::size_t>(std::min<std::uint64_t>(max_batches, paths));
  const auto first_path = [&](std::size_t batch) { return batch * paths / batches; };
  std::vector<float> weights;
  for (std::size_t b = 0; b < batches; ++b) {
    weights.push_back(static_cast<float>(static_cast<double>(first_path(b + 1) - first_path(b)) /
                                         static_cast<double>(paths)));
  }
  const PathOptions options{.max_depth = path.max_depth, .panes = data_->panes()};
  const float gap = default_surface_tolerance * scene_size(scene::world_bounds(data_->scene, data_->world));

  std::vector<BatchMean> means(points.size() * batches);
  std::atomic<std::uint64_t> invalid{0};
  ProgressStage stage(control, "irradiance", points.size() * paths, "paths");
  parallel_for(
      means.size(), 1,
      [&](std::size_t task_id, std::size_t) {
        control.check();
        TaskScope scope(*data_, invalid, task_id);
        const SceneEmitters emitters = data_->emitters();
        BatchSums sums(data_->looked_up, scope.task);
        const std::size_t i = task_id / batches, batch = task_id % batches;
        const std::uint64_t seed =
            pixel_seed(path.seed, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(batch));
        const std::uint64_t count = first_path(batch + 1) - first_path(batch);
        for (std::uint32_t s = 0; s < count; ++s)
          trace_from(*data_, emitters, points[i], gap, {seed, s}, options, scope.task, sums);
        const float scale = 1 / static_cast<float>(count);
        means[task_id] = {sums.direct * scale, sums.indirect * scale};
        stage.advance(count);
      },
      control);
  report_invalid(invalid);
  for (std::size_t i = 0; i < points.size(); ++i)
    estimates[i] = combine(std::span(means).subspan(i * batches, batches), weights);
  return estimates;
}

}  // namespace ssphh::trace
