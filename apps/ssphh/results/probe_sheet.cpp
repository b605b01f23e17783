#include "results/probe_sheet.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/sh/reconstruct.h>

namespace ssphh::app {
namespace {

constexpr int gap = 4;

/// Directions of the pixels of one picture, row by row.
std::vector<vec3> pixel_directions(int width, int height) {
  std::vector<vec3> directions;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      directions.push_back(
          image::equirect_direction((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                    (static_cast<float>(y) + 0.5f) / static_cast<float>(height)));
    }
  }
  return directions;
}

/// EV that puts the 99th percentile of the brightest channel at 0.8; 0 when all is dark.
float automatic_exposure(const std::vector<std::vector<vec3>>& pictures) {
  std::vector<float> levels;
  for (const auto& picture : pictures) {
    for (const vec3& color : picture) levels.push_back(max_component(color));
  }
  if (levels.empty()) return 0;
  const auto at = levels.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(levels.size() - 1));
  std::nth_element(levels.begin(), at, levels.end());
  return *at > 0 ? std::log2(0.8f / *at) : 0;
}

}  // namespace

ProbeSheet probe_sheet(const probes::ProbeSet& set, int width, float exposure) {
  if (set.probes.empty()) throw Error("probe preview", "the file holds no probes");
  const int height = width / 2, rows = static_cast<int>(set.probes.size());
  const int column_count = set.hierarchy ? 3 : 1;
  const std::int64_t pixels = std::int64_t{column_count} * (width + gap) * rows * (height + gap);
  if (pixels > std::int64_t{1} << 28)
    throw Error("probe preview", "the sheet would be too large", "lower --width");

  // Evaluate every picture.
  const std::vector<vec3> directions = pixel_directions(width, height);
  std::vector<std::vector<std::vector<vec3>>> pictures(static_cast<std::size_t>(column_count));
  for (auto& column : pictures) column.resize(set.probes.size());
  parallel_for(set.probes.size(), 1, [&](std::size_t i) {
    for (std::size_t c = 0; c < pictures.size(); ++c) {
      const sh::RadianceSh& light = c == 0   ? set.probes[i].self
                                    : c == 1 ? set.hierarchy->neighbor[i]
                                             : set.hierarchy->sum[i];
      pictures[c][i].resize(directions.size());
      sh::eval(light, directions, pictures[c][i]);
    }
  });

  // Self and sum share an exposure, so that they can be compared.
  ProbeSheet sheet;
  const float own = automatic_exposure(pictures.back()) + exposure;
  sheet.columns.push_back({"self", own});
  if (set.hierarchy) {
    sheet.columns.push_back({"neighbour", automatic_exposure(pictures[1]) + exposure});
    sheet.columns.push_back({"sum", own});
  }
  sheet.image = image::Image(column_count * (width + gap) - gap, rows * (height + gap) - gap);
  std::ranges::fill(sheet.image.pixels, 0.5f);
  for (int c = 0; c < column_count; ++c) {
    const float factor = std::exp2(sheet.columns[static_cast<std::size_t>(c)].exposure);
    for (int row = 0; row < rows; ++row) {
      const vec3* color = pictures[static_cast<std::size_t>(c)][static_cast<std::size_t>(row)].data();
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          sheet.image.set_rgb(c * (width + gap) + x, row * (height + gap) + y,
                              glm::max(factor * *color++, vec3(0)));
        }
      }
    }
  }
  return sheet;
}

}  // namespace ssphh::app
