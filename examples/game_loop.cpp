// Light in a game: a worker updates it within a time budget while the game's thread draws with what is
// finished.

#include <atomic>
#include <cstdio>
#include <thread>

#include <ssphh/core/snapshots.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/session_sets.h>

using namespace ssphh;

int main() {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  const trace::PathTracer eye(scene);  // which probes a point sees
  transport::RelightParams params;
  params.transport = {.directions = 96, .surfel_size = 0.4f, .link_rays = 24, .samples = 4};
  transport::RelightSession session(source, scene::sphl_places(scene), params);
  const scene::LightingState start = session.lighting();

  // The first light, and what the threads exchange: the state that is wanted, the light that is finished.
  session.update(start);
  probes::ProbeSet set = transport::lookup_set(session);
  Snapshots<scene::LightingState> wanted(start);
  Snapshots<probes::IrradianceLookup> light(probes::IrradianceLookup(set, eye));

  std::atomic<bool> plays = true;
  std::thread worker([&] {
    while (plays || !(session.shown() == *wanted.read())) {
      session.update(*wanted.read(), {}, 2.0);  // 2 ms, then a look at what is wanted now
      transport::refresh(set, session);
      light.publish([&](probes::IrradianceLookup& next) { next.swap_light(set); });
    }
  });

  // The game: the door opens in 60 frames. No frame waits for light.
  const rays::SurfacePoint floor{session.places().back().position, {0, 1, 0}};
  scene::LightingState state = start;
  bool lit = true;
  for (int frame = 1; frame <= 60; ++frame) {
    state.time = static_cast<float>(frame) / 60;
    wanted.publish([&](scene::LightingState& next) { next = state; });
    const auto now = light.read();  // stays as it is until the end of the frame
    lit = lit && now->irradiance(floor).y >= 0;
  }
  plays = false;
  worker.join();
  std::printf("60 frames drawn with finished light: %s\n", lit ? "yes" : "no");
  std::printf("the light shows the door at %.1f s, asked for %d updates ago\n",
              static_cast<double>(session.shown().time), static_cast<int>(session.age().updates));
}
