/// Lights chosen, sampled and looked at.

#include <ssphh/core/require.h>
#include <ssphh/shading/mesh_view.h>

#include "light_set_data.h"

namespace ssphh::shading {

LightSet::~LightSet() = default;
LightSet::LightSet(LightSet&&) noexcept = default;
LightSet& LightSet::operator=(LightSet&&) noexcept = default;

bool LightSet::empty() const {
  return data_->tree.empty() && data_->distant.empty();
}
const std::vector<std::string>& LightSet::groups() const {
  return data_->groups;
}

int LightSet::sample_count() const {
  return (data_->tree.empty() ? 0 : 1) + (data_->distant.empty() ? 0 : 1);
}

std::optional<LightSample> LightSet::sample(int i, const vec3& position, float u_choice,
                                            const vec2& u) const {
  require(i >= 0 && i < sample_count(), "light set", "there is no sample of that index");
  const Data& d = *data_;
  if (i > 0 || d.tree.empty()) return d.distant.sample(u_choice, u);
  const auto choice = d.choose_local(position, u_choice);
  if (!(choice.probability > 0)) return std::nullopt;
  auto s = d.sample(choice.index, position, choice.u, u);
  if (s) s->pdf *= choice.probability;
  return s;
}

namespace {

void check_emitter(int index, const LightSet& lights) {
  require(index >= 0 && index < lights.emitter_count(), "light set", "there is no emitter of that index");
}

}  // namespace

int LightSet::emitter_count() const {
  return static_cast<int>(data_->local_count() + data_->distant.count());
}

Emitter LightSet::emitter(int index) const {
  check_emitter(index, *this);
  const Data& d = *data_;
  auto i = static_cast<std::size_t>(index);
  if (i >= d.local_count()) return d.distant.emitter(i - d.local_count());
  const scene::Bounds extent = d.bounds(i);
  if (i < d.points.size()) return {EmitterKind::point, d.points[i].group, extent};
  i -= d.points.size();
  if (i < d.spheres.size()) return {EmitterKind::sphere, d.spheres[i].group, extent};
  return {EmitterKind::mesh, d.meshes[i - d.spheres.size()]->group(), extent};
}

std::optional<LightSample> LightSet::sample_emitter(int index, const vec3& position, const vec2& u) const {
  check_emitter(index, *this);
  const Data& d = *data_;
  auto i = static_cast<std::size_t>(index);
  if (i < d.points.size()) return d.points[i].sample(position);
  i -= d.points.size();
  if (i < d.spheres.size()) return d.spheres[i].sample(position, u);
  i -= d.spheres.size();
  if (i < d.meshes.size()) return d.meshes[i]->sample(position, u);
  return d.distant.sample_one(i - d.meshes.size(), u);
}

float LightSet::flux(int index, float radius) const {
  check_emitter(index, *this);
  const auto i = static_cast<std::size_t>(index);
  const std::size_t local = data_->local_count();
  return i < local ? 4 * pi * data_->power(i) : data_->distant.flux(i - local, radius);
}

std::optional<EmittedPhoton> LightSet::emit(int index, const vec2& u_place, const vec2& u_direction,
                                            const vec3& center, float radius) const {
  check_emitter(index, *this);
  const Data& d = *data_;
  auto i = static_cast<std::size_t>(index);
  if (i < d.points.size()) return EmittedPhoton{d.points[i].emit(u_direction)};
  i -= d.points.size();
  if (i < d.spheres.size()) return EmittedPhoton{d.spheres[i].emit(u_place, u_direction)};
  i -= d.spheres.size();
  if (i < d.meshes.size()) return d.meshes[i]->emit(u_place, u_direction);
  const auto photon = d.distant.emit(i - d.meshes.size(), u_place, u_direction, center, radius);
  return photon ? std::optional(EmittedPhoton{*photon}) : std::nullopt;
}

std::optional<MeshView> LightSet::view_mesh(int index, const vec3& position, const vec3& normal) const {
  check_emitter(index, *this);
  const Data& d = *data_;
  const std::size_t i = static_cast<std::size_t>(index) - d.points.size() - d.spheres.size();
  return i < d.meshes.size() ? d.meshes[i]->view(position, normal) : std::nullopt;
}

std::optional<EmitterHit> LightSet::distant_radiance(int i, const vec3& direction) const {
  check_emitter(i, *this);
  const std::size_t local = data_->local_count();
  require(static_cast<std::size_t>(i) >= local, "light set", "that emitter is not distant");
  return data_->distant.radiance_of(static_cast<std::size_t>(i) - local, direction);
}

float LightSet::pdf_triangle(const vec3& position, int instance, std::uint32_t triangle, float distance,
                             float cos_light) const {
  const Data& d = *data_;
  require(instance >= 0 && static_cast<std::size_t>(instance) < d.instance_mesh_light.size(), "light set",
          "there is no instance of that index");
  const int mesh = d.instance_mesh_light[instance];
  if (mesh < 0) return 0;
  const auto index = static_cast<std::size_t>(mesh);
  const float pdf = d.meshes[index]->pdf(position, triangle, distance, cos_light);
  return pdf > 0 ? pdf * d.local_probability(d.points.size() + d.spheres.size() + index, position) : 0;
}

int LightSet::instance_group(int instance) const {
  const std::vector<int>& groups = data_->instance_group;
  require(instance >= 0 && static_cast<std::size_t>(instance) < groups.size(), "light set",
          "there is no instance of that index");
  return groups[instance];
}

int LightSet::lamp_count() const {
  const Data& d = *data_;
  return static_cast<int>(d.spheres.size() + d.meshes.size() - d.flat_from);
}

std::optional<EmitterHit> LightSet::intersect_lamp(int i, const vec3& origin, const vec3& direction,
                                                   float max_distance) const {
  const Data& d = *data_;
  const auto index = static_cast<std::size_t>(i);
  if (index >= d.spheres.size()) {
    const std::size_t mesh = d.flat_from + index - d.spheres.size();
    auto hit = d.meshes[mesh]->intersect(origin, direction, max_distance);
    if (hit) hit->pdf *= d.local_probability(d.points.size() + d.spheres.size() + mesh, origin);
    return hit;
  }
  const SphereLight& light = d.spheres[index];
  const auto distance = light.intersect(origin, direction, max_distance);
  if (!distance) return std::nullopt;
  const float pdf = light.pdf(origin) * d.local_probability(d.points.size() + index, origin);
  return EmitterHit{*distance, light.radiance, pdf, light.group};
}

int LightSet::distant_count() const {
  return data_->distant.visible_count();
}

std::optional<EmitterHit> LightSet::distant(int i, const vec3& direction) const {
  return data_->distant.hit(i, direction);
}

}  // namespace ssphh::shading
