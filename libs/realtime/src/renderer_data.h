#pragma once
/// What a Renderer holds, and the passes of its frames (frame_passes.cpp).

#include <filesystem>
#include <optional>
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

enum Pass { shadows, geometry, direct, indirect, seen, glass, resolve, display, pass_count };
inline constexpr const char* pass_names[pass_count] = {"shadows", "geometry", "direct",  "indirect",
                                                       "seen",    "glass",    "resolve", "display"};

/// Of gbuffer.frag.
enum class GlassLayer { opaque, through, reflecting };

struct Renderer::Data {
  Data(gl::Context& context, const scene::Scene& scene, const RendererParams& params, float time);

  void pose(float time);
  void emit(const std::vector<scene::SphlEmission>& emission);
  void forget_emission() {
    lights.clear_emissions();
    lighting.emission.clear();
  }
  /// Leaves out the direct light that the probes hold, as long as they light the scene, and that of records,
  /// as long as these do.
  void choose_direct(const FrameSettings& settings);
  /// What the set keeps of direct light.
  void keep_direct(const probes::ProbeSet& set);
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
  /// Adds light where such surfaces are.
  static gl::DrawState of_class(int surface) { return {.blend = gl::Blend::add, .stencil_equal = surface}; }
  /// For the classes of surfaces that reflect: draw(full, state).
  template <class Draw>
  void for_each_class(const Draw& draw_class) {
    draw_class(false, of_class(surface_class::lambertian));
    if (scene.any_full()) draw_class(true, of_class(surface_class::full));
  }
  void draw_shadows();
  void draw_geometry(const FrameSettings& settings);
  /// Items of the scene as one layer has them; `wanted(item)` chooses, `state` says how.
  template <class Wanted>
  void draw_items(const FrameSettings& settings, GlassLayer layer, gl::DrawState state, const Wanted& wanted);
  /// Dims what stands behind glass, and adds what the nearest glass reflects.
  void draw_glass(const FrameSettings& settings, bool wants_direct, bool wants_indirect);
  void bind_sky_lobes(gl::Program& program);
  /// `glass`: of glass alone, which stands in the G-buffer then.
  void draw_direct(bool shadow_view, bool glass = false);
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
  std::vector<std::string> baked_groups, mirrored_groups;  ///< of the probes
  /// By what choose_direct() last chose.
  struct DirectChoice {
    bool by_probes, by_records;
    friend bool operator==(const DirectChoice&, const DirectChoice&) = default;
  };
  std::optional<DirectChoice> direct_choice;
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
