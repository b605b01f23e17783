#include <algorithm>

#include <ssphh/geometry/exact_predicates.h>

namespace ssphh::geometry {
namespace {

__extension__ typedef __int128 Wide;

struct Row {
  std::int64_t x, y, z;
};

Row difference(const LatticePoint& a, const LatticePoint& b) {
  return {std::int64_t{a.x} - b.x, std::int64_t{a.y} - b.y, std::int64_t{a.z} - b.z};
}

Wide determinant(const Row& a, const Row& b, const Row& c) {
  const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
    return Wide{p} * s - Wide{q} * r;
  };
  return a.x * minor(b.y, b.z, c.y, c.z) - a.y * minor(b.x, b.z, c.x, c.z) + a.z * minor(b.x, b.y, c.x, c.y);
}

std::int64_t norm2(const Row& r) {
  return r.x * r.x + r.y * r.y + r.z * r.z;
}

int sign(Wide value) {
  return (value > 0) - (value < 0);
}

}  // namespace

int orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
  return sign(determinant(difference(b, a), difference(c, a), difference(d, a)));
}

int in_sphere(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d,
              const LatticePoint& e) {
  const Row ra = difference(a, e), rb = difference(b, e), rc = difference(c, e), rd = difference(d, e);
  return sign(norm2(ra) * determinant(rb, rc, rd) - norm2(rb) * determinant(ra, rc, rd) +
              norm2(rc) * determinant(ra, rb, rd) - norm2(rd) * determinant(ra, rb, rc));
}

int in_sphere_perturbed(const std::array<LatticePoint, 5>& points, const std::array<int, 5>& ranks) {
  const int exact = in_sphere(points[0], points[1], points[2], points[3], points[4]);
  if (exact != 0) return exact;
  // The sign is that of the largest infinitesimal's factor, which is a 3 × 3 minor: an orientation.
  std::array<std::size_t, 5> order = {0, 1, 2, 3, 4};
  std::ranges::sort(order, [&](std::size_t i, std::size_t j) { return ranks[i] > ranks[j]; });
  for (const std::size_t raised : order) {
    if (raised == 4) return -orientation(points[0], points[1], points[2], points[3]);
    std::array<LatticePoint, 4> corner = {points[0], points[1], points[2], points[3]};
    corner[raised] = points[4];
    const int factor = orientation(corner[0], corner[1], corner[2], corner[3]);
    if (factor != 0) return factor;
  }
  return 0;
}

}  // namespace ssphh::geometry
