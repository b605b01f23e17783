#include "results/light_table.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/sh/reconstruct.h>

#include "results/label.h"

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

LightTable light_table(const std::vector<LightColumn>& columns, int width, float exposure) {
  const int height = width / 2, count = static_cast<int>(columns.size());
  const int rows = static_cast<int>(columns.front().lights.size());
  const int above = columns.front().labels.empty() ? 0 : label_height() + 2, step = above + height + gap;
  const std::int64_t pixels = std::int64_t{count} * (width + gap) * rows * step;
  if (pixels > std::int64_t{1} << 28)
    throw Error("probe preview", "the sheet would be too large", "lower --width");

  // Evaluate every picture.
  const std::vector<vec3> directions = pixel_directions(width, height);
  std::vector<std::vector<std::vector<vec3>>> pictures(columns.size());
  for (auto& column : pictures) column.resize(static_cast<std::size_t>(rows));
  parallel_for(static_cast<std::size_t>(rows), 1, [&](std::size_t i) {
    for (std::size_t c = 0; c < pictures.size(); ++c) {
      pictures[c][i].resize(directions.size());
      sh::eval(*columns[c].lights[i], directions, pictures[c][i]);
    }
  });

  LightTable table;
  std::vector<float> automatic;
  for (const auto& column : pictures) automatic.push_back(automatic_exposure(column));
  table.image = image::Image(count * (width + gap) - gap, rows * step - gap);
  std::ranges::fill(table.image.pixels, 0.5f);
  for (int c = 0; c < count; ++c) {
    const LightColumn& column = columns[c];
    table.exposures.push_back(automatic[column.exposed_as] + exposure);
    const float factor = std::exp2(table.exposures.back());
    for (int row = 0; row < rows; ++row) {
      const auto r = static_cast<std::size_t>(row);
      const int left = c * (width + gap), top = row * step + above;
      if (above > 0) write_label(table.image, left, row * step + 1, width, column.labels[r], vec3(0));
      const vec3* color = pictures[c][r].data();
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
          table.image.set_rgb(left + x, top + y, glm::max(factor * *color++, vec3(0)));
      }
    }
  }
  return table;
}

}  // namespace ssphh::app
