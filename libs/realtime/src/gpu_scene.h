#pragma once
/// A scene's geometry, materials and textures in OpenGL's memory.

#include <array>
#include <map>
#include <span>
#include <vector>

#include <ssphh/gl/draw.h>
#include <ssphh/gl/texture.h>
#include <ssphh/scene/query.h>

#include "gpu_meshes.h"
#include "gpu_types.h"
#include "upload_count.h"

namespace ssphh::realtime {

/// What is drawn in one call: a piece of an instance, small enough that leaving it out saves something.
struct DrawItem {
  int instance, material;
  int surface_class;
  std::size_t arrays;  ///< of its mesh
  int index_count, base_vertex;
  std::size_t first_index;
  scene::Bounds local, world;
  bool partial;          ///< may be covered in part only
  int textures;          ///< those that its material reads: a bit for each of Shaders::texture_names
  bool glass = false;    ///< light may go through it
  bool bends = false;    ///< and is bent, as it is a body
  bool frosted = false;  ///< and is spread, as it is a rough sheet

  /// Whether light may pass some of it.
  bool filters() const { return partial || glass; }
};

class GpuScene {
 public:
  /// `engines`: meshes that are in OpenGL's memory already. `anisotropy`: samples of a texture at a slant at
  /// most.
  GpuScene(const scene::Scene& scene, std::span<const MeshBuffers> engines, const std::vector<mat4>& world,
           float anisotropy, FrameCounters& counters);

  /// Poses instances; adds the boxes of what moved, before and after.
  void pose(const std::vector<mat4>& world, std::vector<scene::Bounds>& moved, FrameCounters& counters);
  void set_material(int index, const scene::Material& material, FrameCounters& counters);
  void set_group_scale(int group, const vec3& scale, FrameCounters& counters);
  /// Instances as `scene` numbers their light groups, each with its factor of `scales`.
  void set_groups(const scene::Scene& scene, const std::vector<vec3>& scales, FrameCounters& counters);
  /// Whether its instances stand at the same nodes of `scene`.
  bool stands_in(const scene::Scene& scene) const;

  const std::vector<DrawItem>& items() const { return items_; }
  const scene::Bounds& bounds() const { return bounds_; }
  std::size_t bytes() const { return bytes_; }

  /// Whether anything but glass, which has passes of its own, reflects otherwise than Lambert's law says.
  bool any_full() const { return any_full_; }
  bool any_glass() const { return any_glass_; }
  /// Whether any body of glass absorbs light on its way through it.
  bool any_absorbs() const { return any_absorbs_; }
  /// Whether any shows what is behind it elsewhere.
  bool any_bends() const { return any_bends_; }
  /// Whether any spreads it.
  bool any_frosted() const { return any_frosted_; }

  /// Then draw() what is wanted, in the order of items() for few changes of state. `program`
  /// is the one in use.
  void begin(bool positions_only) const;
  void draw(const DrawItem& item, bool textures, FrameCounters& counters) const;

 private:
  enum class GlassKind { none, some, everywhere };
  enum class TextureKind { numbers, color, color_and_coverage };
  /// Of what each instance emits; −1: nothing.
  static std::vector<int> groups_of(const scene::Scene& scene);
  static GlassKind glass_kind(const scene::Material& material);
  struct Slot {
    unsigned unit;
    int texture, sampler;  ///< −1: white
  };
  void add_textures(const scene::Scene& scene, FrameCounters& counters);
  int texture_for(const scene::Scene& scene, int texture, TextureKind kind, FrameCounters& counters);
  int sampler_for(const scene::TextureUse& use);
  void classify(const std::vector<scene::Material>& materials);
  void bind_material(int material) const;

  std::vector<DrawItem> items_;
  std::vector<GpuInstance> instances_;
  std::vector<int> nodes_, groups_;  ///< of each instance
  std::vector<GpuMaterial> materials_;
  std::vector<int> classes_;                ///< of each material
  std::vector<GlassKind> glass_;            ///< of each material
  std::vector<std::array<Slot, 5>> slots_;  ///< of each material
  std::map<std::pair<int, TextureKind>, int> texture_index_;
  std::map<int, int> sampler_index_;
  std::vector<gl::Texture> textures_;
  std::vector<gl::Sampler> samplers_;
  gl::Texture white_;
  GpuMeshes meshes_;
  gl::Buffer material_buffer_, instance_buffer_;
  scene::Bounds bounds_;
  float anisotropy_;
  std::size_t bytes_ = 0;
  bool any_full_ = false, any_glass_ = false, any_absorbs_ = false, any_bends_ = false, any_frosted_ = false;
  // Since begin(); below 0: none
  mutable int bound_material_, bound_instance_;
  mutable const MeshArrays* bound_arrays_;
  mutable bool positions_only_;
};

}  // namespace ssphh::realtime
