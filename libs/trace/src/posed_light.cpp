#include "posed_light.h"

#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>

#include "mirror_images.h"
#include "pane_mirrors.h"
#include "sample_sky.h"
#include "surface_gap.h"
#include "sweep.h"

namespace ssphh::trace {
namespace {

constexpr std::size_t many_points = 256, points_at_once = 32;

std::vector<mat4> node_matrices(const TransportData& data, std::span<const mat4> poses) {
  std::vector<mat4> world;
  data.layout().node_matrices(poses, world);
  return world;
}

}  // namespace

PosedLight::PosedLight(std::shared_ptr<const TransportData> data, std::span<const scene::LightState> lights,
                       std::span<const mat4> poses, const scene::EnvironmentState& environment)
    : data_(std::move(data)),
      world_(node_matrices(*data_, poses)),
      lights_(data_->lights, world_, lights, environment),
      geometry_(data_->geometry, poses) {
  list_emitters();
}

void PosedLight::pose(std::span<const scene::LightState> lights, std::span<const mat4> poses,
                      const scene::EnvironmentState& environment) {
  data_->layout().node_matrices(poses, world_);
  lights_.pose(data_->lights, world_, lights, environment);
  geometry_.pose(poses);
  list_emitters();
}

void PosedLight::list_emitters() {
  groups_.resize(lights_.groups().size());
  for (std::vector<GroupEmitter>& group : groups_) group.clear();
  for (int i = 0; i < lights_.emitter_count(); ++i) {
    const shading::Emitter emitter = lights_.emitter(i);
    groups_[emitter.group].push_back({i, emitter});
  }
}

const std::vector<PosedLight::GroupEmitter>& PosedLight::emitters_of(int group) const {
  require(group >= 0 && static_cast<std::size_t>(group) < groups_.size(), "light group",
          "there is none of that index");
  return groups_[group];
}

PosedLight::Receiver PosedLight::receiver(const rays::SurfacePoint& point) const {
  return {point.position, point.normal, above_surface(point.position, point.normal, data_->gap),
          position_seed(point.position)};
}

template <class Draw>
vec3 PosedLight::visible_share(const Receiver& at, std::uint64_t seed, float sine2, const Draw& draw,
                               RayTask& task) const {
  // A ratio of sums: less noise than the plain mean, and none where all or nothing is hidden. Few points lie
  // in a penumbra, and only they need all rays. In it, agreement of the first ones by chance makes light
  // places lighter and dark ones darker, as much on one side as on the other. Penumbrae of small lights are
  // narrow. Through the frame of a pane it would leave out light that many points see a little of.
  constexpr float small = 0.03f;  // 10° from the centre to the edge
  const int count = data_->options.light_samples, first = std::max(count / (sine2 < small ? 8 : 4), 1);
  vec3 seen(0);
  float all = 0;
  for (int s = 0; s < count; ++s) {
    if (!at.pane && s >= first && all > 0 && (seen == vec3(0) || seen == vec3(all))) break;
    const std::optional<shading::LightSample> sample =
        draw(SampleSequence(seed, static_cast<std::uint32_t>(s)).next2());
    if (!sample || !(sample->pdf > 0)) continue;
    const float weight = std::max(glm::dot(sample->wi, at.normal), 0.0f) / sample->pdf;
    all += weight;
    if (weight > 0) seen += weight * arriving_share(at, *sample, task);
  }
  return all > 0 ? seen / all : vec3(0);
}

vec3 PosedLight::sphere_irradiance(const GroupEmitter& light, const Receiver& at, std::uint64_t seed,
                                   float& sine2) const {
  const auto draw = [&](int s) {
    return lights_.sample_emitter(light.index, at.position,
                                  SampleSequence(seed, static_cast<std::uint32_t>(s)).next2());
  };
  const auto any = draw(0);
  if (!any || !(any->pdf > 0)) return vec3(0);
  // The cone's 1 − cos follows from its density, 1 / solid angle.
  const float below = 1 / (2 * pi * any->pdf);
  if (below < 1) sine2 = below * (2 - below);
  const vec3 way = 0.5f * (light.emitter.extent.min + light.emitter.extent.max) - at.position;
  const float cosine = glm::dot(way, at.normal) / glm::length(way);
  if (below < 1 && cosine * cosine >= sine2) return any->radiance * (pi * sine2 * std::max(cosine, 0.0f));
  // Partly below the horizon.
  const int count = data_->options.light_samples;
  float sum = 0;
  for (int s = 0; s < count; ++s) {
    const auto sample = draw(s);
    if (sample && sample->pdf > 0) sum += std::max(glm::dot(sample->wi, at.normal), 0.0f) / sample->pdf;
  }
  return any->radiance * (sum / static_cast<float>(count));
}

vec3 PosedLight::arriving_share(const Receiver& at, const shading::LightSample& sample, RayTask& task) const {
  if (!at.pane) return geometry_.transmittance(shadow_ray(at.start, at.position, sample), 0, task);
  shading::LightSample toward = sample;
  toward.wi = at.pane->mirrored_direction(sample.wi);
  return mirrored_share(geometry_, *at.pane, at.start, at.pane->mirrored(at.position), toward, 0, task);
}

vec3 PosedLight::irradiance_of(const GroupEmitter& light, const Receiver& at, std::uint64_t seed,
                               RayTask& task) const {
  if (light.emitter.kind == shading::EmitterKind::environment) return sky_irradiance(light, at, seed, task);
  // All of it below the horizon?
  const vec3 highest = farthest(light.emitter.extent, at.normal);
  if (!(glm::dot(light.emitter.distant() ? highest : highest - at.position, at.normal) > 0)) return vec3(0);

  if (const auto view = lights_.view_mesh(light.index, at.position, at.normal))
    return view->irradiance() * visible_share(
                                    at, seed, 1, [&](const vec2& u) { return view->sample(u); }, task);
  if (light.emitter.kind == shading::EmitterKind::sphere) {
    float sine2 = 1;
    const vec3 open = sphere_irradiance(light, at, seed, sine2);
    if (!(max_component(open) > 0)) return vec3(0);
    return open * visible_share(
                      at, seed, sine2,
                      [&](const vec2& u) { return lights_.sample_emitter(light.index, at.position, u); },
                      task);
  }

  const int count = light.emitter.delta() ? 1 : data_->options.light_samples;
  vec3 sum(0), brightest(0);
  for (int s = 0; s < count; ++s) {
    const vec2 u = SampleSequence(seed, static_cast<std::uint32_t>(s)).next2();
    const auto sample = lights_.sample_emitter(light.index, at.position, u);
    if (!sample || !(sample->pdf > 0)) continue;
    brightest = glm::max(brightest, sample->radiance);
    const float cosine = glm::dot(sample->wi, at.normal);
    if (cosine > 0 && max_component(sample->radiance) > 0)
      sum += arriving_share(at, *sample, task) * sample->radiance * (cosine / sample->pdf);
  }
  sum /= static_cast<float>(count);
  // Samples by area vary without bound near a mesh; irradiance does not.
  return light.emitter.kind == shading::EmitterKind::mesh ? glm::min(sum, pi * brightest) : sum;
}

vec3 PosedLight::sky_irradiance(const GroupEmitter& light, const Receiver& at, std::uint64_t seed,
                                RayTask& task) const {
  const int count = data_->options.environment_samples;
  vec3 sum(0);
  sample_sky(light, at, seed, count, task, [&](const vec3&, const vec3& irradiance) { sum += irradiance; });
  return sum / static_cast<float>(count);
}

void PosedLight::irradiance(int group, std::span<const rays::SurfacePoint> points,
                            std::span<vec3> out) const {
  require(points.size() == out.size(), "direct light", "there is not one value for each point");
  const std::vector<GroupEmitter>& emitters = emitters_of(group);
  const auto range = [&](std::size_t begin, std::size_t end) {
    RayTask task;
    for (std::size_t i = begin; i < end; ++i) {
      const Receiver at = receiver(points[i]);
      out[i] = vec3(0);
      for (std::size_t k = 0; k < emitters.size(); ++k)
        out[i] += irradiance_of(emitters[k], at, hash_combine(at.seed, k), task);
    }
    data_->rays.add(task.rays);
  };
  if (points.size() < many_points) {
    range(0, points.size());
  } else {
    parallel_for(points.size(), points_at_once, range);
  }
}

bool PosedLight::may_shadow(int group, const rays::SurfacePoint& point, const scene::Bounds& box) const {
  if (box.empty()) return false;
  const vec3 start = above_surface(point.position, point.normal, data_->gap);
  const float slack = glm::distance(start, point.position) + position_error(max_abs_component(start));
  const scene::Bounds body = grown(box, 2 * slack);
  // Nothing below the horizon shadows.
  if (!(glm::dot(farthest(body, point.normal) - point.position, point.normal) > 0)) return false;
  for (const auto& [index, emitter] : emitters_of(group)) {
    scene::Bounds way = emitter.extent;
    if (!emitter.distant()) way.min -= point.position, way.max -= point.position;
    if (!(glm::dot(farthest(way, point.normal), point.normal) > 0)) continue;
    const bool lights = !emitter.delta() || lights_.sample_emitter(index, point.position, vec2(0.5f));
    const float t_max = emitter.distant() ? std::numeric_limits<float>::infinity() : 1;
    if (lights && sweep_meets(point.position, way, t_max, body)) return true;
  }
  bool on_the_way = false;
  for_images(group, receiver(point), [&](const GroupEmitter& light, const Receiver& image, std::uint64_t) {
    scene::Bounds pane = image.pane->bounds, way = light.emitter.extent;
    pane.min -= point.position, pane.max -= point.position;
    const bool distant = light.emitter.distant();
    if (!distant) way.min -= image.position, way.max -= image.position;
    const float t_max = distant ? std::numeric_limits<float>::infinity() : 1;
    on_the_way = on_the_way || sweep_meets(point.position, pane, 1, body) ||
                 sweep_meets(image.position, way, t_max, body);
  });
  return on_the_way;
}

vec3 PosedLight::emitted(int group, const rays::RayQuery& ray, float distance) const {
  const float length = glm::length(ray.direction);
  const vec3 direction = ray.direction / length;
  vec3 sum(0);
  const auto add = [&](const shading::EmitterHit& hit) {
    if (hit.group == group) sum += hit.radiance;
  };
  lights_.intersect_lamps(ray.origin, direction, distance * length, add);
  if (std::isinf(distance)) lights_.escaped(direction, add);
  if (sum != vec3(0) && geometry_.filters()) {
    RayTask task;
    sum *= geometry_.transmittance({ray.origin, direction, distance * length * (1 - 1e-4f)}, 0, task);
    data_->rays.add(task.rays);
  }
  return sum;
}

}  // namespace ssphh::trace
