#pragma once
/// All emitters of a scene as shaders see them, and the shadow maps they need.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/realtime/renderer.h>

#include "depth_bounds.h"
#include "emitter_samples.h"
#include "lamp_profiles.h"
#include "seen_places.h"
#include "shadow_maps.h"

namespace ssphh::realtime {

/// World matrix of a node; −1: the identity.
inline const mat4& node_matrix(const std::vector<mat4>& world, int node) {
  static const mat4 identity(1);
  return node >= 0 ? world[static_cast<std::size_t>(node)] : identity;
}

class Lights {
 public:
  /// As at `time` seconds, when the nodes stand as in `world`. With `before`, of the same scene with other
  /// lamps, they are whole once take_from() had it: no memory is taken for what comes from there.
  Lights(const scene::Scene& scene, float time, const std::vector<mat4>& world, const scene::Bounds& bounds,
         const RendererParams& params, const Lights* before = nullptr);
  /// The shadow maps that have their places here, too, and what is known of the environment.
  void take_from(Lights& before, const std::vector<mat4>& world);

  /// Emission of SPHLs apart. `world`: of each node at the state's time.
  void set(const scene::LightingState& state, const std::vector<mat4>& world);
  /// Light groups whose direct light comes to surfaces from elsewhere: their emitters are seen, but light
  /// nothing and need no shadow maps. Replaces those of before. Of `mirrored` groups among them glossy
  /// surfaces still mirror the environment.
  void leave_out(const std::vector<std::string>& groups, const std::vector<std::string>& mirrored = {});
  /// A probe's own light.
  void add_emission(int probe, const vec3& position, float radius, const sh::RadianceSh& leaving);
  void clear_emissions();
  void invalidate(const std::vector<scene::Bounds>& moved);

  /// Whether any sun's maps follow the view.
  bool any_sun() const;
  /// Brings buffers up to date and fits the sun's cascades to the view, by the depths of what is seen.
  void prepare(const scene::CameraPose& camera, float aspect, const Seen& seen, const scene::Bounds& bounds,
               FrameCounters& counters);
  int update_maps(const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, gl::Program* glass,
                  int most, int& waiting, FrameCounters& counters);
  void invalidate_all() {
    for (MapAtlas* atlas : {&lamps_, &areas_, &suns_, &skies_}) atlas->invalidate_all();
  }
  /// Call it after update_maps.
  void update_bounds(Shaders& shaders, const gl::VertexArray& no_vertices, FrameCounters& counters) {
    if (bounds_) bounds_->update(suns_, shaders, no_vertices, counters);
  }
  /// Everything but an emitter itself and its parallel maps.
  void bind() const;

  /// Those that shine now.
  struct Lit {
    EmitterKind kind;
    int emitter;
    bool seen;     ///< is no surface, and looked at directly
    bool lights;   ///< surfaces
    bool mirrors;  ///< what glossy surfaces mirror of it is all that lights them
  };
  const std::vector<Lit>& lit() const { return lit_; }
  void bind_emitter(const Lit& lit) const;
  const MapAtlas& lamp_maps() const { return lamps_; }
  const MapAtlas& area_maps() const { return areas_; }
  float near_plane() const { return near_; }
  /// Whether the environment, or that there is none, is that of the lights that these were made after.
  bool same_sky() const { return same_sky_; }
  const scene::Environment* environment() const { return environment_ ? &*environment_ : nullptr; }
  /// In place of the scene's own image; null: that one.
  const std::shared_ptr<const image::Image>& other_environment() const { return other_image_; }
  /// About +y, the scene's own rotation included [rad].
  float environment_rotation() const { return environment_ ? environment_->rotation + turn_ : 0; }
  std::size_t bytes() const;

 private:
  struct Source {
    int emitter;
    int group;
    int light = -1;                 ///< of scene.lights
    int node = -1;                  ///< of an emissive mesh
    vec3 radiance{0};               ///< mean of a mesh's
    std::vector<AreaPoint> points;  ///< in the space of the light or mesh
    std::vector<vec3> parts;        ///< of a sun: directions toward them, its middle at +z
    std::vector<vec3> corners;      ///< of triangles with a closed form, likewise
    std::optional<Ball> ball;       ///< of a mesh of more triangles that is one, likewise
    mat4 placed{0};                 ///< pose of what is in the buffers
    int first_map;
    bool left_out = false;
    bool mirrored = false;  ///< by what is glossy, though left out
    bool lights() const { return !left_out || mirrored; }
  };
  bool is_sun(const Source& source) const;
  static int most_sun_parts(const scene::Scene& scene, const RendererParams& params);
  void add_lights(const scene::Scene& scene, float time, const std::vector<mat4>& world,
                  const std::vector<std::string>& groups, const RendererParams& params);
  /// Points and, of even emission, corners of a mesh that stands at `placed`, and its map slots.
  void shape_as_mesh(Source& source, GpuEmitter& e, const scene::Mesh& mesh, const mat4& placed, bool even,
                     const RendererParams& params);
  void add_meshes(const scene::Scene& scene, const std::vector<mat4>& world,
                  const std::vector<std::string>& groups, const RendererParams& params);
  void add_environment(const scene::Scene& scene, const std::vector<std::string>& groups, int samples,
                       const Lights* before);
  void place(Source& source, const mat4& world);
  void place_samples(Source& source, const mat4& world);
  void point_sun(const Source& source, const vec3& axis, float radius);
  void place_sun(const Source& source, const scene::CameraPose& camera, float aspect, const Seen& seen,
                 const scene::Bounds& bounds);
  void find_environment();
  void show_directions();
  void place_all(const std::vector<mat4>& world);
  bool same_lamp_maps(const Lights& other) const { return lamp_slots_ == other.lamp_slots_; }
  bool same_area_maps(const Lights& other) const { return area_slots_ == other.area_slots_; }
  bool same_sun_maps(const Lights& other) const {
    return sun_slots_ == other.sun_slots_ && bounded_ == other.bounded_;
  }
  bool same_sky_maps(const Lights& other) const { return sky_slots_ == other.sky_slots_; }
  void turn_environment();
  void place_environment(const scene::Bounds& bounds);
  void set_colors();
  void list_lit();
  void want_maps(const Source& source);
  void upload_emitters(FrameCounters& counters);
  void set_parallel(int map, const vec3& forward, const vec3& center, float radius,
                    const scene::Bounds& bounds);

  std::vector<scene::Light> lights_;
  std::vector<scene::LightState> states_;
  std::vector<vec3> scales_;
  std::vector<std::string> groups_;
  std::optional<scene::Environment> environment_;    ///< as it is now
  image::Image own_environment_;                     ///< the scene's image
  std::shared_ptr<const image::Image> other_image_;  ///< in place of it; null: none
  int environment_samples_ = 0;                      ///< directions at most
  std::vector<EnvironmentSample> directions_;        ///< by the scene's own rotation
  sh::IrradianceSh sky_irradiance_;                  ///< likewise
  float turn_ = 0;                                   ///< of the environment beyond it [rad]
  std::vector<Source> sources_;
  std::vector<GpuEmitter> emitters_;  ///< of sources_, then of probes
  std::vector<GpuEmitter> uploaded_;  ///< as they stand in the buffer
  std::vector<Lit> lit_;
  DistantBlock distant_{};
  /// What each cascade was last drawn for.
  struct ParallelKey {
    vec3 forward, center;
    float radius;
    friend bool operator==(const ParallelKey&, const ParallelKey&) = default;
  };
  std::vector<std::optional<ParallelKey>> sun_key_;
  int lamp_slots_ = 0, area_slots_ = 0, sun_slots_ = 0, sky_slots_ = 0, scene_emitters_ = 0;
  int bounded_ = 0;        ///< cascades up to the last of a sun with an extent
  bool same_sky_ = false;  ///< as the lights of before
  scene::Bounds bounds_of_scene_;
  float near_;
  MapAtlas lamps_, areas_, suns_, skies_;
  LampProfiles profiles_;
  std::optional<DepthBounds> bounds_;  ///< of maps of suns with an extent
  gl::Buffer emitter_buffer_, distant_buffer_;
  bool emitters_changed_ = true, distant_changed_ = true;
  scene::Bounds sun_bounds_, environment_bounds_;
};

}  // namespace ssphh::realtime
