#include <algorithm>
#include <cmath>

#include <ssphh/methods/vct/cones.h>
#include <ssphh/sh/zonal.h>

namespace ssphh::methods::vct {
namespace {

/// Cells of each ring of a disk, from the middle out: `count` in all, close to square.
std::vector<int> rings(int count) {
  std::vector<int> inside{count};  // cells within each circle, from the rim in
  double radius = std::sqrt(count);
  while (inside.back() > 1) {
    radius -= std::sqrt(pi_d) * 0.9;  // a cell has area π, and somewhat more length across than along
    inside.push_back(std::min(static_cast<int>(std::lround(radius * radius)), inside.back() - 1));
    if (inside.back() <= 0) {
      inside.back() = 0;
      break;
    }
    radius = std::sqrt(inside.back());
  }
  if (inside.back() == 1) inside.push_back(0);
  std::vector<int> cells;
  for (std::size_t i = inside.size() - 1; i > 0; --i) cells.push_back(inside[i - 1] - inside[i]);
  return cells;
}

float tangent_of(double solid_angle) {
  const double cosine = 1 - solid_angle / (2 * pi_d);
  return static_cast<float>(std::sqrt(1 - cosine * cosine) / cosine);
}

}  // namespace

std::vector<Cone> hemisphere_cones(int count) {
  std::vector<Cone> cones;
  int inside = 0, ring = 0;
  for (const int cells : rings(count)) {
    // sin² of the angles between which the ring lies
    const double s0 = static_cast<double>(inside) / count, s1 = static_cast<double>(inside + cells) / count;
    const double c0 = std::sqrt(1 - s0), c1 = std::sqrt(1 - s1);
    const double half = pi_d / cells;
    // Means over the cell, uniform on the disk: of r, along the cell's middle, and of z.
    const double r =
        2.0 / 3 * (s1 * std::sqrt(s1) - s0 * std::sqrt(s0)) / (s1 - s0) * (std::sin(half) / half);
    const double z = 2.0 / 3 * (c0 * c0 * c0 - c1 * c1 * c1) / (s1 - s0);
    const double length = std::hypot(r, z);
    for (int i = 0; i < cells; ++i) {
      const double angle = 2 * pi_d * (i + (ring % 2 == 0 ? 0.5 : 0.0)) / cells;
      Cone cone;
      cone.direction = vec3(static_cast<float>(r / length * std::cos(angle)),
                            static_cast<float>(r / length * std::sin(angle)), static_cast<float>(z / length));
      cone.weight = static_cast<float>(pi_d / count);
      cone.tangent = tangent_of(2 * half * (c0 - c1));
      cones.push_back(cone);
    }
    inside += cells, ++ring;
  }
  return cones;
}

std::vector<Cone> cap_cones(float cosine) {
  const double whole = 2 * pi_d * (1 - static_cast<double>(cosine));
  if (static_cast<double>(cosine) >= one_cone_cosine) return {{{0, 0, 1}, 1, tangent_of(whole)}};
  constexpr int count = cap_cone_count, ring = count - 1;
  const float tangent = tangent_of(whole / count);
  std::vector<Cone> cones{{{0, 0, 1}, 1.0f / count, tangent}};
  const double c0 = 1 - (1 - static_cast<double>(cosine)) / count, c1 = static_cast<double>(cosine);
  const double z = 0.5 * (c0 + c1), r = std::sqrt(1 - z * z);
  for (int i = 0; i < ring; ++i) {
    const double angle = 2 * pi_d * i / ring;
    cones.push_back({vec3(static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)),
                          static_cast<float>(z)),
                     1.0f / count, tangent});
  }
  return cones;
}

float lobe_cosine(float roughness) {
  return std::clamp(2 * sh::glossy_band_scale(std::clamp(roughness, 0.0f, 1.0f), 1) - 1, 0.0f, 1.0f);
}

}  // namespace ssphh::methods::vct
