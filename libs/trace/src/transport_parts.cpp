/// The parts of a TransportScene.

#include "surface_gap.h"
#include "transport_data.h"

namespace ssphh::trace {
namespace {

void check_options(const TransportOptions& options) {
  if (options.light_samples < 1) throw Error("light samples", "at least one is needed");
  if (options.environment_samples < 1) throw Error("environment samples", "at least one is needed");
  if (!(options.surface_tolerance >= 0 && options.surface_tolerance < 1))
    throw Error("surface tolerance", "it must lie in 0..1");
}

}  // namespace

TransportData::TransportData(SharedGeometry geometry_in, const scene::Scene& scene_in,
                             const TransportOptions& options_in)
    : scene(scene_in),
      options(options_in),
      geometry(std::move(geometry_in), scene_in),
      lights(scene_in, scene::world_matrices(scene_in, 0)),
      panes(find_panes(geometry)) {
  gap = options.surface_tolerance * scene_size(scene::world_bounds(scene, scene::world_matrices(scene, 0)));
  if (scene.environment)
    environment_group = scene::light_group_index(lights.groups(), scene::light_group(*scene.environment));
  for (const scene::Light& light : scene.lights) {
    light_names.push_back(light.name);
    light_group.push_back(scene::light_group_index(lights.groups(), scene::light_group(light)));
  }
}

TransportScene::TransportScene(SharedGeometry geometry, const scene::Scene& scene,
                               const TransportOptions& options) {
  check_options(options);
  scene::check_indices(scene);
  data_ = std::make_shared<const Data>(std::move(geometry), scene, options);
}

TransportScene::TransportScene(const scene::Scene& scene, const TransportOptions& options)
    : TransportScene(std::make_shared<const SceneGeometry>(scene), scene, options) {}

TransportScene::~TransportScene() = default;

int TransportScene::part_count() const {
  return static_cast<int>(data_->layout().parts.size());
}

const std::string& TransportScene::part_name(int part) const {
  return data_->part(part).name;
}

scene::Bounds TransportScene::part_bounds(int part) const {
  return data_->part(part).bounds;
}

float TransportScene::duration() const {
  return scene::animation_duration(data_->scene);
}

mat4 TransportScene::part_pose(int part, float time) const {
  const int node = data_->part(part).node;
  return node < 0 ? mat4(1) : scene::world_matrix(data_->scene, node, time);
}

std::uint64_t TransportScene::rays_traced() const {
  return data_->rays.total();
}

}  // namespace ssphh::trace
