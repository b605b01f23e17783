#pragma once
/// Light at fitted points in OpenGL's memory, and which of them light a surface: what fitted_lookup.glsl
/// reads.

#include <span>
#include <vector>

#include <ssphh/gl/program.h>
#include <ssphh/gl/texture.h>
#include <ssphh/probes/fitted_surfaces.h>

#include "upload_count.h"

namespace ssphh::realtime {

class FittedLight {
 public:
  /// Uploads the lists. Throws Error for points that name a probe which there is not.
  FittedLight(const probes::FittedSurfaces& surfaces, int probe_count, FrameCounters& counters);

  /// New irradiance of some probes: evaluates the points that any of them lights. `irradiance` holds `count`
  /// coefficients, 25 at most, for each probe of the set, those changed or not.
  void update(std::span<const int> probes, std::span<const vec3> irradiance, std::size_t count,
              FrameCounters& counters);
  void bind(gl::Program& program) const;
  std::size_t bytes() const;

 private:
  void evaluate(std::size_t point, std::span<const vec3> irradiance, std::size_t count,
                std::span<glm::uvec4> texels) const;
  void upload_changed(FrameCounters& counters);

  probes::FittedPoints points_;
  float spacing_, cell_size_;
  vec3 origin_;
  glm::ivec3 cells_;
  std::vector<std::size_t> first_of_probe_;  ///< in lit_by_: points that each probe lights
  std::vector<std::uint32_t> lit_by_;
  std::vector<unsigned char> marked_;  ///< points, while an update gathers them
  std::vector<std::uint32_t> changed_;
  std::vector<glm::uvec4> texels_;
  gl::Texture ranges_, lists_, light_;
};

}  // namespace ssphh::realtime
