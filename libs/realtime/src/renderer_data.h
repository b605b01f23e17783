#pragma once
/// What a Renderer holds, and the passes of its frames (frame_passes.cpp).

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include <ssphh/gl/draw.h>
#include <ssphh/gl/timer.h>
#include <ssphh/gl/vertex_array.h>
#include <ssphh/realtime/renderer.h>

#include "environment_tiles.h"
#include "eye.h"
#include "frame_images.h"
#include "gpu_scene.h"
#include "lights.h"
#include "method_light.h"
#include "probes.h"
#include "seen_places.h"
#include "shaders.h"

namespace ssphh::realtime {

enum Pass { shadows, geometry, direct, indirect, seen, glass, resolve, display, pass_count };
inline constexpr const char* pass_names[pass_count] = {"shadows", "geometry", "direct",  "indirect",
                                                       "seen",    "glass",    "resolve", "display"};

/// An integer texture under a sampler that another pass left there reads as 0.
inline void unbind_samplers() {
  for (unsigned i = 0; i < unit::count; ++i) gl::Sampler::unbind(i);
}

struct Renderer::Data {
  Data(gl::Context& context, const scene::Scene& scene, const RendererParams& params, float time,
       std::span<const MeshBuffers> engines);

  void pose(float time);
  /// What is infinitely far away, after lights.set() has it.
  void show_environment();
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
  /// A frame in pieces: begin() lists them, Renderer::step() draws one.
  void begin(const scene::CameraPose& camera, const FrameSettings& settings, const Target& target,
             bool in_pieces_now);
  /// The same in common with a frame on an engine's G-buffer.
  void make_room(const FrameSettings& settings, const Target& target);
  void plan(const Eye& eye);
  void upload_frame_block(const Eye& eye);
  int pieces_of(Pass pass) const;
  /// The pass in bands of rows, a piece each.
  void in_bands(Pass pass, void (Data::*draw)());
  void finish_frame();
  /// One triangle over the band of the rectangle; `where` tells which pixels and how.
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
  // Of the frame that begin() was asked for. What fullscreen() draws keeps to the band of the piece.
  /// Sees how far the picture reaches.
  void prepare_lights();
  /// In pieces one map, and `more_shadows` tells whether others wait.
  void draw_shadows();
  void draw_geometry();
  void mend_cracks();
  void take_geometry();
  /// Items of the scene as one layer has them; `wanted(item)` chooses, `state` says how.
  template <class Wanted>
  void draw_items(GlassLayer layer, gl::DrawState state, const Wanted& wanted);
  /// Draws in the nearest bodies of glass what the picture shows behind them.
  void bend_light();
  /// Dims what stands behind glass.
  void draw_through_glass();
  /// Keeps the picture that rough sheets spread: without lamps, which light these as they light any surface.
  void keep_behind_frost();
  /// Finds what glass leaves, and puts the nearest rough sheets into the G-buffer, seen from behind.
  void draw_frost();
  /// Dims the picture by that, and spreads it behind those; what it does not show comes from the sky and from
  /// probes.
  void spread_behind_frost();
  /// Puts the nearest glass into the G-buffer, for what it reflects.
  void draw_glass();
  void bind_sky_lobes(gl::Program& program);
  void draw_direct() { add_direct(GlassLayer::opaque); }
  void draw_direct_behind_frost() { add_direct(GlassLayer::frosted); }
  void draw_direct_on_glass() { add_direct(GlassLayer::reflecting); }
  void add_direct(GlassLayer layer);
  IndirectLookup lookup_of(const FrameSettings& settings) const;
  gl::Program& indirect_program(bool full, IndirectOutput output);
  /// At every pixel; or at some for the images that interpolate_indirect() takes, then at the others.
  void draw_indirect();
  void draw_some_indirect();
  void draw_other_indirect();
  void draw_indirect_behind_frost() { add_indirect_on_glass(gl::Blend::add_to_rest); }
  void draw_indirect_on_glass() { add_indirect_on_glass(gl::Blend::add); }
  void add_indirect_on_glass(gl::Blend blend);
  void draw_occlusion();
  /// Images of indirect light to the pixels between, as far as they agree; lists the others.
  void interpolate_indirect();
  /// Adds what the program, a compute shader, finds at the listed pixels.
  void draw_listed(gl::Program& program);
  void draw_method();
  void draw_sky() { draw_seen(true); }
  void draw_lamps() { draw_seen(false); }
  /// Emitters that are no surfaces: the environment, or all others.
  void draw_seen(bool environment);
  void draw_view();
  void draw_resolved();
  void draw_display();

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
  gl::Sampler sky_sampler, texel_sampler;
  TileAtlas sky_lobes;  ///< made when something glossy is first lit by an environment
  gl::Buffer frame_buffer;
  gl::VertexArray no_vertices;
  FrameImages images;
  SeenPlaces seen_places;
  std::vector<gl::Timer> timers;
  gl::SampleCounter shaded;
  FrameStats stats;
  mat4 view_projection{1};  ///< of the last frame
  std::vector<scene::Bounds> moved;
  bool drawn = false;

  struct Piece {
    Pass pass;
    void (Data::*draw)();
    int index = 0, count = 1;  ///< which band of rows, of how many equal ones
  };
  FrameSettings frame_settings;  ///< of the frame that is being drawn, as all that follows
  std::optional<GBuffer> taken;  ///< an engine's, in place of the scene's geometry
  Target frame_target;
  scene::CameraPose frame_camera;
  std::vector<Piece> todo;
  std::size_t next_piece = 0;
  bool in_pieces = false, more_shadows = false;
  int shadow_maps_left = 0;
  struct {
    int index = 0, count = 1;
  } band;
  std::array<double, pass_count> pass_ms{};   ///< of the last frame
  std::array<PassTime, pass_count> now_ms{};  ///< of this one so far
};

}  // namespace ssphh::realtime
