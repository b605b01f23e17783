#pragma once
/// Virtual lights in OpenGL: each with a cube shadow map.

#include "method_light.h"
#include "method_types.h"

namespace ssphh::realtime {

/// How many virtual lights get maps, and how large.
struct VirtualMapPlan {
  int size = 0;    ///< texels of a face
  int lights = 0;  ///< at most as many as there are
};

/// The largest face, a power of two of 32..256 texels, with which all lights' maps fit into `most_bytes`; at
/// 32, as many lights as do.
VirtualMapPlan plan_virtual_maps(std::size_t lights, std::size_t most_bytes);

class VirtualLightMaps final : public MethodLight {
 public:
  /// More lights than have room for maps are merged (methods::vpl::merge_lights). Throws Error where not even
  /// one has room.
  VirtualLightMaps(const methods::VirtualLights& data, std::size_t most_bytes, const scene::Bounds& bounds,
                   FrameCounters& counters);

  MethodKind kind() const override { return MethodKind::virtual_lights; }
  bool take(const methods::LightData& data, FrameCounters& counters) override;
  void invalidate(const std::vector<scene::Bounds>& moved) override { maps_.invalidate(moved); }
  int update_maps(const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, int most, int& waiting,
                  FrameCounters& counters) override {
    return maps_.update(scene, opaque, alpha, most, waiting, counters);
  }
  int passes() const override;
  void bind(gl::Program& program, int pass) const override;
  std::size_t bytes() const override { return maps_.bytes() + buffer_.size(); }
  methods::MethodNumbers numbers() const override;

 private:
  void place(std::size_t light);

  std::size_t most_bytes_;
  float near_;
  methods::vpl::VplParams params_;
  std::vector<methods::vpl::Vpl> lights_;  ///< as drawn
  MapAtlas maps_;
  gl::Buffer buffer_;
};

}  // namespace ssphh::realtime
