#pragma once
/// What a Renderer holds, and the passes of its frames (frame_passes.cpp).

#include <filesystem>
#include <vector>

#include <ssphh/gl/draw.h>
#include <ssphh/gl/timer.h>
#include <ssphh/gl/vertex_array.h>
#include <ssphh/realtime/renderer.h>

#include "environment_tiles.h"
#include "frame_images.h"
#include "gpu_scene.h"
#include "lights.h"
#include "method_light.h"
#include "probes.h"
#include "shaders.h"

namespace ssphh::realtime {

enum Pass { shadows, geometry, direct, indirect, seen, resolve, display, pass_count };
inline constexpr const char* pass_names[pass_count] = {"shadows", "geometry", "direct", "indirect",
                                                       "seen",    "resolve",  "display"};

struct Renderer::Data {
  Data(gl::Context& context, const scene::Scene& scene, const RendererParams& params, float time);

  void pose(float time);
  void emit(const std::vector<scene::SphlEmission>& emission);
  void forget_emission() {
    lights.clear_emissions();
    lighting.emission.clear();
  }
  void reload_changed_shaders();
  template <class Draw>
  void run(Pass pass, const Draw& draw_pass) {
    {
      const gl::During timing(timers[pass]);
      draw_pass();
    }
    stats.passes.push_back({pass_names[pass], timers[pass].cpu_ms(), timers[pass].gpu_ms()});
  }
  /// One triangle over the rectangle; `where` tells which pixels and how.
  void fullscreen(gl::Program& program, unsigned framebuffer, const gl::Rect& rect,
                  const gl::DrawState& where = {});
  /// For the classes of surfaces that reflect: draw(full, state).
  template <class Draw>
  void for_each_class(const Draw& draw_class) {
    draw_class(false, gl::DrawState{.blend = gl::Blend::add, .stencil_equal = surface_class::lambertian});
    if (scene.any_full())
      draw_class(true, gl::DrawState{.blend = gl::Blend::add, .stencil_equal = surface_class::full});
  }
  void draw_shadows();
  void draw_geometry(const FrameSettings& settings);
  void bind_sky_lobes(gl::Program& program);
  void draw_direct(bool shadow_view);
  IndirectLookup lookup_of(const FrameSettings& settings) const;
  void draw_indirect(const FrameSettings& settings);
  void draw_occlusion();
  /// Images of indirect light to the pixels between, as far as they agree; lists the others.
  void interpolate_indirect();
  /// Adds what the program, a compute shader, finds at the listed pixels.
  void draw_listed(gl::Program& program);
  void draw_method(const FrameSettings& settings);
  void draw_seen(const FrameSettings& settings);
  void draw_view();
  void draw_display(const FrameSettings& settings, const Target& target);

  gl::Context& context;
  RendererParams params;
  scene::Scene posed;             ///< nodes, animations and materials alone
  scene::LightingState lighting;  ///< as last set
  std::vector<mat4> world;        ///< of each node at its time
  FrameCounters counters;
  gl::ShaderFiles files;
  Shaders shaders;
  std::filesystem::file_time_type shaders_from;
  GpuScene scene;
  Lights lights;
  Probes probes;
  std::unique_ptr<MethodLight> method;  ///< null: probes light the scene
  gl::Texture albedo, sky;
  gl::Sampler sky_sampler;
  TileAtlas sky_lobes;  ///< made when something glossy is first lit by an environment
  gl::Buffer frame_buffer;
  gl::VertexArray no_vertices;
  FrameImages images;
  std::vector<gl::Timer> timers;
  gl::SampleCounter shaded;
  FrameStats stats;
  mat4 view_projection{1};  ///< of the last frame
  std::vector<scene::Bounds> moved;
  bool drawn = false;
};

}  // namespace ssphh::realtime
