#include "fitted_light.h"

#include <array>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <ssphh/core/parallel.h>
#include <ssphh/sh/evaluate.h>

#include "gpu_types.h"

namespace ssphh::realtime {
namespace {

constexpr std::size_t width = 2048;  // CELLS_WIDTH_LOG2 of probe_lookup.glsl
/// A point's texels: ten numbers for each colour as halves. Nine are the coefficients of bands 0 to 2, one
/// what the rest adds at the point's own normal.
constexpr std::size_t point_texels = 4, functions = 10, low_bands = 9;

/// Rows of `width` texels.
template <class T>
gl::Texture list_texture(gl::Format format, std::vector<T> texels, FrameCounters& counters) {
  texels.resize(std::max<std::size_t>((texels.size() + width - 1) / width, 1) * width, T(0));
  gl::Texture texture(format, static_cast<int>(width), static_cast<int>(texels.size() / width));
  texture.upload(std::as_bytes(std::span<const T>(texels)));
  counters.bytes_uploaded += texels.size() * sizeof(T);
  return texture;
}

}  // namespace

FittedLight::FittedLight(const probes::FittedSurfaces& surfaces, int probe_count, FrameCounters& counters)
    : points_(surfaces.points),
      spacing_(surfaces.spacing),
      cell_size_(surfaces.cell_size),
      origin_(surfaces.origin),
      cells_(surfaces.cells) {
  probes::require_whole(points_, static_cast<std::size_t>(probe_count));
  first_of_probe_.assign(static_cast<std::size_t>(probe_count) + 1, 0);
  for (std::size_t i = 0; i < points_.points.size(); ++i) {
    for (const probes::ProbeWeight& weight : points_.weights[i].used())
      ++first_of_probe_[static_cast<std::size_t>(weight.probe) + 1];
  }
  for (std::size_t p = 0; p + 1 < first_of_probe_.size(); ++p) first_of_probe_[p + 1] += first_of_probe_[p];
  lit_by_.resize(first_of_probe_.back());
  std::vector<std::size_t> next = first_of_probe_;
  for (std::size_t i = 0; i < points_.points.size(); ++i) {
    for (const probes::ProbeWeight& weight : points_.weights[i].used())
      lit_by_[next[static_cast<std::size_t>(weight.probe)]++] = static_cast<std::uint32_t>(i);
  }
  marked_.assign(points_.points.size(), 0);
  ranges_ = list_texture(gl::Format::rg32ui, surfaces.ranges, counters);
  lists_ = list_texture(gl::Format::rgba32ui, surfaces.lists, counters);
  const std::size_t rows = (points_.points.size() * point_texels + width - 1) / width;
  light_ = gl::Texture(gl::Format::rgba32ui, static_cast<int>(width), static_cast<int>(rows));
}

void FittedLight::update(std::span<const int> probes, std::span<const vec3> irradiance, std::size_t count,
                         FrameCounters& counters) {
  changed_.clear();
  for (const int probe : probes) {
    const auto p = static_cast<std::size_t>(probe);
    for (std::size_t i = first_of_probe_[p]; i < first_of_probe_[p + 1]; ++i) {
      if (marked_[lit_by_[i]]) continue;
      marked_[lit_by_[i]] = 1;
      changed_.push_back(lit_by_[i]);
    }
  }
  std::sort(changed_.begin(), changed_.end());
  texels_.resize(changed_.size() * point_texels);
  parallel_for(changed_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      marked_[changed_[i]] = 0;
      evaluate(changed_[i], irradiance, count, std::span(texels_).subspan(i * point_texels, point_texels));
    }
  });
  upload_changed(counters);
}

void FittedLight::evaluate(std::size_t point, std::span<const vec3> irradiance, std::size_t count,
                           std::span<uvec4> texels) const {
  std::array<vec3, 25> sum{};
  for (const probes::ProbeWeight& weight : points_.weights[point].used()) {
    const vec3* e = irradiance.data() + static_cast<std::size_t>(weight.probe) * count;
    for (std::size_t k = 0; k < count; ++k) sum[k] += weight.weight * e[k];
  }
  std::array<float, 25> basis;
  sh::eval_basis(4, points_.points[point].normal, basis);
  std::array<vec3, functions> kept;
  std::copy_n(sum.begin(), low_bands, kept.begin());
  kept[low_bands] = vec3(0);
  for (std::size_t k = low_bands; k < count; ++k) kept[low_bands] += basis[k] * sum[k];
  for (int c = 0; c < 3; ++c) {
    for (std::size_t pair = 0; pair < functions / 2; ++pair) {
      const std::size_t word = static_cast<std::size_t>(c) * (functions / 2) + pair;
      const vec2 two(kept[2 * pair][c], kept[2 * pair + 1][c]);
      texels[word / 4][static_cast<int>(word % 4)] =
          glm::packHalf2x16(glm::clamp(two, -largest_half, largest_half));
    }
  }
}

void FittedLight::upload_changed(FrameCounters& counters) {
  constexpr std::size_t row_points = width / point_texels;
  for (std::size_t begin = 0, end; begin < changed_.size(); begin = end) {
    // Neighbours in a row go together
    end = begin + 1;
    const std::size_t first = changed_[begin];
    while (end < changed_.size() && changed_[end] == first + (end - begin) &&
           changed_[end] / row_points == first / row_points)
      ++end;
    const auto run =
        std::span<const uvec4>(texels_).subspan(begin * point_texels, (end - begin) * point_texels);
    light_.upload_rect(std::as_bytes(run), static_cast<int>(first % row_points * point_texels),
                       static_cast<int>(first / row_points), static_cast<int>(run.size()), 1);
    counters.bytes_uploaded += run.size_bytes();
  }
}

void FittedLight::bind(gl::Program& program) const {
  ranges_.bind(unit::fitted_ranges);
  lists_.bind(unit::fitted_lists);
  light_.bind(unit::fitted_light);
  program.set("fitted_origin", vec4(origin_, cell_size_));
  program.set("fitted_cells", cells_.x, cells_.y, cells_.z);
  program.set("fitted_spacing", spacing_);
}

std::size_t FittedLight::bytes() const {
  return ranges_.bytes() + lists_.bytes() + light_.bytes();
}

}  // namespace ssphh::realtime
