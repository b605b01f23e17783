#pragma once
/// Voxel cone tracing in OpenGL: the pyramid as a dense 3-D texture.

#include <ssphh/gl/volume.h>

#include "method_light.h"
#include "method_types.h"
#include "volume_layout.h"

namespace ssphh::realtime {

class VoxelLight final : public MethodLight {
 public:
  /// Throws Error when the volume would take more than `most_bytes`.
  VoxelLight(const methods::VoxelCones& data, std::size_t most_bytes, FrameCounters& counters);

  MethodKind kind() const override { return MethodKind::cones; }
  bool take(const methods::LightData& data, FrameCounters& counters) override;
  int passes() const override { return 1; }
  void bind(gl::Program& program, int pass) const override;
  std::size_t bytes() const override;
  methods::MethodNumbers numbers() const override;

 private:
  void upload_all(const methods::VoxelCones& data, FrameCounters& counters);
  void upload_level(const methods::vct::Pyramid& voxels, int level, float scale, FrameCounters& counters);

  VolumeLayout layout_;
  gl::Volume volume_;
  gl::Buffer block_, cones_;
  int cone_count_ = 0;
  std::vector<std::uint64_t> slab_;  ///< of each side four layers of a level, while they are made
};

}  // namespace ssphh::realtime
