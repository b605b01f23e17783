/// Where tiles and pieces stand, and what the scene's bodies are cut into; without OpenGL.

#include <set>

#include <gmock/gmock.h>

#include <ssphh/scene/primitives.h>

#include "fitted_entry.h"
#include "lights.h"
#include "mesh_pieces.h"
#include "shadow_maps.h"
#include "still_surface.h"
#include "tile_layout.h"

namespace ssphh::realtime {
namespace {

TEST(TileLayout, HasNoTwoTilesInOnePlaceAndNoMoreRoomThanItNeeds) {
  for (const int most : {0, 1, 2, 3, 4, 7, 8, 31, 64}) {
    for (const int tiles : {0, 1, 2, 3, 4, 5, 12, 16, 17, 36, 63, 64, 65, 400}) {
      SCOPED_TRACE(testing::Message() << tiles << " tiles, at most " << most);
      const TileLayout layout(tiles, most);
      EXPECT_LE(layout.columns(), std::max(most, 1));
      EXPECT_LE(layout.rows, layout.columns());
      std::set<std::array<int, 3>> places;
      for (int tile = 0; tile < tiles; ++tile) {
        const std::array place{layout.column(tile), layout.row(tile), layout.layer(tile)};
        EXPECT_TRUE(places.insert(place).second);
        EXPECT_TRUE(place[0] >= 0 && place[0] < layout.columns());
        EXPECT_TRUE(place[1] >= 0 && place[1] < layout.rows);
        EXPECT_TRUE(place[2] >= 0 && place[2] < layout.layers);
      }
      // One layer holds what is left of the others; one that is alone has no empty row, nor half of its
      // columns
      EXPECT_GE(layout.layers, 1);
      EXPECT_LT((layout.layers - 1) * layout.per_layer(), std::max(tiles, 1));
      if (layout.layers == 1) {
        EXPECT_LT((layout.rows - 1) * layout.columns(), std::max(tiles, 1));
        EXPECT_TRUE(layout.columns() == 1 || layout.per_layer() / 4 < tiles);
      } else {
        EXPECT_EQ(layout.rows, layout.columns());
        EXPECT_GT(2 * layout.columns(), most) << "layers are as large as may be";
      }
    }
  }
  EXPECT_EQ(TileLayout().layers * TileLayout().rows * TileLayout().columns(), 1);
}

TEST(ShadowMaps, FacesOfACubeLookAlongItsAxesAndMeetAtItsEdges) {
  const vec3 origin(1, 2, 3);
  vec3 sum(0);
  for (int face = 0; face < 6; ++face) {
    const MapView view = cube_view(origin, face, 0.25f, 7);
    EXPECT_EQ(view.origin, origin);
    EXPECT_EQ(view.near_plane, 0.25f);
    EXPECT_EQ(view.reach, 7);
    EXPECT_EQ(cube_view(origin, face, 0.25f).reach, INFINITY);
    vec3 axis(0);
    axis[face / 2] = face % 2 ? -1 : 1;
    EXPECT_EQ(view.forward, axis);
    EXPECT_EQ(glm::cross(view.right, view.up), axis);
    sum += view.forward;
  }
  EXPECT_EQ(sum, vec3(0));
}

TEST(ShadowMaps, MapSeesWhatReachesIntoItFromAnySide) {
  const auto at = [](const vec3& middle, float half = 0.1f) {
    return scene::Bounds{middle - half, middle + half};
  };
  for (int face = 0; face < 6; ++face) {
    const MapView view = cube_view({1, 2, 3}, face, 0.01f);
    const auto place = [&](float x, float y, float z) {
      return view.origin + x * view.right + y * view.up + z * view.forward;
    };
    EXPECT_TRUE(sees_box(view, at(place(0, 0, 2))));
    EXPECT_FALSE(sees_box(view, at(place(0, 0, -2))));
    for (const float side : {1.0f, -1.0f}) {
      // The edge lies at 2.02; boxes reach 0.1 over it, at a depth of 1.9 to 2.1
      EXPECT_TRUE(sees_box(view, at(place(side * 2.15f, 0, 2))));
      EXPECT_FALSE(sees_box(view, at(place(side * 2.3f, 0, 2))));
      EXPECT_TRUE(sees_box(view, at(place(0, side * 2.15f, 2))));
      EXPECT_FALSE(sees_box(view, at(place(0, side * 2.3f, 2))));
    }
  }
  // Parallel: half a metre to each side, without a perspective; what stands before its origin is behind it
  const MapView parallel{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 0.1f}, 0};
  EXPECT_TRUE(sees_box(parallel, at({0, 0, 9})));
  for (const float side : {1.0f, -1.0f}) {
    EXPECT_TRUE(sees_box(parallel, at({side * 0.55f, 0, 9})));
    EXPECT_FALSE(sees_box(parallel, at({side * 0.65f, 0, 9})));
    EXPECT_TRUE(sees_box(parallel, at({0, side * 0.55f, 9})));
    EXPECT_FALSE(sees_box(parallel, at({0, side * 0.65f, 9})));
  }
  EXPECT_FALSE(sees_box(parallel, at({0, 0, -1})));
}

TEST(ShadowMaps, ReachIsMeasuredToTheNearestPointOfABox) {
  const MapView view = cube_view({0, 0, 0}, 0, 0.01f, 5);
  EXPECT_TRUE(sees_box(view, {{4.9f, -0.1f, -0.1f}, {9, 0.1f, 0.1f}}));
  EXPECT_FALSE(sees_box(view, {{5.1f, -0.1f, -0.1f}, {9, 0.1f, 0.1f}}));
  EXPECT_TRUE(sees_box(view, {{3.9f, 2.9f, -1}, {9, 9, 1}})) << "3.9, 2.9: 4.86";
  EXPECT_FALSE(sees_box(view, {{4.1f, 3.1f, -1}, {9, 9, 1}})) << "4.1, 3.1: 5.14";
}

TEST(ShadowMaps, BytesAreThoseOfTheLayersWithTheirTiles) {
  EXPECT_EQ(MapAtlas::bytes_of(64, 6), std::size_t{4 * 2} * 64 * 64 * 4);
  EXPECT_EQ(MapAtlas::bytes_of(1024, 16), std::size_t{16} * 1024 * 1024 * 4);
  EXPECT_EQ(MapAtlas::bytes_of(1024, 17), std::size_t{32} * 1024 * 1024 * 4) << "4096 texels are a layer";
}

TEST(MeshPieces, AreSmallAndLieApart) {
  const scene::Mesh mesh = scene::make_sphere(1, 128, 65);  // 16384 triangles
  std::vector<unsigned> indices(7, 99);
  const std::vector<MeshPiece> pieces = split_mesh(mesh, indices);
  ASSERT_EQ(mesh.triangles.size(), 16384u);
  EXPECT_EQ(pieces.size(), 16u) << "halved until they have 1500 or fewer";
  EXPECT_EQ(pieces[0].first_index, 7u) << "after what was there";
  std::size_t next = 7;
  for (const MeshPiece& piece : pieces) {
    EXPECT_EQ(piece.first_index, next);
    EXPECT_EQ(piece.index_count, 3 * 1024);
    next += 3 * 1024;
    EXPECT_LT(max_component(piece.bounds.max - piece.bounds.min), 1.3f) << "cut across every axis";
  }
  EXPECT_EQ(indices.size(), next);
  std::vector<unsigned> few;
  EXPECT_EQ(split_mesh(scene::make_sphere(1, 30, 26), few).size(), 1u) << "1500";
  EXPECT_TRUE(split_mesh(scene::Mesh(), few).empty());
}

TEST(MeshPieces, BoxAroundATurnedBoxTouchesItsCorners) {
  const scene::Bounds box{{-1, 2, 3}, {1, 4, 8}};
  // x, y, z become z + 1, -x, 2 y
  const mat4 world(vec4(0, -1, 0, 0), vec4(0, 0, 2, 0), vec4(1, 0, 0, 0), vec4(1, 0, 0, 1));
  const scene::Bounds turned = transformed(box, world);
  EXPECT_EQ(turned.min, vec3(4, -1, 4));
  EXPECT_EQ(turned.max, vec3(9, 1, 8));
}

TEST(FittedEntry, SquaresAreCountedAcrossTheAxis) {
  const vec3 place(0.2f, 0.55f, 0.9f);  // squares 1, 4, 7
  EXPECT_EQ(fitted_square(place, 0), 4 + 8 * 7);
  EXPECT_EQ(fitted_square(place, 1), 1 + 8 * 7);
  EXPECT_EQ(fitted_square(place, 2), 1 + 8 * 4);
  EXPECT_EQ(fitted_square({-1, 0.5f, 2}, 1), 0 + 8 * 7) << "the nearest square";
}

TEST(FittedEntry, AxisIsThatOfTheLargestComponent) {
  EXPECT_EQ(CoarseNormal::of({0.9f, 0.1f, -0.3f}).axis(), 0);
  EXPECT_EQ(CoarseNormal::of({0.3f, -0.9f, 0.1f}).axis(), 1);
  EXPECT_EQ(CoarseNormal::of({0.1f, 0.3f, -0.9f}).axis(), 2);
  EXPECT_EQ((CoarseNormal{0, 0}.axis()), 2);
}

/// As fitted_lookup.glsl takes an entry apart.
TEST(FittedEntry, HoldsAllOfAPointInItsBits) {
  const std::uint64_t squares = 0x123456789abcdef0ull;
  for (const CoarseNormal& normal : {CoarseNormal{-31, 0}, {31, -5}, {-7, 30}, {0, -1}}) {
    const uvec4 e = pack_fitted_entry(0x3abcde, {-4, 0.5f, 5}, normal, squares);
    EXPECT_EQ(e.x >> 10, 0x3abcdeu);
    EXPECT_EQ(static_cast<int>((e.x >> 5 & 31u) | (e.y >> 30 & 1u) << 5) - 32, normal.u);
    EXPECT_EQ(static_cast<int>((e.x & 31u) | (e.y >> 31) << 5) - 32, normal.v);
    EXPECT_EQ(e.y & 1023u, 0u);
    EXPECT_NEAR(static_cast<double>(e.y >> 10 & 1023u) * 9 / 1023 - 4, 0.5, 4.51 / 1023);
    EXPECT_EQ(e.y >> 20 & 1023u, 1023u);
    EXPECT_EQ((static_cast<std::uint64_t>(e.w) << 32 | e.z), squares);
  }
  const uvec4 far = pack_fitted_entry(0, {-9, 2, 99}, {}, 0);
  EXPECT_EQ(far.y & 1023u, 0u) << "as near as there is room for";
  EXPECT_EQ(far.y >> 20 & 1023u, 1023u);
}

TEST(StillSurface, LeavesOutWhatMovesShinesAloneOrHasNoArea) {
  scene::Scene s;
  s.materials.resize(2);
  s.materials[1].unlit = true;
  s.meshes = {scene::make_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
              scene::make_quad({0, 0, 0}, {1, 0, 0}, {2, 0, 0})};
  s.nodes.resize(2);
  s.nodes[0].local.translation = {5, 0, 0};
  s.nodes[1].movable = true;
  s.instances.resize(6);
  s.instances[0].mesh = 0, s.instances[0].node = 0;
  s.instances[1].mesh = 0, s.instances[1].node = 1;
  s.instances[2].mesh = 0, s.instances[2].material = 1;
  s.instances[3].mesh = 1;
  s.instances[4].mesh = -1;
  s.instances[5].mesh = 0, s.instances[5].material = 0;
  const std::vector<StillTriangle> found = still_triangles(s, 0);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].a, vec3(5, 0, 0));
  EXPECT_EQ(found[0].b, vec3(6, 0, 0));
  EXPECT_EQ(found[0].c, vec3(6, 1, 0));
  EXPECT_EQ(found[2].a, vec3(0)) << "at no node";
}

TEST(StillSurface, CellsListTheTrianglesThatPassThem) {
  // A long triangle along x at z 0.5, a small one in the last cell of y
  const std::vector<StillTriangle> triangles = {{{0.1f, 0.1f, 0.5f}, {2.9f, 0.1f, 0.5f}, {2.9f, 0.3f, 0.5f}},
                                                {{1.2f, 1.2f, 0.2f}, {1.4f, 1.2f, 0.2f}, {1.2f, 1.4f, 0.2f}}};
  const TriangleCells cells = triangle_cells(triangles, {0, 0, 0}, 1, {3, 2, 1});
  ASSERT_EQ(cells.first.size(), 7u);
  const auto list = [&](std::size_t cell) {
    return std::vector<std::uint32_t>(
        cells.triangles.begin() + static_cast<std::ptrdiff_t>(cells.first[cell]),
        cells.triangles.begin() + static_cast<std::ptrdiff_t>(cells.first[cell + 1]));
  };
  for (std::size_t x = 0; x < 3; ++x) EXPECT_THAT(list(x), testing::ElementsAre(0u)) << x;
  EXPECT_THAT(list(3), testing::IsEmpty());
  EXPECT_THAT(list(4), testing::ElementsAre(1u));
  EXPECT_THAT(list(5), testing::IsEmpty());
  // What lies beyond the grid belongs to its edge
  const TriangleCells moved = triangle_cells(triangles, {5, 5, 5}, 1, {2, 2, 2});
  EXPECT_EQ(moved.first[1] - moved.first[0], 2u);
  EXPECT_EQ(moved.first.back(), 2u);
}

}  // namespace
}  // namespace ssphh::realtime
