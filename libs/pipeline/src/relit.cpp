#include <ssphh/core/require.h>
#include <ssphh/pipeline/relit.h>
#include <ssphh/scene/area_lamp.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/transport/session_sets.h>

namespace ssphh::pipeline {

mat4 aimed(scene::LightType type, const mat4& world, const vec3& direction) {
  require(is_finite(direction) && direction != vec3(0), "aim of a light", "its direction leads nowhere");
  if (scene::is_area_lamp(type)) return scene::aimed_area_lamp(world, direction);
  const Frame frame = Frame::around(-glm::normalize(direction));
  return {vec4(frame.x, 0), vec4(frame.y, 0), vec4(frame.z, 0), world[3]};
}

probes::ProbeSet baked_session(const transport::RelightSession& session, const scene::Scene& scene,
                               const std::vector<std::string>& groups, probes::LightOperator op,
                               const Control& control) {
  scene::LightingState unscaled = session.lighting();
  unscaled.group_scales = scene::lighting_at(scene).group_scales;  // 1, of dark groups 0
  probes::GeneratorInfo generator;
  generator.op = op;
  generator.scene = scene.name;
  generator.scene_hash = scene::light_hash(scene::with_lighting(scene, unscaled));
  return transport::baked_set(session, groups, generator, control);
}

}  // namespace ssphh::pipeline
