#include "one_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ssphh::metrics {
namespace {

using image::Image;

constexpr float least_cosine = 0.985f;  ///< of normals of neighbours: 10°
constexpr float least_length = 0.99f;   ///< of a pixel's mean normal: else two surfaces share it
constexpr float depth_jump = 0.003f;    ///< of inverse depth beyond its slope, relative

/// Inverse depth, linear over the picture on a plane; 0 where nothing stands.
float inverse(const Image& depth, int x, int y) {
  const float d = depth.at(x, y)[0];
  return d > 0 && std::isfinite(d) ? 1 / d : 0;
}

/// Whether b continues a, two neighbours `step` apart: held against the slope before and the slope after, of
/// which one is right beside another jump.
bool depth_continues(const Image& depth, int x, int y, int dx, int dy) {
  const float a = inverse(depth, x, y), b = inverse(depth, x + dx, y + dy);
  if (a == 0 || b == 0) return false;
  float jump = std::abs(b - a);
  if (x - dx >= 0 && y - dy >= 0)
    jump = std::min(jump, std::abs(b - (2 * a - inverse(depth, x - dx, y - dy))));
  if (x + 2 * dx < depth.width && y + 2 * dy < depth.height)
    jump = std::min(jump, std::abs(a - (2 * b - inverse(depth, x + 2 * dx, y + 2 * dy))));
  return jump <= depth_jump * std::min(a, b);
}

struct Sets {
  std::vector<std::uint32_t> parent;

  std::uint32_t root(std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  /// The smaller number stays: no order of calls changes the outcome.
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
};

}  // namespace

std::vector<std::uint32_t> one_surface(const std::vector<std::uint8_t>& usable, int width, int height,
                                       const Image& normal, const Image& depth) {
  const auto index = [&](int x, int y) { return static_cast<std::uint32_t>(y * width + x); };
  const auto is_usable = [&](int x, int y) {
    return usable[index(x, y)] && (normal.empty() || glm::length(normal.rgb(x, y)) >= least_length);
  };
  Sets sets;
  sets.parent.resize(usable.size());
  std::iota(sets.parent.begin(), sets.parent.end(), 0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!is_usable(x, y)) continue;
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}}) {
        if (x + dx >= width || y + dy >= height || !is_usable(x + dx, y + dy)) continue;
        if (!normal.empty() && glm::dot(normal.rgb(x, y), normal.rgb(x + dx, y + dy)) < least_cosine)
          continue;
        if (!depth.empty() && !depth_continues(depth, x, y, dx, dy)) continue;
        sets.join(index(x, y), index(x + dx, y + dy));
      }
    }
  }
  std::vector<std::uint32_t> surface(usable.size(), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (is_usable(x, y)) surface[index(x, y)] = sets.root(index(x, y)) + 1;
  return surface;
}

}  // namespace ssphh::metrics
