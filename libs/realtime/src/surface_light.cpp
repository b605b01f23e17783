#include "surface_light.h"

#include <glm/gtc/packing.hpp>

#include <ssphh/core/octahedral.h>

#include "gpu_types.h"

namespace ssphh::realtime {
namespace {

constexpr std::size_t width = list_width;

/// Rows of `width` texels.
template <class T>
gl::Texture list_texture(gl::Format format, std::vector<T> texels, FrameCounters& counters) {
  texels.resize(std::max<std::size_t>((texels.size() + width - 1) / width, 1) * width, T(0));
  gl::Texture texture(format, static_cast<int>(width), static_cast<int>(texels.size() / width));
  texture.upload(std::as_bytes(std::span<const T>(texels)));
  counters.bytes_uploaded += texels.size() * sizeof(T);
  return texture;
}

/// Of each point its position, and its normal on the octahedral map.
std::vector<glm::uvec4> places_of(std::span<const rays::SurfacePoint> points) {
  std::vector<glm::uvec4> places;
  for (const rays::SurfacePoint& point : points)
    places.emplace_back(glm::floatBitsToUint(point.position),
                        glm::packSnorm2x16(octahedral_place(point.normal)));
  return places;
}

}  // namespace

SurfaceLight::SurfaceLight(const probes::SurfaceLists& lists, FrameCounters& counters)
    : count_(lists.points.size()),
      grids_(lists.grids),
      ranges_(list_texture(gl::Format::rg32ui, lists.ranges, counters)),
      lists_(list_texture(gl::Format::rgba32ui, lists.lists, counters)),
      places_(list_texture(gl::Format::rgba32ui, places_of(lists.points), counters)) {
  const std::size_t rows = (count_ * point_texels + width - 1) / width;
  light_ = gl::Texture(gl::Format::rgba32ui, static_cast<int>(width), static_cast<int>(rows));
}

void SurfaceLight::pack(const Coefficients& light, std::span<glm::uvec4> texels) {
  constexpr std::size_t pairs = std::tuple_size_v<Coefficients> / 2;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t pair = 0; pair < pairs; ++pair) {
      const std::size_t word = static_cast<std::size_t>(c) * pairs + pair;
      const vec2 two(light[2 * pair][c], light[2 * pair + 1][c]);
      texels[word / 4][static_cast<int>(word % 4)] =
          glm::packHalf2x16(glm::clamp(two, -largest_half, largest_half));
    }
  }
}

void SurfaceLight::upload(std::span<const std::uint32_t> points, FrameCounters& counters) {
  constexpr std::size_t row_points = width / point_texels;
  for (std::size_t begin = 0, end; begin < points.size(); begin = end) {
    // Neighbours in a row go together
    end = begin + 1;
    const std::size_t first = points[begin];
    while (end < points.size() && points[end] == first + (end - begin) &&
           points[end] / row_points == first / row_points)
      ++end;
    const auto run =
        std::span<const glm::uvec4>(texels_).subspan(begin * point_texels, (end - begin) * point_texels);
    light_.upload_rect(std::as_bytes(run), static_cast<int>(first % row_points * point_texels),
                       static_cast<int>(first / row_points), static_cast<int>(run.size()), 1);
    counters.bytes_uploaded += run.size_bytes();
  }
}

void SurfaceLight::bind(gl::Program& program) const {
  ranges_.bind(unit::fitted_ranges);
  lists_.bind(unit::fitted_lists);
  places_.bind(unit::fitted_points);
  light_.bind(unit::fitted_light);
  const auto set = [&](const char* origin, const char* cells, const probes::SurfaceGrid& grid) {
    program.set(origin, vec4(grid.origin, grid.cell_size));
    program.set(cells, grid.cells.x, grid.cells.y, grid.cells.z, static_cast<int>(grid.first));
  };
  set("fitted_origin", "fitted_cells", grids_[0]);
  set("fitted_far_origin", "fitted_far_cells", grids_[1]);
}

std::size_t SurfaceLight::bytes() const {
  return ranges_.bytes() + lists_.bytes() + places_.bytes() + light_.bytes();
}

}  // namespace ssphh::realtime
