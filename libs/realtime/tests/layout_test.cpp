/// Where tiles and pieces stand, and what the scene's bodies are cut into; without OpenGL.

#include <set>

#include <gmock/gmock.h>

#include <ssphh/scene/primitives.h>

#include "lights.h"
#include "mesh_pieces.h"
#include "shadow_maps.h"
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

TEST(MeshPieces, InAnEnginesOrderFollowEachOther) {
  const scene::Mesh mesh = scene::make_sphere(1, 128, 65);  // 16384 triangles
  const std::vector<MeshPiece> pieces = pieces_in_order(mesh, 7);
  ASSERT_EQ(pieces.size(), 11u);
  std::size_t next = 7;
  for (const MeshPiece& piece : pieces) {
    EXPECT_EQ(piece.first_index, next);
    for (int i = 0; i < piece.index_count; ++i, ++next) {
      const vec3& p = mesh.positions[mesh.triangles[(next - 7) / 3][static_cast<int>((next - 7) % 3)]];
      EXPECT_TRUE(glm::all(glm::lessThanEqual(piece.bounds.min, p)) &&
                  glm::all(glm::lessThanEqual(p, piece.bounds.max)));
    }
  }
  EXPECT_EQ(next, 7 + 3 * mesh.triangles.size());
  EXPECT_EQ(pieces.back().index_count, 3 * 1384) << "what is left of 1500 each";
  EXPECT_TRUE(pieces_in_order(scene::Mesh(), 0).empty());
}

}  // namespace
}  // namespace ssphh::realtime
