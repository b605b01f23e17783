#pragma once
/// Draws a scene lit by its lamps and by SPHLs, or another method's indirect light, with OpenGL, in a window
/// or without one (docs/methods/realtime.md).
///
///   gl::Context context = gl::Context::headless();
///   realtime::Renderer renderer(context, scene);
///   renderer.set_probes(probes::read_probe_file("probes.sphl"));
///   renderer.draw(scene::camera_pose(scene, ""), {}, {.width = 1280, .height = 720});
///   const image::Image picture = renderer.read_back();

#include <filesystem>
#include <span>
#include <string>

#include <ssphh/core/held.h>
#include <ssphh/gl/context.h>
#include <ssphh/gl/texture.h>
#include <ssphh/image/image.h>
#include <ssphh/methods/method.h>
#include <ssphh/probes/fitted_surfaces.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/realtime/frame_stats.h>
#include <ssphh/realtime/gbuffer.h>
#include <ssphh/realtime/mesh_buffers.h>
#include <ssphh/realtime/settings.h>
#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/query.h>

namespace ssphh::realtime {

/// Where the tone-mapped picture goes.
struct Target {
  static constexpr unsigned none = ~0u;
  int width = 1280, height = 720;  ///< pixels
  unsigned framebuffer = none;     ///< OpenGL's number, 0 a window's own; none: only read_back() wants it
  int x = 0, y = 0;                ///< lower left corner in it
};

struct RendererParams {
  std::filesystem::path shader_directory =
      {};                     ///< files here replace the built-in shaders and reload on change
  int light_map_size = 1024;  ///< pixels of a shadow map's face: point and spot lights
  int area_map_size = 256;    ///< of each point on a light with an extent
  int sun_map_size = 2048;    ///< of a cascade; halved until all suns' cascades fit in `sun_map_bytes`
  std::size_t sun_map_bytes = std::size_t{192} << 20;
  int environment_map_size = 1024;                               ///< of a direction of the environment
  std::size_t probe_map_bytes = std::size_t{64} << 20;           ///< for all probes' maps together
  std::size_t voxel_bytes = std::size_t{2} << 30;                ///< for the voxels of method vct at most
  std::size_t virtual_light_map_bytes = std::size_t{256} << 20;  ///< for the maps of all lights of method vpl
  int area_samples = 16;  ///< points that stand for a light with an extent, each with a shadow map
  int sun_samples = 7;    ///< parts of a wide sun's disc at most (1, 4, 7, 12, 16), each with six shadow maps
  int environment_samples = 32;  ///< directions in which the environment casts shadows
  int maps_per_frame = 1 << 30;  ///< cube maps drawn in one frame at most; the rest wait for the next
};

class Renderer {
 public:
  /// Uploads the scene, but the meshes that the engine has in buffers of its own, and keeps a copy of what it
  /// needs of it; the scene may go. Those buffers must stay as they are as long as the renderer draws.
  /// Earlier errors of OpenGL are the host's. Throws Error when the driver refuses something, for a shader
  /// that does not compile, and for buffers that do not hold their mesh (MeshBuffers), as far as sizes tell.
  Renderer(gl::Context& context, const scene::Scene& scene, const RendererParams& params = {}, float time = 0,
           std::span<const MeshBuffers> engines = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// What lights the scene, and poses what moves: does only what changed since the last call. Emission is of
  /// the probes that set_probes() gave, in which it stands in for what is within their radius. Throws Error
  /// for a state that scene::check_lighting refuses; everything stays as it was then.
  void set(const scene::LightingState& state);
  /// What was last set; at first scene::lighting_at() of the scene, at the constructor's time.
  const scene::LightingState& lighting() const;
  /// The lamps of `scene` in place of those of now, without any upload of geometry, textures or probes:
  /// lamps come, go, or are of another kind. `scene` is the constructor's but for its lamps and the nodes
  /// that they alone stand at. What lights it is scene::lighting_at() at the time that was last set, its
  /// environment as set. Throws Error for instances at other nodes, another number of materials, and more
  /// lamps than the driver has room for; everything stays as it was then.
  void set_lamps(const scene::Scene& scene);
  /// Numbers of a material; its textures stay those of the scene. Throws Error for an index out of range.
  void set_material(int index, const scene::Material& material);

  /// Probes that light the scene, none of which shines until set() says so: copies what it needs. Emitters of
  /// light groups that are baked light nothing but through them, nor those of `diffuse` ones but for mirrors
  /// where records do (docs/light-modes.md).
  /// `params.weights` and `params.irradiance_degree` limit what FrameSettings may ask for. Throws Error as
  /// probes::IrradianceLookup does.
  void set_probes(const probes::ProbeSet& set, const probes::LookupParams& params = {});
  /// Modes and factors of the light groups of the last set_probes' set anew, and which direct light its
  /// records and probes keep. Throws Error for another number of probes.
  void set_kept_light(const probes::ProbeSet& set);
  /// Fitted weights of the last set_probes' probes, for FrameSettings::weights `fitted`; set_probes forgets
  /// them. Empty: none. Throws Error for points that name a probe which there is not.
  void set_fitted(const probes::FittedSurfaces& fitted);
  /// Surface records for FrameSettings::weights `surface`, dark at first; they and fitted weights replace
  /// each other, and set_probes forgets them. Empty: none.
  void set_records(const probes::SurfaceLists& lists);
  /// New light of all records, in the order of their points. Throws Error for another number of them.
  void set_record_light(std::span<const probes::RecordLight> light);
  /// New light for some probes of the last set_probes, one function each: what surfaces look up. Cost and
  /// upload are proportional to their number. Throws Error for an index out of range and for functions that
  /// are not finite or not of the set's degree; all probes stay as they were then.
  void update_probes(std::span<const int> probes, std::span<const sh::RadianceSh> light);
  void clear_probes();
  int probe_count() const;

  /// Indirect light of another method, for one state of lamps and doors: takes the place of the probes' until
  /// cleared. Copies what it needs, and keeps of what was set before what still holds. Throws Error for data
  /// that only the CPU can look up, and for what does not fit into the memory that the parameters allow.
  void set_method_light(const methods::LightData& light);
  void clear_method_light();
  /// Its memory here ("gl_bytes") and what there is of it: "gl_cones"; "gl_lights", of which more than have
  /// room for shadow maps were merged, and "gl_map_size". Empty: none is set.
  methods::MethodNumbers method_numbers() const;

  /// Draws a frame. Restores no OpenGL state (gl::SavedState does). Throws Error when OpenGL reports an
  /// error.
  const FrameStats& draw(const scene::CameraPose& camera, const FrameSettings& settings,
                         const Target& target);
  /// The same frame, bit for bit, in pieces of some milliseconds on a software renderer, so that the host's
  /// window goes on between them: begin(), then step() until it is false. What the host draws in between may
  /// leave any state behind; this renderer's set functions may be called only after the last piece, and
  /// another begin() or draw() drops what is left. Nothing is read back before the last piece.
  void begin(const scene::CameraPose& camera, const FrameSettings& settings, const Target& target);
  bool step();
  /// The last frame, whole, once more into its target, with this exposure and curve: the bits of one drawn
  /// with them, in the time of one pass. Throws Error before the first frame, and where read_back() alone
  /// wanted it.
  void show_again(const image::ToneMap& tone);
  /// Indirect light on what an engine has drawn: finds it at each texel of the G-buffer as draw() does for
  /// the scene, with `settings`' lookup, weights, indirect_scale and ambient occlusion, or of the method that
  /// is set. Returns the radiance [W/(m² sr)] that Lambertian surfaces of the albedo send, albedo E / π, as
  /// 32-bit floats of linear RGB, 0 where nothing stands, of the G-buffer's size; the texture is this
  /// renderer's, until its next frame. Leaves OpenGL's state as it was (gl::SavedState). Throws Error for
  /// numbers of no texture, textures of several sizes and matrices of no camera.
  const gl::Texture& draw_indirect(const GBuffer& gbuffer, const FrameSettings& settings = {});
  /// What the last frame took, which is whole once step() was false.
  const FrameStats& stats() const;
  /// The last frame as scene-linear radiance, before exposure and tone curve; row 0 on top.
  image::Image read_back() const;
  /// So many of its pixels, spread evenly, or all of a smaller one: little to read, and enough to tell how
  /// bright it is.
  image::Image read_some(int width, int height) const;

  /// What drew the last frame's surfaces, for those who draw more into it: the depth at every sample
  /// (the target's size times supersample; 32-bit float with stencil, 1 near, 0 far away; row 0
  /// at the bottom), and world to clip space with z in 0..1. The texture is another after a frame of another
  /// size.
  const gl::Texture& depth_texture() const;
  mat4 view_projection() const;

  /// Bytes of OpenGL memory that this renderer asked for.
  std::size_t memory_bytes() const;
  /// Compiles every variant of every shader and tells what the compiler said beside errors; empty: nothing.
  /// Throws Error for one that does not compile.
  std::string shader_warnings();

 private:
  struct Data;
  Held<Data> data_;
};

}  // namespace ssphh::realtime
