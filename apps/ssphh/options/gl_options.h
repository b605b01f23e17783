#pragma once
/// What the commands that draw with OpenGL share.

#include <string>

#include <ssphh/realtime/renderer.h>
#include <ssphh/scene/scene.h>
#include <ssphh/trace/scene_geometry.h>

namespace ssphh::app {

/// How surfaces look SPHLs up, as the options of `render` name it.
struct GlLookup {
  std::string probes;  ///< file; empty: direct light alone
  probes::LookupSpec spec;
  bool force = false;
};

/// Reads the file, refuses probes of another scene or pose, and hands them to the renderer. Throws Error.
void set_probes(realtime::Renderer& renderer, const GlLookup& options, const scene::Scene& scene, float time);

/// Hands a method's indirect light to the renderer: its probes, looked up as `spec` says, or what else it
/// has. `geometry` is of the scene. Throws Error for light that only the CPU can look up.
void set_method(realtime::Renderer& renderer, const methods::LightData& light, const probes::LookupSpec& spec,
                const trace::SharedGeometry& geometry, const scene::Scene& scene, float time);

/// Settings for stills: every pixel looks probes up, `samples` along each side.
realtime::FrameSettings still_settings(const GlLookup& options, int samples);

}  // namespace ssphh::app
