#include "lights.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/area_lamp.h>
#include <ssphh/scene/query.h>

namespace ssphh::realtime {
namespace {

constexpr int sphere_points = 8;
constexpr float black = 0;
}  // namespace

Lights::Lights(const scene::Scene& scene, float time, const std::vector<mat4>& world,
               const scene::Bounds& bounds, const RendererParams& params, const Lights* before)
    : bounds_of_scene_(bounds), near_(cube_near(bounds)), profiles_(scene.lights) {
  const std::vector<std::string> groups = scene::light_groups(scene);
  scales_.assign(groups.size(), vec3(1));
  groups_ = groups;
  add_lights(scene, time, world, groups, params);
  add_meshes(scene, world, groups, params);
  add_environment(scene, groups, std::clamp(params.environment_samples, 1, max_area_samples), before);
  if (sun_slots_ + sky_slots_ > max_parallel_maps)
    throw Error("real-time renderer", fmt::format("the lights need {} parallel shadow maps, {} is the most",
                                                  sun_slots_ + sky_slots_, max_parallel_maps));
  for (const GpuEmitter& e : emitters_) {
    if (e.items.x == static_cast<int>(EmitterKind::disc)) bounded_ = e.items.y + sun_cascades * e.items.z;
  }
  if (!before || !same_lamp_maps(*before))
    lamps_ = MapAtlas(params.light_map_size, std::max(6 * lamp_slots_, 1));
  if (!before || !same_area_maps(*before))
    areas_ = MapAtlas(params.area_map_size, std::max(6 * area_slots_, 1));
  if (!before || !same_sun_maps(*before)) {
    int size = params.sun_map_size;
    while (size > 1 && MapAtlas::bytes_of(size, sun_slots_) > params.sun_map_bytes) size /= 2;
    suns_ = MapAtlas(sun_slots_ > 0 ? size : 1, std::max(sun_slots_, 1));
    if (bounded_ > 0) bounds_.emplace(size, bounded_);
  }
  if (!before || !same_sky_maps(*before))
    skies_ = MapAtlas(sky_slots_ > 0 ? params.environment_map_size : 1, std::max(sky_slots_, 1));
  sun_key_.resize(static_cast<std::size_t>(sun_slots_));
  scene_emitters_ = static_cast<int>(emitters_.size());
  distant_buffer_ = gl::Buffer(sizeof(DistantBlock));
  if (!before) place_all(world);
}

void Lights::add_lights(const scene::Scene& scene, float time, const std::vector<mat4>& world,
                        const std::vector<std::string>& groups, const RendererParams& params) {
  const int most_parts = most_sun_parts(scene, params);
  for (const scene::Light& light : scene.lights) {
    lights_.push_back(light);
    states_.push_back({node_matrix(world, light.node), light.color, light.intensity,
                       scene::emission_at(light.emission, time)});
    Source source;
    source.emitter = static_cast<int>(emitters_.size());
    source.group = scene::light_group_index(groups, scene::light_group(light));
    source.light = static_cast<int>(lights_.size()) - 1;
    GpuEmitter e;
    if (light.type == scene::LightType::sphere && light.radius > 0) {
      source.points = ball_points(light.radius, sphere_points);
      e.items = ivec4(static_cast<int>(EmitterKind::sphere), 0, sphere_points, 0);
      e.more.z = 1;
      source.first_map = area_slots_;
      area_slots_ += sphere_points;
    } else if (scene::lamp_area(light) > 0) {
      shape_as_mesh(source, e, scene::area_lamp_mesh(light), mat4(1), true, params);
    } else if (light.type == scene::LightType::directional) {
      const bool disc = light.angular_radius > 0;
      source.parts = disc_parts(light.angular_radius, most_parts);
      const auto parts = static_cast<int>(source.parts.size());
      e.items = ivec4(static_cast<int>(disc ? EmitterKind::disc : EmitterKind::sun), sun_slots_, parts, 0);
      source.first_map = sun_slots_;
      sun_slots_ += sun_cascades * parts;
    } else {
      const bool lobe = light.type == scene::LightType::sphl;
      e.items = ivec4(static_cast<int>(lobe ? EmitterKind::lobe : EmitterKind::point), lamp_slots_, 1, 0);
      source.first_map = lamp_slots_++;
      e.count.y = profiles_.layer(light) + 1;
    }
    emitters_.push_back(e);
    sources_.push_back(std::move(source));
  }
}

void Lights::add_environment(const scene::Scene& scene, const std::vector<std::string>& groups, int samples,
                             const Lights* before) {
  if (!scene.environment) {
    same_sky_ = before && !before->environment_;
    return;
  }
  const scene::Environment& own = *scene.environment;
  same_sky_ = before && before->environment_ && before->environment_->color == own.color &&
              before->environment_->rotation == own.rotation &&
              before->own_environment_.width == own.equirect.width &&
              before->own_environment_.pixels == own.equirect.pixels;
  if (!same_sky_) environment_ = own, own_environment_ = own.equirect;
  environment_samples_ = samples;
  Source source;
  source.emitter = static_cast<int>(emitters_.size());
  source.group = scene::light_group_index(groups, scene::light_group(own));
  source.radiance = vec3(1);      // its colour is in the samples and the image
  source.first_map = sun_slots_;  // after those of all suns
  GpuEmitter e;
  e.items = ivec4(static_cast<int>(EmitterKind::environment), 0, 0, 0);
  sky_slots_ = samples;
  emitters_.push_back(e);
  sources_.push_back(std::move(source));
  if (!same_sky_) find_environment();
}

void Lights::set(const scene::LightingState& state, const std::vector<mat4>& world) {
  emitters_changed_ |= states_ != state.lights || scales_ != state.group_scales;
  states_ = state.lights;
  scales_ = state.group_scales;
  for (Source& source : sources_) {
    if (source.light >= 0) {
      place(source, states_[source.light].world);
    } else if (!source.points.empty()) {
      place(source, node_matrix(world, source.node));
    }
  }
  const bool other = other_image_ != state.environment_image;
  if (environment_ && (other || turn_ != state.environment_rotation)) {
    turn_ = state.environment_rotation;
    other_image_ = state.environment_image;
    if (other) environment_->equirect = other_image_ ? *other_image_ : own_environment_;
    other ? find_environment() : turn_environment();
    place_environment(environment_bounds_);
  }
}

void Lights::leave_out(const std::vector<std::string>& groups, const std::vector<std::string>& mirrored) {
  for (Source& source : sources_) {
    const std::string& name = groups_[source.group];
    const auto is_among = [&](const std::vector<std::string>& names) {
      return std::ranges::find(names, name) != names.end();
    };
    const bool environment = emitters_[source.emitter].items.x == static_cast<int>(EmitterKind::environment);
    const bool left_out = is_among(groups), mirrors = environment && is_among(mirrored);
    if (left_out == source.left_out && mirrors == source.mirrored) continue;
    source.left_out = left_out;
    source.mirrored = mirrors;
    want_maps(source);
    emitters_changed_ = true;
  }
}

void Lights::want_maps(const Source& source) {
  const ivec4& items = emitters_[source.emitter].items;
  switch (static_cast<EmitterKind>(items.x)) {
    case EmitterKind::point:
    case EmitterKind::lobe:
      return lamps_.want(6 * source.first_map, 6, source.lights());
    case EmitterKind::sun:
    case EmitterKind::disc:
      return suns_.want(source.first_map, sun_cascades * items.z, source.lights());
    case EmitterKind::environment:
      return skies_.want(0, items.z, source.lights());
    case EmitterKind::sphere:
    case EmitterKind::mesh:
      return areas_.want(6 * source.first_map, 6 * items.z, source.lights());
    case EmitterKind::sphl:
      return;
  }
}

void Lights::add_emission(int probe, const vec3& position, float radius, const sh::RadianceSh& leaving) {
  emitters_changed_ = true;
  GpuEmitter e;
  e.place = vec4(position, radius);
  e.light = vec4(1, 1, 1, 0);
  e.items = ivec4(static_cast<int>(EmitterKind::sphl), 0, 0, probe);
  for (std::size_t k = 0; k < std::min<std::size_t>(leaving.values.size(), max_corners); ++k)
    e.corners[k] = vec4(leaving.values[k], 0);
  emitters_.push_back(e);
}

void Lights::clear_emissions() {
  emitters_.resize(static_cast<std::size_t>(scene_emitters_));
  emitters_changed_ = true;
}

void Lights::invalidate(const std::vector<scene::Bounds>& moved) {
  for (MapAtlas* atlas : {&lamps_, &areas_, &suns_, &skies_}) atlas->invalidate(moved);
}

void Lights::place(Source& source, const mat4& world) {
  if (source.placed == world) return;
  source.placed = world;
  emitters_changed_ = true;
  GpuEmitter& e = emitters_[source.emitter];
  if (!source.points.empty()) {
    const bool flat = source.light >= 0 && scene::is_area_lamp(lights_[source.light].type);
    place_samples(source, flat ? scene::area_lamp_pose(world) : world);
    if (source.light >= 0) e.place = vec4(vec3(world[3]), scene::lamp_reach(lights_[source.light]));
    return;
  }
  if (source.light < 0) return;
  const scene::Light& light = lights_[source.light];
  const vec3 back(world[2]);
  const float length = glm::length(back);
  const vec3 axis = length > 0 ? back / length : vec3(0, 0, 1);
  if (light.type == scene::LightType::directional) {
    point_sun(source, axis, std::min(light.angular_radius, pi / 2));
    return;
  }
  const bool lobe = light.type == scene::LightType::sphl;
  e.place = vec4(vec3(world[3]), lobe ? light.radius : 0);
  mat3 axes = scene::emission_axes(world);
  if (light.has_profile()) axes = axes * scene::photometric_axes(light.profile.table->type);
  for (int i = 0; i < 3 && (lobe || light.has_profile()); ++i) e.samples[i].place = vec4(axes[i], 0);
  const bool spot = light.type == scene::LightType::spot;
  if (spot) {
    const float cos_outer = std::cos(light.outer_cone);
    const float scale = 1 / std::max(0.001f, std::cos(light.inner_cone) - cos_outer);
    e.cone = vec4(-axis, scale);
    e.more.x = -cos_outer * scale;
  }
  for (int face = 0; face < 6; ++face) {
    MapView view = cube_view(vec3(world[3]), face, near_);
    view.clear_radius = e.place.w;
    // A face reaches 54.7 degrees from its axis
    const bool lit = glm::dot(view.forward, -axis) > std::cos(std::min(light.outer_cone + 0.956f, pi));
    lamps_.set_view(6 * source.first_map + face, view, !spot || lit);
  }
}

void Lights::set_colors() {
  for (const Source& source : sources_) {
    GpuEmitter& e = emitters_[source.emitter];
    const vec3 scale = source.group >= 0 ? scales_[source.group] : vec3(1);
    vec3 light = source.radiance;
    float range = 0;
    if (source.light >= 0) {
      const scene::LightState& state = states_[source.light];
      light = state.color * state.intensity;
      range = lights_[source.light].range;
      for (std::size_t k = 0; k < std::min<std::size_t>(state.emission.values.size(), max_corners); ++k)
        e.corners[k] = vec4(state.emission.values[k], 0);
      if (e.items.x == static_cast<int>(EmitterKind::lobe) && state.emission.empty()) light = vec3(0);
    }
    e.light = vec4(scale * light, range);
  }
}

void Lights::prepare(const scene::CameraPose& camera, float aspect, const Seen& seen,
                     const scene::Bounds& bounds, FrameCounters& counters) {
  for (const Source& source : sources_) {
    if (is_sun(source)) place_sun(source, camera, aspect, seen, bounds);
  }
  sun_bounds_ = bounds;
  if (environment_ && (bounds.min != environment_bounds_.min || bounds.max != environment_bounds_.max))
    place_environment(bounds);
  if (emitters_changed_) {
    set_colors();
    list_lit();
    const std::size_t bytes = emitters_.size() * emitter_stride;
    if (emitter_buffer_.size() < bytes) {
      emitter_buffer_.reserve(bytes);
      uploaded_.clear();
    }
    upload_emitters(counters);
  }
  if (distant_changed_) upload(counters, distant_buffer_, std::span<const DistantBlock>(&distant_, 1));
  emitters_changed_ = distant_changed_ = false;
}

void Lights::upload_emitters(FrameCounters& counters) {
  for (std::size_t i = 0; i < emitters_.size(); ++i) {
    const bool known = i < uploaded_.size();
    if (known && std::memcmp(&uploaded_[i], &emitters_[i], sizeof(GpuEmitter)) == 0) continue;
    emitter_buffer_.update_bytes(i * emitter_stride,
                                 std::as_bytes(std::span<const GpuEmitter>(&emitters_[i], 1)));
    counters.bytes_uploaded += sizeof(GpuEmitter);
  }
  uploaded_ = emitters_;
}

void Lights::list_lit() {
  lit_.clear();
  std::vector<const Source*> source_of(emitters_.size());  // none of SPHLs
  for (const Source& source : sources_) source_of[source.emitter] = &source;
  for (std::size_t i = 0; i < emitters_.size(); ++i) {
    const GpuEmitter& e = emitters_[i];
    if (!(max_component(vec3(e.light)) > black)) continue;
    const auto kind = static_cast<EmitterKind>(e.items.x);
    lit_.push_back({kind, static_cast<int>(i),
                    kind == EmitterKind::disc || kind == EmitterKind::sphere ||
                        kind == EmitterKind::environment ||
                        (kind == EmitterKind::mesh && source_of[i]->light >= 0),
                    !source_of[i] || source_of[i]->lights(), source_of[i] && source_of[i]->left_out});
  }
}

void Lights::bind_emitter(const Lit& lit) const {
  emitter_buffer_.bind_uniform_range(
      binding::emitter_block, static_cast<std::size_t>(lit.emitter) * emitter_stride, sizeof(GpuEmitter));
  const MapAtlas& parallel = lit.kind == EmitterKind::environment ? skies_ : suns_;
  parallel.texture().bind(unit::parallel_maps);
  if (parallel.glass().id()) parallel.glass().bind(unit::parallel_glass);
}

int Lights::update_maps(const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, gl::Program* glass,
                        int most, int& waiting, FrameCounters& counters) {
  int drawn = lamps_.update(scene, opaque, alpha, most, waiting, counters, glass);
  drawn += areas_.update(scene, opaque, alpha, most - drawn, waiting, counters, glass);
  // The sun's maps follow the view: they cannot wait
  for (MapAtlas* atlas : {&suns_, &skies_})
    drawn += atlas->update(scene, opaque, alpha, atlas->count(), waiting, counters, glass);
  return drawn;
}

void Lights::bind() const {
  distant_buffer_.bind_uniform(binding::distant_block);
  lamps_.texture().bind(unit::light_maps);
  areas_.texture().bind(unit::area_maps);
  profiles_.bind();
  if (bounds_) bounds_->bind();
  if (!lamps_.glass().id()) return;
  lamps_.glass().bind(unit::light_glass);
  areas_.glass().bind(unit::area_glass);
}

std::size_t Lights::bytes() const {
  return lamps_.bytes() + areas_.bytes() + suns_.bytes() + skies_.bytes() + profiles_.bytes() +
         emitter_buffer_.size() + (bounds_ ? bounds_->bytes() : 0) + distant_buffer_.size();
}

}  // namespace ssphh::realtime
