/// Which probes of many are kept, against all ways of a graph and all places of the grids.

#include <limits>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/scene/primitives.h>

#include "draft.h"
#include "scene_of.h"
#include "triangle_source.h"

namespace ssphh::place {
namespace {

constexpr float no_way = std::numeric_limits<float>::infinity();

/// Lengths of the shortest ways between all drafts (Floyd, Algorithm 97: Shortest Path, 1962).
std::vector<std::vector<float>> all_ways(const std::vector<Draft>& drafts,
                                         const std::vector<PlacedEdge>& edges) {
  const std::size_t n = drafts.size();
  std::vector<std::vector<float>> way(n, std::vector<float>(n, no_way));
  for (std::size_t i = 0; i < n; ++i) way[i][i] = 0;
  for (const PlacedEdge& e : edges)
    way[e.a][e.b] = way[e.b][e.a] = glm::distance(drafts[e.a].position, drafts[e.b].position);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) way[i][j] = std::min(way[i][j], way[i][k] + way[k][j]);
  return way;
}

/// Drafts at integer places of a small cube, so that lengths are sums without rounding: axes' neighbours are
/// linked by chance.
struct RandomGraph {
  std::vector<Draft> drafts;
  std::vector<PlacedEdge> edges;

  explicit RandomGraph(std::uint64_t seed) : drafts(27) {
    Pcg32 random(seed);
    for (int i = 0; i < 27; ++i) {
      Draft& draft = drafts[i];
      draft.position = vec3(i % 3, 2 * (i / 3 % 3), 4 * (i / 9));
      draft.site.nearest = random.uniform();
      if (random.uniform() < 0.08f) draft.kind = PlaceKind::manual;
    }
    for (std::uint32_t a = 0; a < 27; ++a)
      for (const std::uint32_t step : {1u, 3u, 9u})
        if (a / step % 3 < 2 && random.uniform() < 0.6f) edges.push_back({a, a + step, false});
  }
};

TEST(MostSpread, TakesTheFarthestAlongAllWaysOneAfterTheOther) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const RandomGraph graph(seed);
    const std::vector<std::vector<float>> way = all_ways(graph.drafts, graph.edges);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < 27; ++i)
      if (graph.drafts[i].kind == PlaceKind::manual) chosen.push_back(i);
    for (std::size_t count = 1; count <= 27; ++count) {
      while (chosen.size() < count) {
        // By the way to the nearest one chosen, then by room.
        std::pair<float, float> most{-1.0f, 0.0f};
        std::size_t best = 0;
        for (std::size_t i = 0; i < 27; ++i) {
          float nearest = no_way;
          for (const std::size_t c : chosen) nearest = std::min(nearest, way[i][c]);
          const std::pair<float, float> now{nearest, graph.drafts[i].site.nearest};
          if (nearest > 0 && now > most) most = now, best = i;
        }
        chosen.push_back(best);
      }
      std::vector<bool> expected(27, false);
      for (const std::size_t c : chosen) expected[c] = true;
      EXPECT_EQ(most_spread(graph.drafts, graph.edges, count), expected) << seed << ", " << count;
    }
  }
}

TEST(Lattice, OfNineOffsetsTheOneWithMostRoomIsChosen) {
  Pcg32 random(12);
  for (int trial = 0; trial < 4; ++trial) {
    const vec3 size = vec3(1.6f) + random.uniform3(), low = 1.1f * random.uniform3();
    const test::TriangleSource source(
        scene_of({scene::flipped(scene::make_box(vec3(0), size)), scene::make_box(low, low + 0.45f)}));
    constexpr float spacing = 0.8f;
    const SiteRules rules{0.05f, 0.25f};
    // Room of all places that fit at an offset: whole where a quarter of the spacing is free.
    const auto room = [&](const vec3& first) {
      double sum = 0;
      for (float z = first.z; z <= size.z; z += spacing)
        for (float y = first.y; y <= size.y; y += spacing)
          for (float x = first.x; x <= size.x; x += spacing) {
            const Site site = look_around(source, {x, y, z}, coarse_fan_size);
            if (valid(site, rules)) sum += std::min(1.0, site.nearest / (0.25 * spacing));
          }
      return sum;
    };
    // The middle, so that as much is left on both sides; then Roberts' sequence.
    vec3 middle;
    for (int axis = 0; axis < 3; ++axis)
      middle[axis] = 0.5f * (size[axis] - spacing * (std::round(size[axis] / spacing) - 1));
    double most = room(middle);
    vec3 best = middle;
    for (int i = 1; i <= 8; ++i) {
      const vec3 offset =
          spacing * glm::fract(0.5f + static_cast<float>(i) * vec3(0.8191725f, 0.6710436f, 0.5497005f));
      if (const double now = room(offset); now > most) most = now, best = offset;
    }
    const Lattice lattice = choose_lattice(source, {vec3(0), size}, spacing, rules, {});
    EXPECT_LT(glm::distance(lattice.origin, best), 1e-5f) << trial;
  }
}

}  // namespace
}  // namespace ssphh::place
