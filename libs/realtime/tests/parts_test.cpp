/// The parts of the renderer that need no OpenGL.

#include <algorithm>
#include <random>
#include <set>

#include <gmock/gmock.h>

#include <ssphh/scene/primitives.h>
#include <ssphh/sh/evaluate.h>

#include "emitter_samples.h"
#include "mesh_pieces.h"
#include "random_points.h"
#include "shadow_maps.h"
#include "tile_basis.h"

namespace ssphh::realtime {
namespace {

using test::random_points;

/// Reads a tile as the shader does.
vec3 sample_tile(const std::vector<vec4>& tile, int size, const vec3& d) {
  const vec3 a = glm::abs(d);
  vec2 p = vec2(d) / (a.x + a.y + a.z);
  if (d.z < 0)
    p = (1.0f - glm::abs(vec2(p.y, p.x))) * vec2(std::copysign(1.0f, p.x), std::copysign(1.0f, p.y));
  const vec2 at = (0.5f + 0.5f * p) * static_cast<float>(size) + 0.5f;
  const vec2 low = glm::floor(at), f = at - low;
  const auto texel = [&](int x, int y) {
    return vec3(tile[(static_cast<int>(low.y) + y) * (size + 2) + static_cast<int>(low.x) + x]);
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x), f.y);
}

TEST(Octahedral, TileInterpolatesItsFunctionAlsoAcrossEdges) {
  // Where the map is smooth, bilinear interpolation errs by h²/8 of the second derivative, l(l+1) of the
  // band's amplitude; at the map's creases by h/4 of the jump of the first, at most twice √(l(l+1)) of it. A
  // texel's angle h is at most twice the mean, π/(2 size).
  constexpr int degree = 4, size = 24;
  const double h = 2 * pi_d / (2 * size);
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  for (int l = 1; l <= degree; ++l) {
    std::vector<vec3> c(25, vec3(0));
    for (int k = l * l; k < (l + 1) * (l + 1); ++k) c[k] = vec3(normal(random));
    c[0] = vec3(30);  // keeps it positive, where the tile does not clamp
    const TileBasis basis(size, degree);
    std::vector<vec4> tile(basis.texels());
    const std::array<float, 11> ones{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    basis.evaluate(c, ones, tile);
    float amplitude = 0, worst = 0, mean = 0;
    for (vec3 d : random_points(4000, 1)) {
      d = glm::normalize(d);
      std::array<float, 25> y;
      sh::eval_basis(degree, d, y);
      float value = 0;
      for (std::size_t k = 1; k < 25; ++k) value += c[k].x * y[k];
      amplitude = std::max(amplitude, std::abs(value));
      const float off = std::abs(sample_tile(tile, size, d).x - value - c[0].x * y[0]);
      worst = std::max(worst, off);
      mean += off / 4000;
    }
    EXPECT_LT(worst, h / 2 * std::sqrt(l * (l + 1.0)) * static_cast<double>(amplitude)) << "band " << l;
    EXPECT_LT(mean, h * h / 8 * l * (l + 1) * static_cast<double>(amplitude)) << "band " << l;
  }
}

/// A function that is different in every direction and colour, as a tile with its border.
struct ColouredTile {
  int size;
  std::vector<vec4> texels;

  explicit ColouredTile(int n) : size(n) {
    std::mt19937 random(8);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<vec3> c(25);
    for (vec3& v : c) v = vec3(uniform(random), uniform(random), uniform(random));
    c[0] = vec3(30, 40, 50);  // keeps it positive, where the tile does not clamp
    const TileBasis basis(size, 4);
    texels.resize(basis.texels());
    const std::array<float, 11> ones{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    basis.evaluate(c, ones, texels);
  }
  vec3 at(int column, int row) const { return vec3(texels[row * (size + 2) + column]); }
};

TEST(Octahedral, ABorderIsTheSameEdgeMirroredAboutItsMiddle) {
  const ColouredTile tile(6);
  const int last = tile.size, out = tile.size + 1;
  const auto expect_same = [](const vec3& a, const vec3& b) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-4f);
  };
  for (int i = 1; i <= last; ++i) {
    SCOPED_TRACE(i);
    expect_same(tile.at(0, i), tile.at(1, out - i));
    expect_same(tile.at(out, i), tile.at(last, out - i));
    expect_same(tile.at(i, 0), tile.at(out - i, 1));
    expect_same(tile.at(i, out), tile.at(out - i, last));
  }
  // At a corner, -z, lies what does so at the opposite one
  expect_same(tile.at(0, 0), tile.at(last, last));
  expect_same(tile.at(out, 0), tile.at(1, last));
  expect_same(tile.at(0, out), tile.at(last, 1));
  expect_same(tile.at(out, out), tile.at(1, 1));
}

TEST(Octahedral, BothSidesOfTheCutAreOne) {
  // The map is cut where x or y is 0 and z below it.
  const ColouredTile tile(24);
  const float aside = 1e-4f;
  for (float t = -0.99f; t < 1; t += 0.01f) {
    for (const bool swapped : {false, true}) {
      const vec3 a(t, aside, std::abs(t) - 1), b(t, -aside, std::abs(t) - 1);
      const auto value = [&](const vec3& d) {
        return sample_tile(tile.texels, tile.size, swapped ? vec3(d.y, d.x, d.z) : d);
      };
      // Values change by less than 25 units of each function in a radian, 1e-4 of which lie between.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(value(a)[c], value(b)[c], 0.02f) << t;
    }
  }
}

TEST(MeshPieces, KeepEveryTriangle) {
  const scene::Mesh mesh = scene::make_torus_knot(2, 3, 0.4f, 0.2f, 0.1f, 256, 16);
  std::vector<unsigned> indices;
  const std::vector<MeshPiece> pieces = split_mesh(mesh, indices);
  EXPECT_GT(pieces.size(), 1u);
  std::multiset<std::array<unsigned, 3>> wanted, got;
  for (const uvec3& t : mesh.triangles) wanted.insert({t.x, t.y, t.z});
  for (const MeshPiece& piece : pieces) {
    for (std::size_t i = piece.first_index;
         i < piece.first_index + static_cast<std::size_t>(piece.index_count); i += 3) {
      got.insert({indices[i], indices[i + 1], indices[i + 2]});
      for (std::size_t c = 0; c < 3; ++c) {
        const vec3& p = mesh.positions[indices[i + c]];
        EXPECT_TRUE(glm::all(glm::lessThanEqual(piece.bounds.min, p)) &&
                    glm::all(glm::lessThanEqual(p, piece.bounds.max)));
      }
    }
  }
  EXPECT_EQ(got, wanted);
}

TEST(EmitterSamples, BallsAreToldFromOtherMeshes) {
  scene::Mesh ball = scene::make_sphere(2, 24, 12);
  for (vec3& corner : ball.positions) corner += vec3(1, -3, 5);
  const std::optional<Ball> found = as_ball(ball);
  ASSERT_TRUE(found);
  EXPECT_LT(glm::distance(found->center, vec3(1, -3, 5)), 1e-4f);
  EXPECT_LT(found->radius, 2);
  EXPECT_GT(found->radius, 1.95f) << "of as much surface: triangles stand within";

  EXPECT_FALSE(as_ball(scene::flipped(ball))) << "it glows inward";
  EXPECT_FALSE(as_ball(scene::make_box(vec3(-1), vec3(1)))) << "corners on a ball, and too little surface";
  scene::Mesh egg = scene::make_sphere(2, 24, 12), half = egg;
  for (vec3& corner : egg.positions) corner.y *= 1.1f;
  EXPECT_FALSE(as_ball(egg));
  half.triangles.resize(half.triangles.size() / 2);
  EXPECT_FALSE(as_ball(half));
  EXPECT_FALSE(as_ball(scene::Mesh()));
}

TEST(EmitterSamples, PointsOnAStripLieApartAndShareItsArea) {
  const scene::Mesh strip = scene::make_quad({0, 0, 0}, {7, 0, 0}, {0, 0, -0.2f});
  const std::vector<AreaPoint> points = spread_points(strip, mat4(1), 14);
  ASSERT_EQ(points.size(), 14u);
  float sum = 0, nearest = 1e9f;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += points[i].share;
    EXPECT_NEAR(points[i].position.y, 0, 1e-5f);
    for (std::size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, glm::distance(points[i].position, points[j].position));
  }
  EXPECT_NEAR(sum, 1, 1e-5f);
  EXPECT_GT(nearest, 0.25f) << "half a metre each on average";
}

TEST(EmitterSamples, PointsOfABallFillItsDiscEvenlyFromWhereverItIsSeen) {
  constexpr float radius = 0.3f;
  const std::vector<AreaPoint> ball = ball_points(radius, 4096);
  for (const vec3& view : {vec3(0, 0, 1), vec3(1, 0, 0), glm::normalize(vec3(1, -2, 3))}) {
    // Within half of a disc's radius lies a quarter of it, within 0.9 of it 81 %; the mean square is a half.
    double square = 0, inner = 0, most = 0;
    for (const AreaPoint& point : ball) {
      const float across = glm::length(point.position - glm::dot(point.position, view) * view) / radius;
      square += point.share * across * across;
      inner += across < 0.5f ? point.share : 0;
      most += across < 0.9f ? point.share : 0;
    }
    // 0.01: six standard errors of as many points drawn at random is 0.04; these are spread evenly.
    EXPECT_NEAR(square, 0.5, 0.01);
    EXPECT_NEAR(inner, 0.25, 0.01);
    EXPECT_NEAR(most, 0.81, 0.01);
  }
}

TEST(EmitterSamples, PartsOfADiscSpreadAsItDoes) {
  EXPECT_THAT(disc_parts(0, 16), testing::ElementsAre(vec3(0, 0, 1)));
  EXPECT_THAT(disc_parts(0.00465f, 16), testing::ElementsAre(vec3(0, 0, 1)));
  EXPECT_EQ(disc_parts(0.2f, 11).size(), 7u) << "sixteen are wanted, seven are the most below eleven";
  // Of a disc beyond a line at t
  const auto beyond = [](double t) {
    t = std::clamp(t, -1.0, 1.0);
    return (std::acos(t) - t * std::sqrt(1 - t * t)) / pi_d;
  };
  struct Case {
    float radius;
    std::size_t parts;
    double most;
  };
  for (const Case& c : {Case{0.07f, 4, 0.039}, {0.1f, 7, 0.019}, {0.12f, 12, 0.022}, {1.0f, 16, 0.015}}) {
    SCOPED_TRACE(testing::Message() << "radius " << c.radius);
    const std::vector<vec3> parts = disc_parts(c.radius, 16);
    ASSERT_EQ(parts.size(), c.parts);
    const double sine = std::sin(static_cast<double>(c.radius));
    double worst = 0;
    for (double turn = 0; turn < 2 * pi_d; turn += 0.05) {
      for (double t = -1.2; t <= 1.2; t += 0.01) {
        double share = 0;
        for (const vec3& p : parts) {
          EXPECT_NEAR(glm::length(p), 1, 1e-6f);
          const double at =
              (static_cast<double>(p.x) * std::cos(turn) + static_cast<double>(p.y) * std::sin(turn)) / sine;
          const auto count = static_cast<double>(parts.size());
          share += beyond((t - at) * std::sqrt(count)) / count;
        }
        worst = std::max(worst, std::abs(share - beyond(t)));
      }
    }
    EXPECT_LT(worst, c.most);
  }
}

TEST(EmitterSamples, ConstantEnvironmentGivesPiEverywhere) {
  scene::Environment environment;
  const auto sh = environment_irradiance(environment);
  EXPECT_NEAR(sh[0].x * 0.28209479f, pi, 1e-3f);
  for (int k = 1; k < 25; ++k) EXPECT_NEAR(sh[k].x, 0, 2e-3f);
  vec3 sum(0);
  for (const EnvironmentSample& s : environment_directions(environment, 32)) sum += s.weight;
  EXPECT_NEAR(sum.x, 4 * pi, 1e-3f);
}

TEST(ShadowMaps, AFaceSeesABoxThatReachesIntoIt) {
  const MapView view = cube_view({1, 2, 3}, 0, 0.01f);  // +x
  EXPECT_TRUE(sees_box(view, {{3, 1.5f, 2.5f}, {4, 2.5f, 3.5f}}));
  EXPECT_FALSE(sees_box(view, {{-3, 1.5f, 2.5f}, {-2, 2.5f, 3.5f}})) << "behind";
  EXPECT_FALSE(sees_box(view, {{2, 6, 2.5f}, {3, 7, 3.5f}})) << "above";
  EXPECT_TRUE(sees_box(view, {{-9, -9, -9}, {9, 9, 9}})) << "around";
  const MapView near = cube_view({1, 2, 3}, 0, 0.01f, 2.5f);
  EXPECT_TRUE(sees_box(near, {{3, 1.5f, 2.5f}, {4, 2.5f, 3.5f}}));
  EXPECT_FALSE(sees_box(near, {{3.6f, 1.5f, 2.5f}, {4, 2.5f, 3.5f}})) << "farther than anybody asks";
}

}  // namespace
}  // namespace ssphh::realtime
