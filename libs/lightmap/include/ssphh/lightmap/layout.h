#pragma once
/// Where charts lie in the atlas.

#include <optional>
#include <span>

#include <ssphh/lightmap/chart.h>
#include <ssphh/lightmap/pack.h>

namespace ssphh::lightmap {

/// Texels around each chart that hold its light, too: filters of charts beside each other do not meet.
inline constexpr int gutter = 2;
inline constexpr int most_size = 8192;
/// Texels per metre for which no larger atlas is taken unasked.
inline constexpr float enough_density = 8;

/// A chart in the atlas. Its border passes through the centres of the first and the last texel of both axes.
struct PlacedChart {
  glm::ivec2 first{0};  ///< texel whose centre is the chart's least corner
  glm::ivec2 count{2};  ///< texels that the chart spans; the gutter lies around them
  vec2 scale{1};        ///< texels per metre along each axis

  /// In texels from the atlas' upper left corner; the centre of the first texel is at (0.5, 0.5).
  vec2 texel(const vec2& at) const { return vec2(first) + 0.5f + at * scale; }
};

struct Layout {
  int width = 0, height = 0;  ///< texels
  float density = 0;          ///< texels per metre that were asked for or found, of charts without halvings
  std::vector<PlacedChart> places;
};

struct LayoutParams {
  /// Width and most height [texels]. None: the smallest of 1024, 2048 and 4096 that gives 8 texels a metre,
  /// or of the powers of two that holds the density asked for.
  std::optional<int> size = {};
  std::optional<float> density = {};  ///< texels per metre; none: as many as fit
  int least = 4;                      ///< texels at least along a chart's longer side, however small it is
};

/// Whether the smallest atlas that may be taken unasked, or the one asked for, holds the charts at the
/// density asked for, or at enough_density; of a density without a size, the largest atlas there is.
bool is_dense_enough(std::span<const Chart> charts, const LayoutParams& params);

/// Throws Error, before memory is taken, where the charts do not fit, with a size or a density that does.
Layout lay_out(std::span<const Chart> charts, const LayoutParams& params = {});

}  // namespace ssphh::lightmap
