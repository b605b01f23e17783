#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/geometry/tetrahedra.h>

namespace ssphh::geometry {
namespace {

std::vector<vec3> random_points(int count, std::uint64_t seed) {
  std::vector<vec3> points;
  Pcg32 random(seed);
  for (int i = 0; i < count; ++i) points.push_back(vec3(4, 2, 6) * random.uniform3() - vec3(1, 0, 2));
  return points;
}

std::vector<vec3> cubic_grid(int n, float step) {
  std::vector<vec3> points;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) points.push_back(step * vec3(x, y, z));
  return points;
}

template <class Field>
float blend(const Tetrahedra& tetrahedra, std::span<const vec3> points, const vec3& at, const Field& field) {
  float sum = 0;
  const CornerWeights weights = tetrahedra.at(at);
  for (const CornerWeight& w : weights.used()) sum += w.weight * field(points[w.point]);
  return sum;
}

void expect_partition_of_unity(const Tetrahedra& tetrahedra, const vec3& at) {
  const CornerWeights weights = tetrahedra.at(at);
  float sum = 0;
  for (const CornerWeight& w : weights.used()) {
    EXPECT_GE(w.weight, 0);
    sum += w.weight;
  }
  EXPECT_NEAR(sum, 1, 1e-5f);  // rounding of four floats, and of lattice places in single precision
}

float linear(const vec3& p) {
  return 2 + 3 * p.x - p.y + 0.5f * p.z;
}

TEST(Tetrahedra, LinearFieldsInsideTheHull) {
  for (const std::vector<vec3>& points : {random_points(200, 1), cubic_grid(5, 0.7f)}) {
    const Tetrahedra tetrahedra(points);
    Pcg32 random(9);
    for (int i = 0; i < 2000; ++i) {
      // Convex combinations of five points lie inside.
      vec3 at(0);
      float sum = 0;
      for (int k = 0; k < 5; ++k) {
        const float w = random.uniform();
        at += w * points[random.next() % points.size()];
        sum += w;
      }
      at /= sum;
      expect_partition_of_unity(tetrahedra, at);
      // Places are rounded to 2⁻¹⁹ of the extent, and flat cells at the hull lose a thousandth of an edge.
      EXPECT_NEAR(blend(tetrahedra, points, at, linear), linear(at), 2e-3f);
    }
  }
}

TEST(Tetrahedra, ProbesGiveTheirOwnValue) {
  const std::vector<vec3> points = random_points(100, 2);
  const Tetrahedra tetrahedra(points);
  for (const vec3& p : points) EXPECT_NEAR(blend(tetrahedra, points, p, linear), linear(p), 1e-4f);
}

TEST(Tetrahedra, ContinuousInsideAndOutside) {
  const std::vector<vec3> points = random_points(60, 3);
  const Tetrahedra tetrahedra(points);
  const auto rough = [](const vec3& p) { return std::sin(20 * p.x) * std::cos(13 * p.y + 7 * p.z); };
  Pcg32 random(4);
  float steepest = 0;
  for (int line = 0; line < 12; ++line) {
    const vec3 a = vec3(8, 6, 10) * random.uniform3() - vec3(3, 2, 4);
    const vec3 b = vec3(8, 6, 10) * random.uniform3() - vec3(3, 2, 4);
    constexpr int steps = 10000;
    float last = blend(tetrahedra, points, a, rough);
    for (int i = 1; i <= steps; ++i) {
      const float now = blend(tetrahedra, points, glm::mix(a, b, static_cast<float>(i) / steps), rough);
      steepest = std::max(steepest, std::abs(now - last));
      last = now;
    }
  }
  // Values of ±1; a jump would be of their size, a step of a millimetre is not.
  EXPECT_LT(steepest, 0.1f);
}

TEST(Tetrahedra, OutsideTakesTheHullsNearestPoint) {
  const std::vector<vec3> points = cubic_grid(4, 1);
  const Tetrahedra tetrahedra(points);
  Pcg32 random(5);
  for (int i = 0; i < 500; ++i) {
    const vec3 at = 9.0f * random.uniform3() - 3.0f;
    EXPECT_NEAR(blend(tetrahedra, points, at, linear), linear(glm::clamp(at, vec3(0), vec3(3))), 1e-4f);
  }
}

/// A tilted grid is rounded, so that its hull is not flat: corners far apart must not be joined over it.
TEST(Tetrahedra, TiltedGridInterpolatesBetweenNeighbours) {
  std::vector<vec3> points = cubic_grid(6, 1);
  const mat3 turn(glm::mat3_cast(glm::normalize(quat(0.8f, 0.3f, 0.4f, 0.2f))));
  for (vec3& p : points) p = turn * p;
  const Tetrahedra tetrahedra(points);
  Pcg32 random(6);
  for (int i = 0; i < 500; ++i) {
    vec3 at = 5.0f * random.uniform3();
    at[i % 3] = i % 2 == 0 ? -0.5f : 5.5f;  // before a side
    const vec3 world = turn * at;
    const CornerWeights weights = tetrahedra.at(world);
    for (const CornerWeight& w : weights.used()) EXPECT_LT(glm::length(points[w.point] - world), 2.3f);
  }
}

/// Over a kite whose long diagonal AC stands `height` higher than the short one BD, Delaunay's cells below
/// end at BD, and a flat cell ABCD fills the rest: what stands above is nearest to the middle of AC while it
/// is kept.
struct Kite {
  float length, before, behind;  ///< of AC; of B and D from it
  /// Height below which six volumes are a thousandth of the longest edge times the largest face's double
  /// area.
  float flat() const {
    const float width = before + behind, longest = std::max(length, width);
    const float area2 = length * std::max({before, behind, 0.5f * width});
    return 1e-3f * longest * area2 / (length * width);
  }
  bool kept(float height) const {
    const float half = 0.5f * length;
    const std::vector<vec3> points = {
        {half, 0, height}, {0, before, 0}, {-half, 0, height}, {0, -behind, 0}, {0, 0, -5}};
    const CornerWeights weights = Tetrahedra(points).at({0, 0, 3});
    bool on_ac = true;
    for (const CornerWeight& w : weights.used()) on_ac &= w.weight < 1e-3f || w.point == 0 || w.point == 2;
    return on_ac;
  }
};

TEST(Tetrahedra, CellsOnTheHullFlatterThanAThousandthArePeeledOff) {
  for (const Kite& kite : {Kite{2, 0.9f, 0.9f}, {8, 1, 1}, {8, 0.4f, 2.2f}, {6, 2.5f, 0.3f}}) {
    EXPECT_TRUE(kite.kept(1.07f * kite.flat())) << kite.length << " " << kite.before;
    EXPECT_FALSE(kite.kept(0.93f * kite.flat())) << kite.length << " " << kite.before;
  }
}

TEST(Tetrahedra, FewPoints) {
  const std::vector<vec3> all = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  EXPECT_THROW(Tetrahedra(std::span<const vec3>()), Error);
  for (std::size_t n = 1; n <= 4; ++n) {
    const std::vector<vec3> points(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
    const Tetrahedra tetrahedra(points);
    expect_partition_of_unity(tetrahedra, {5, -3, 0.2f});
    const auto x = [](const vec3& p) { return p.x; };
    EXPECT_NEAR(blend(tetrahedra, points, {0.5f, 0, 0}, x), n == 1 ? 0 : 0.5f, 1e-5f);
    EXPECT_NEAR(blend(tetrahedra, points, {9, 0, 0}, x), n == 1 ? 0 : 2, 1e-5f);
  }
}

TEST(Tetrahedra, CollinearAndCoplanarAndTheSame) {
  std::vector<vec3> line, plane, same(5, vec3(1, 2, 3));
  const vec3 u = glm::normalize(vec3(1, 2, -1)), v = glm::normalize(glm::cross(u, vec3(0, 0, 1)));
  for (int i = 0; i < 7; ++i) line.push_back(vec3(3, 1, 2) + static_cast<float>((i * 3) % 7) * u);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 5; ++j)
      plane.push_back(vec3(-1, 0, 4) + static_cast<float>(i) * u + static_cast<float>(j) * v);
  plane.push_back(plane[7]);  // twice

  const Tetrahedra on_line(line), on_plane(plane), on_point(same);
  Pcg32 random(8);
  for (int i = 0; i < 200; ++i) {
    const float a = 6 * random.uniform(), b = random.uniform() - 0.5f;
    const vec3 l = vec3(3, 1, 2) + a * u;
    // Linear along the line, whatever the distance from it.
    EXPECT_NEAR(blend(on_line, line, l + b * v, linear), linear(l), 1e-4f);
    const vec3 p = vec3(-1, 0, 4) + 5 * random.uniform() * u + 4 * random.uniform() * v;
    EXPECT_NEAR(blend(on_plane, plane, p + b * glm::cross(u, v), linear), linear(p), 1e-4f);
    const CornerWeights near = on_plane.at(p);
    for (const CornerWeight& w : near.used()) EXPECT_LT(glm::length(plane[w.point] - p), 1.42f);
  }
  ASSERT_EQ(on_point.at({9, 9, 9}).count, 1);
  EXPECT_EQ(on_point.at({9, 9, 9}).entries[0].weight, 1);
}

}  // namespace
}  // namespace ssphh::geometry
