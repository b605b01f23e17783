/// The lights as transport sees them.

#include <ssphh/core/require.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/trace/path_tracer.h>

#include "posed_light.h"
#include "transport_data.h"

namespace ssphh::trace {

const std::vector<std::string>& TransportScene::light_groups() const {
  return data_->lights.groups();
}

std::vector<scene::LightState> TransportScene::lights(float time) const {
  return scene::lighting_at(data_->scene, time).lights;
}

const std::vector<std::string>& TransportScene::light_names() const {
  return data_->light_names;
}

int TransportScene::light_group_of(int light) const {
  require(light >= 0 && static_cast<std::size_t>(light) < data_->light_group.size(), "light",
          "there is none of that index");
  return data_->light_group[static_cast<std::size_t>(light)];
}

bool TransportScene::group_emits_from(int group, int part) const {
  const scene::Scene& scene = data_->scene;
  for (const int i : data_->part(part).instances) {
    if (data_->lights.instance_group(i) == group) return true;
  }
  return part == 0 && scene.environment && environment_group() == group;
}

int TransportScene::environment_group() const {
  const std::optional<scene::Environment>& environment = data_->scene.environment;
  return environment ? scene::light_group_index(light_groups(), scene::light_group(*environment)) : -1;
}

std::unique_ptr<rays::DirectLight> TransportScene::direct_light(std::span<const scene::LightState> lights,
                                                                std::span<const mat4> poses,
                                                                float environment_rotation) const {
  require(lights.size() == data_->scene.lights.size(), "direct light",
          "there is not one state for each light");
  require(poses.size() == data_->layout().parts.size(), "direct light",
          "there is not one pose for each part");
  return std::make_unique<PosedLight>(data_, lights, poses, environment_rotation);
}

std::unique_ptr<rays::RadianceSource> TransportScene::path_tracing(const scene::LightingState& state) const {
  auto lit = std::make_shared<const scene::Scene>(scene::with_lighting(data_->scene, state));
  return std::make_unique<PathTracer>(data_->geometry.shared(), std::move(lit), state.time);
}

}  // namespace ssphh::trace
