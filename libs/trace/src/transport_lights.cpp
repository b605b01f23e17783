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
  return data_->light_group[light];
}

bool TransportScene::group_emits_from(int group, int part) const {
  const scene::Scene& scene = data_->scene;
  for (const int i : data_->part(part).instances) {
    if (data_->lights.instance_group(i) == group) return true;
  }
  return part == 0 && scene.environment && environment_group() == group;
}

int TransportScene::environment_group() const {
  return data_->environment_group;
}

namespace {

void check_counts(const TransportData& data, std::span<const scene::LightState> lights,
                  std::span<const mat4> poses) {
  require(lights.size() == data.scene.lights.size(), "direct light", "there is not one state for each light");
  require(poses.size() == data.layout().parts.size(), "direct light", "there is not one pose for each part");
}

}  // namespace

std::unique_ptr<rays::DirectLight> TransportScene::direct_light(
    std::span<const scene::LightState> lights, std::span<const mat4> poses,
    const scene::EnvironmentState& environment) const {
  check_counts(*data_, lights, poses);
  return std::make_unique<PosedLight>(data_, lights, poses, environment);
}

void TransportScene::renew_direct_light(std::unique_ptr<rays::DirectLight>& light,
                                        std::span<const scene::LightState> lights,
                                        std::span<const mat4> poses,
                                        const scene::EnvironmentState& environment) const {
  auto* const mine = dynamic_cast<PosedLight*>(light.get());
  if (mine && mine->is_of(data_.get())) {
    check_counts(*data_, lights, poses);
    mine->pose(lights, poses, environment);
  } else {
    light = direct_light(lights, poses, environment);
  }
}

std::unique_ptr<rays::RadianceSource> TransportScene::path_tracing(const scene::LightingState& state) const {
  auto lit = std::make_shared<const scene::Scene>(scene::with_lighting(data_->scene, state));
  return std::make_unique<PathTracer>(data_->geometry.shared(), std::move(lit), state.time);
}

}  // namespace ssphh::trace
