#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/geometry/delaunay.h>

#include "number_list.h"

namespace ssphh::geometry {
namespace {

std::vector<LatticePoint> random_points(int count, int range, std::uint64_t seed) {
  std::vector<LatticePoint> points;
  std::set<std::array<int, 3>> seen;
  Pcg32 random(seed);
  while (static_cast<int>(points.size()) < count) {
    const LatticePoint p(random.uniform3() * static_cast<float>(range));
    if (seen.insert({p.x, p.y, p.z}).second) points.push_back(p);
  }
  return points;
}

std::vector<LatticePoint> grid(int n, int step) {
  std::vector<LatticePoint> points;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) points.emplace_back(x * step, y * step, z * step);
  return points;
}

const LatticePoint& corner(std::span<const LatticePoint> points, const Tetrahedron& t, std::size_t k) {
  return points[t.vertex[k]];
}

double volume6(std::span<const LatticePoint> points, const Tetrahedron& t) {
  const glm::dvec3 a(corner(points, t, 0));
  return glm::dot(glm::dvec3(corner(points, t, 1)) - a,
                  glm::cross(glm::dvec3(corner(points, t, 2)) - a, glm::dvec3(corner(points, t, 3)) - a));
}

/// Every cell is positive, no point is inside of any cell's sphere, neighbours agree, and the sum of volumes
/// is that of the hull.
void expect_delaunay(std::span<const LatticePoint> points, double hull6) {
  const std::vector<Tetrahedron> cells = delaunay(points);
  double sum = 0;
  std::set<std::int32_t> used;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Tetrahedron& t = cells[c];
    ASSERT_EQ(
        orientation(corner(points, t, 0), corner(points, t, 1), corner(points, t, 2), corner(points, t, 3)),
        1);
    sum += volume6(points, t);
    used.insert(t.vertex.begin(), t.vertex.end());
    for (const LatticePoint& p : points)
      ASSERT_LE(in_sphere(corner(points, t, 0), corner(points, t, 1), corner(points, t, 2),
                          corner(points, t, 3), p),
                0);
    for (std::size_t k = 0; k < 4; ++k) {
      if (t.neighbor[k] < 0) continue;
      const Tetrahedron& other = cells[t.neighbor[k]];
      const auto back = std::ranges::find(other.neighbor, static_cast<std::int32_t>(c));
      ASSERT_NE(back, other.neighbor.end());
      for (std::size_t j = 0; j < 4; ++j) {
        if (j == k) continue;
        ASSERT_NE(std::ranges::find(other.vertex, t.vertex[j]), other.vertex.end());
      }
    }
  }
  EXPECT_EQ(used.size(), points.size());
  // Exact below 2⁵³.
  EXPECT_EQ(sum, hull6);
}

/// Six times the volume of the convex hull by the faces that have all points on one side; for points in
/// general position.
double hull_volume6(std::span<const LatticePoint> points) {
  double sum = 0;
  const auto n = points.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k) {
        if (i == j || j == k || k == i || i > j || i > k) continue;
        bool face = true;
        for (std::size_t m = 0; m < n && face; ++m)
          if (m != i && m != j && m != k) face = orientation(points[i], points[j], points[k], points[m]) > 0;
        if (!face) continue;
        sum -= glm::dot(glm::dvec3(points[i]), glm::cross(glm::dvec3(points[j]), glm::dvec3(points[k])));
      }
  return sum;
}

TEST(Delaunay, RandomPoints) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const std::vector<LatticePoint> points = random_points(40, 100000, seed);
    expect_delaunay(points, hull_volume6(points));
  }
}

TEST(Delaunay, FourPointsInBothOrders) {
  const std::vector<LatticePoint> right = {{0, 0, 0}, {5, 0, 0}, {0, 5, 0}, {0, 0, 5}};
  const std::vector<LatticePoint> left = {{0, 0, 0}, {0, 5, 0}, {5, 0, 0}, {0, 0, 5}};
  expect_delaunay(right, 125);
  expect_delaunay(left, 125);
}

TEST(Delaunay, GridsAreCosphericalAndCoplanar) {
  expect_delaunay(grid(2, 7), 6.0 * 7 * 7 * 7);
  expect_delaunay(grid(5, 3), 6.0 * 12 * 12 * 12);
}

TEST(Delaunay, ShuffledGridAndManyTies) {
  std::vector<LatticePoint> points = grid(5, 1000);
  Pcg32 random(3);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.next() % i]);
  expect_delaunay(points, 6.0 * 4000 * 4000 * 4000);
  // A full little lattice: most sets of five points are tied.
  std::vector<LatticePoint> dense = random_points(60, 5, 1);
  expect_delaunay(dense, [&] {
    double sum = 0;
    for (const Tetrahedron& t : delaunay(dense)) sum += volume6(dense, t);
    return sum;
  }());
}

TEST(Delaunay, ManyPointsOnASphere) {
  // Integer points with x² + y² + z² = 9 · 49 · 25: all cospherical.
  std::vector<LatticePoint> points;
  constexpr int r = 105;
  for (int x = -r; x <= r; ++x)
    for (int y = -r; y <= r; ++y)
      for (int z = -r; z <= r; ++z)
        if (x * x + y * y + z * z == r * r) points.emplace_back(x, y, z);
  ASSERT_GT(points.size(), 100u);
  points.resize(100);
  std::ranges::reverse(points);
  const std::vector<Tetrahedron> cells = delaunay(points);
  for (const Tetrahedron& t : cells) EXPECT_GT(volume6(points, t), 0);
}

TEST(Delaunay, LargestCoordinatesDoNotOverflow) {
  constexpr int m = lattice_range;
  EXPECT_EQ(m, 1048576);
  const std::vector<LatticePoint> points = {{-m, -m, -m}, {m, -m, -m}, {-m, m, -m}, {m, m, -m}, {-m, -m, m},
                                            {m, -m, m},   {-m, m, m},  {m, m, m},   {0, 0, 1}};
  expect_delaunay(points, 48.0 * m * m * m);
  EXPECT_EQ(in_sphere(points[0], points[1], points[2], points[4], points[7]), 0);
  EXPECT_EQ(in_sphere(points[0], points[1], points[2], points[4], points[8]), 1);
}

TEST(Delaunay, CellsAreWhatTheyWere) {
  ssphh::test::NumberList list;
  // In general position, and a lattice, where ties decide; integers, so to the last of them.
  for (const std::vector<LatticePoint>& points : {random_points(14, 1000, 9), random_points(30, 4, 2)}) {
    list.add("points", points.size(), spanning_points(points));
    for (const Tetrahedron& cell : delaunay(points)) list.add("cell", cell.vertex, cell.neighbor);
  }
  // In one place, on a line, in a plane.
  for (const std::vector<LatticePoint>& flat : {std::vector<LatticePoint>(3, {1, 2, 3}),
                                                {{1, 2, 3}, {1, 2, 3}, {3, 3, 5}, {5, 4, 7}},
                                                {{0, 0, 0}, {2, 0, 1}, {4, 0, 2}, {1, 3, 1}, {3, 3, 2}}})
    list.add("flat", spanning_points(flat));
  list.expect("libs/geometry/tests/expected/delaunay.txt");
}

TEST(ExactPredicates, HaveTheSignOfTheirSide) {
  const LatticePoint a(0, 0, 0), b(4, 0, 0), c(0, 4, 0), d(0, 0, 4);
  EXPECT_EQ(orientation(a, b, c, d), 1);
  EXPECT_EQ(orientation(a, c, b, d), -1);
  EXPECT_EQ(orientation(a, b, c, {1, 2, 0}), 0);
  EXPECT_EQ(in_sphere(a, b, c, d, {1, 1, 1}), 1);
  EXPECT_EQ(in_sphere(a, b, c, d, {5, 5, 5}), -1);
  EXPECT_EQ(in_sphere(a, b, c, d, {4, 4, 4}), 0);
  // The last corner of the cube lies outside if it is the one that is raised, and otherwise by who is.
  const std::array<LatticePoint, 5> cube{a, b, c, d, LatticePoint(4, 4, 4)};
  EXPECT_EQ(in_sphere_perturbed(cube, {0, 1, 2, 3, 4}), -1);
  EXPECT_EQ(in_sphere_perturbed(cube, {4, 1, 2, 3, 0}), orientation(cube[4], b, c, d));
  EXPECT_EQ(in_sphere_perturbed(cube, {0, 4, 2, 3, 1}), orientation(a, cube[4], c, d));
  EXPECT_EQ(in_sphere_perturbed(cube, {0, 1, 4, 3, 2}), orientation(a, b, cube[4], d));
  EXPECT_EQ(in_sphere_perturbed(cube, {0, 1, 2, 4, 3}), orientation(a, b, c, cube[4]));
  // Where it lies in the plane of the others' three corners, the next one decides.
  const std::array<LatticePoint, 5> square{a, b, c, d, LatticePoint(4, 4, 0)};
  EXPECT_EQ(in_sphere_perturbed(square, {0, 1, 2, 4, 3}), -1);
}

}  // namespace
}  // namespace ssphh::geometry
