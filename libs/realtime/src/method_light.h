#pragma once
/// Indirect light of another method than SPHLs, in OpenGL's memory: what takes the place of the probes' pass.

#include <memory>

#include <ssphh/methods/method.h>
#include <ssphh/realtime/renderer.h>

#include "shadow_maps.h"

namespace ssphh::realtime {

class MethodLight {
 public:
  virtual ~MethodLight() = default;

  virtual MethodKind kind() const = 0;
  /// New data of the same kind, keeping what still holds; false: a new object must be made for it.
  virtual bool take(const methods::LightData& data, FrameCounters& counters) = 0;

  /// Something in these boxes moved.
  virtual void invalidate(const std::vector<scene::Bounds>& /*moved*/) {}
  /// As MapAtlas::update.
  virtual int update_maps(const GpuScene& /*scene*/, gl::Program& /*opaque*/, gl::Program& /*alpha*/,
                          int /*most*/, int& /*waiting*/, FrameCounters& /*counters*/) {
    return 0;
  }

  /// Full-screen passes, which add up to the light.
  virtual int passes() const = 0;
  /// For pass `pass` with this program.
  virtual void bind(gl::Program& program, int pass) const = 0;

  virtual std::size_t bytes() const = 0;
  virtual methods::MethodNumbers numbers() const = 0;
};

/// Throws Error for data that OpenGL cannot look up or that does not fit into the memory of `params`.
std::unique_ptr<MethodLight> make_method_light(const methods::LightData& data, const RendererParams& params,
                                               const scene::Bounds& bounds, FrameCounters& counters);

}  // namespace ssphh::realtime
