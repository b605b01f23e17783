#pragma once
/// Two rooms with a lamp and a door between them, as a game plays them.

#include <cmath>

#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/network.h>
#include <ssphh/transport/session_sets.h>

namespace ssphh::test {

struct GameRooms {
  scene::Scene scene = scene::make_builtin("two-rooms");
  trace::TransportScene source{scene};
  std::vector<scene::ProbePlace> places = scene::sphl_places(scene);
};

/// Much smaller than the defaults.
inline transport::RelightParams small_params(probes::LightOperator op = probes::LightOperator::surfel) {
  transport::RelightParams params;
  params.transport = {.directions = 96, .surfel_size = 0.4f, .link_rays = 24, .samples = 4};
  params.degree = 3;
  params.op = op;
  return params;
}

/// Of frame i: what changes from one to the next.
struct Play {
  bool lamp_moves = false, lamp_dims = false, group_dims = false, door_moves = false;
};

inline void play(const Play& what, int frame, const scene::LightingState& start,
                 scene::LightingState& state) {
  const float t = 0.1f * static_cast<float>(frame);
  if (what.lamp_moves)
    state.lights[0].world[3] = start.lights[0].world[3] + vec4(0.4f * std::sin(t), 0, 0, 0);
  if (what.lamp_dims) state.lights[0].intensity = start.lights[0].intensity * (0.6f + 0.4f * std::cos(t));
  if (what.group_dims) state.group_scales[0] = vec3(0.6f + 0.4f * std::sin(t), 1, 0.5f);
  if (what.door_moves) state.time = 0.5f + 0.5f * std::sin(t);
}

}  // namespace ssphh::test
