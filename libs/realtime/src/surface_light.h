#pragma once
/// Light at points of still surfaces in OpenGL's memory, and which of them light a surface: what
/// fitted_lookup.glsl reads.

#include <array>
#include <span>
#include <vector>

#include <ssphh/core/parallel.h>
#include <ssphh/gl/program.h>
#include <ssphh/gl/texture.h>
#include <ssphh/probes/surface_lists.h>

#include "upload_count.h"

namespace ssphh::realtime {

class SurfaceLight {
 public:
  /// What is kept of a point's irradiance: coefficients of bands 0 to 2, and what the rest adds at the
  /// point's own normal.
  using Coefficients = std::array<vec3, 10>;

  /// Uploads the lists.
  SurfaceLight(const probes::SurfaceLists& lists, FrameCounters& counters);

  /// New light of some points, ascending; `coefficients(point)` is called from several threads.
  template <class Function>
  void update(std::span<const std::uint32_t> points, const Function& coefficients, FrameCounters& counters) {
    texels_.resize(points.size() * point_texels);
    parallel_for(points.size(), 256, [&](std::size_t i) {
      pack(coefficients(points[i]), std::span(texels_).subspan(i * point_texels, point_texels));
    });
    upload(points, counters);
  }
  void bind(gl::Program& program) const;
  std::size_t count() const { return count_; }
  std::size_t bytes() const;

 private:
  /// Ten numbers for each colour as halves.
  static constexpr std::size_t point_texels = 4;
  static void pack(const Coefficients& light, std::span<glm::uvec4> texels);
  void upload(std::span<const std::uint32_t> points, FrameCounters& counters);

  std::size_t count_;
  std::array<probes::SurfaceGrid, 2> grids_;
  std::vector<glm::uvec4> texels_;
  gl::Texture ranges_, lists_, places_, light_;
};

}  // namespace ssphh::realtime
