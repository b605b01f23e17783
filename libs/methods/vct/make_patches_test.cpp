/// How pieces of surface are joined, what rays add to them, and whether their backs are surfaces, too.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>

#include "patches.h"
#include "ray_source.h"

namespace ssphh::methods::vct {
namespace {

using test::RaySource;
using test::surface_at;

const VoxelGrid two_metres{.origin = vec3(1, 0, 0), .voxel = 2, .resolution = 8, .size = {8, 8, 8}};
const vec3 up(0, 1, 0), albedo(0.2f, 0.4f, 0.6f);

/// In voxel (0, 0, 0), at a height in voxels, with so much area.
Fragment sheet(float height, float area, const vec3& normal = up) {
  return {voxel_key({0, 0, 0}), area * normal, vec3(0.5f, height, 0.5f), false};
}

/// The plane y = 1 m with its front above, where x is below `end`.
rays::RayHit plane(const vec3& p, const vec3& d, float end = INFINITY) {
  const float t = (1 - p.y) / d.y;
  if (!(t > 0) || p.x + t * d.x > end) return {};
  rays::RayHit hit = surface_at(t, d, d.y > 0);
  hit.normal = d.y > 0 ? -up : up;
  hit.albedo = albedo;
  return hit;
}
const RaySource nothing([](const vec3&, const vec3&) { return rays::RayHit{}; });
const RaySource one_plane([](const vec3& p, const vec3& d) { return plane(p, d); });

PatchSet patches_of(const std::vector<Fragment>& fragments, const RaySource& source,
                    const PatchParams& params = {}) {
  return make_patches(fragments, rays::PosedWorld(source, 0), two_metres, params, {});
}

TEST(VctMakePatches, AskRaysForAlbedoAndTakeTheirHitsAsSamples) {
  for (const bool moving : {false, true}) {
    const PatchSet set = patches_of({sheet(0.5f, 0.75f)}, one_plane, {5, moving});
    ASSERT_EQ(set.patches.size(), 1u) << "its back sees no fronts";
    const Patch& patch = set.patches[0];
    EXPECT_EQ(patch.voxel, voxel_key({0, 0, 0}));
    EXPECT_EQ(patch.cover, (std::array<float, 6>{0, 0, 0.75f, 0, 0, 0}));
    EXPECT_EQ(patch.position, vec3(2, 1, 1));
    EXPECT_EQ(patch.normal, up);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(patch.albedo[c], albedo[c], 1e-6f);
    EXPECT_EQ(patch.first_sample, 0u);
    ASSERT_EQ(patch.samples, 5u);
    ASSERT_EQ(set.samples.size(), 5u);
    for (const rays::SurfacePoint& sample : set.samples) {
      EXPECT_NEAR(sample.position.y, 1, 1e-5f);
      EXPECT_EQ(sample.normal, up);
      EXPECT_EQ(sample.moves, moving);
    }
    EXPECT_NEAR(glm::distance(set.samples[0].position, vec3(2, 1, 1)), 0, 1e-5f);
    vec3 mean(0);
    for (std::size_t s = 1; s < 5; ++s) {
      EXPECT_NEAR(glm::distance(set.samples[s].position, vec3(2, 1, 1)), 0.6f, 1e-5f) << "0.3 voxels aside";
      mean += set.samples[s].position / 4.0f;
    }
    EXPECT_NEAR(glm::distance(mean, vec3(2, 1, 1)), 0, 1e-5f) << "four quarters of a turn";
  }
}

TEST(VctMakePatches, WeighPiecesByTheirAreaAndBookEachSideTheySee) {
  const Fragment large{voxel_key({0, 0, 0}), {0.2f, 0.8f, -0.1f}, vec3(0.4f, 0.5f, 0.5f), false};
  const Fragment small{voxel_key({0, 0, 0}), {-0.1f, 0.3f, 0}, vec3(0.6f, 0.5f, 0.5f), false};
  const PatchSet set = patches_of({small, large}, one_plane);
  ASSERT_EQ(set.patches.size(), 1u);
  const Patch& patch = set.patches[0];
  const std::array<float, 6> cover{0.2f, 0.1f, 1.1f, 0, 0, 0.1f};
  for (std::size_t side = 0; side < 6; ++side) EXPECT_NEAR(patch.cover[side], cover[side], 1e-6f) << side;
  const vec3 normal = glm::normalize(vec3(0.1f, 1.1f, -0.1f));
  EXPECT_NEAR(glm::distance(patch.normal, normal), 0, 1e-6f);
  const float a = std::sqrt(0.69f), b = std::sqrt(0.1f);
  EXPECT_NEAR(patch.position.x, 1 + 2 * (0.4f * a + 0.6f * b) / (a + b), 1e-5f);
}

TEST(VctMakePatches, KeepPiecesApartThatFaceElsewhereOrLieMoreThanAboutASeventhOfAVoxelBehind) {
  EXPECT_EQ(patches_of({sheet(0.5f, 0.5f), sheet(0.64f, 0.5f)}, nothing).patches.size(), 1u);
  EXPECT_EQ(patches_of({sheet(0.5f, 0.5f), sheet(0.66f, 0.5f)}, nothing).patches.size(), 2u);
  EXPECT_EQ(patches_of({sheet(0.5f, 0.5f), sheet(0.5f, 0.5f, {1, 0, 0})}, nothing).patches.size(), 2u);
  EXPECT_EQ(patches_of({sheet(0.5f, 0.5f), sheet(0.5f, 0.5f, -up)}, nothing).patches.size(), 2u);
  Fragment next = sheet(0.5f, 0.5f);
  next.voxel = voxel_key({1, 0, 0});
  const PatchSet set = patches_of({sheet(0.5f, 0.5f), next}, nothing);
  ASSERT_EQ(set.patches.size(), 2u);
  EXPECT_EQ(set.patches[1].voxel, next.voxel);
  EXPECT_EQ(set.patches[1].first_sample, 1u);
  // Of three sheets a piece belongs to the nearest.
  const PatchSet near = patches_of({sheet(0.2f, 0.25f), sheet(0.4f, 0.25f), sheet(0.31f, 0.5f)}, nothing);
  ASSERT_EQ(near.patches.size(), 2u);
  EXPECT_EQ(near.patches[0].cover[2], 0.25f);
  EXPECT_EQ(near.patches[1].cover[2], 0.75f);
}

TEST(VctMakePatches, NoMoreThanTwentyFourInAVoxel) {
  std::vector<Fragment> stairs;
  for (const bool turned : {false, true}) {
    for (int i = 0; i < 13; ++i)
      stairs.push_back(sheet(0.2f * static_cast<float>(i), 0.1f, turned ? -up : up));
  }
  EXPECT_EQ(patches_of(stairs, nothing).patches.size(), 24u);
}

TEST(VctMakePatches, ABackIsASurfaceWhereAQuarterOfItsRaysMeetFronts) {
  // From below, fronts are met within a cone around straight down: of 16 rays stratified by 1 − cos² so many.
  for (const int fronts : {3, 4, 16}) {
    const RaySource source([=](const vec3& p, const vec3& d) {
      if (p.y < 1 && d.y < 0) {
        if (1 - d.y * d.y > static_cast<float>(fronts) / 16) return rays::RayHit{};
        return surface_at(1, d);
      }
      return plane(p, d);
    });
    const PatchSet set = patches_of({sheet(0.5f, 0.75f)}, source);
    ASSERT_EQ(set.patches.size(), fronts < 4 ? 1u : 2u) << fronts;
    if (fronts < 4) continue;
    const Patch& back = set.patches[1];
    EXPECT_EQ(back.normal, -up);
    EXPECT_EQ(back.cover, (std::array<float, 6>{0, 0, 0, 0.75f, 0, 0}));
    EXPECT_EQ(back.albedo, set.patches[0].albedo);
    EXPECT_EQ(back.first_sample, 4u);
    ASSERT_EQ(back.samples, 4u);
    EXPECT_EQ(set.samples[4].normal, -up);
    EXPECT_EQ(set.samples[4].position, set.samples[0].position);
  }
  const RaySource backs(
      [](const vec3& p, const vec3& d) { return p.y < 1 && d.y < 0 ? surface_at(1, d, true) : plane(p, d); });
  EXPECT_EQ(patches_of({sheet(0.5f, 0.75f)}, backs).patches.size(), 1u) << "the inside of a body";
}

TEST(VctMakePatches, WhatIsCutOutCoversAsMuchAsRaysMeet) {
  // Sample 0 stands at x = 2, the others at 2 + 0.6 · (cos, sin) of a third, two thirds and a whole turn.
  const RaySource half([](const vec3& p, const vec3& d) { return plane(p, d, 2.2f); });
  Fragment leaf = sheet(0.5f, 0.8f);
  leaf.cutout = true;
  const PatchSet three = patches_of({leaf}, half);
  ASSERT_EQ(three.patches.size(), 1u);
  EXPECT_LT(three.patches[0].samples, 4u);
  EXPECT_GT(three.patches[0].samples, 0u);
  EXPECT_NEAR(three.patches[0].cover[2], 0.2f * static_cast<float>(three.patches[0].samples), 1e-6f);
  const PatchSet whole = patches_of({sheet(0.5f, 0.8f)}, half);
  EXPECT_EQ(whole.patches[0].cover[2], 0.8f) << "of an opaque one rays may just miss";
  EXPECT_EQ(whole.patches[0].samples, three.patches[0].samples);
  EXPECT_TRUE(patches_of({leaf}, nothing).patches.empty());
  const PatchSet sliver = patches_of({sheet(0.5f, 0.01f)}, nothing, {4, true});
  ASSERT_EQ(sliver.patches.size(), 1u);
  ASSERT_EQ(sliver.samples.size(), 1u);
  EXPECT_EQ(sliver.samples[0].position, vec3(2, 1, 1));
  EXPECT_EQ(sliver.samples[0].normal, up);
  EXPECT_TRUE(sliver.samples[0].moves);
  EXPECT_EQ(sliver.patches[0].albedo, vec3(0));
}

TEST(VctMakePatches, HitsOnWhatFacesElsewhereAreNoSamples) {
  for (const float cosine : {0.49f, 0.51f}) {
    const RaySource tilted([=](const vec3& p, const vec3& d) {
      rays::RayHit hit = plane(p, d);
      if (hit.normal == up) hit.normal = {std::sqrt(1 - cosine * cosine), cosine, 0};
      return hit;
    });
    const PatchSet set = patches_of({sheet(0.5f, 0.8f)}, tilted);
    EXPECT_EQ(set.samples.size(), cosine < 0.5f ? 1u : 4u);
    EXPECT_EQ(set.patches[0].albedo == vec3(0), cosine < 0.5f);
  }
}

/// A unit square that stands still, one that moves and one that is mirrored, each in a voxel of its own.
TEST(VctVoxelizeScene, TakesWhatMovesOrWhatDoesNotAsItIsPosed) {
  scene::Scene scene;
  scene.meshes = {scene::make_quad({0, 0, 1}, {1, 0, 0}, {0, 0, -1})};
  scene.materials.resize(3);
  scene.materials[1].alpha_mode = scene::AlphaMode::mask;
  scene.materials[2].alpha_mode = scene::AlphaMode::blend;
  for (int i = 0; i < 3; ++i) {
    scene::Node& node = scene.nodes.emplace_back();
    node.local.translation = vec3(1 + i, 2.5f, i == 2 ? 4 : 3);
    node.movable = i == 1;
    scene.instances.push_back({0, i, i, ""});
  }
  scene.nodes[2].local.scale = {1, 1, -1};
  const VoxelGrid grid{.origin = vec3(0), .voxel = 1, .resolution = 8, .size = {8, 8, 8}};
  const std::vector<Fragment> still = voxelize(scene, 0, false, grid, {}),
                              moving = voxelize(scene, 0, true, grid, {});
  ASSERT_EQ(still.size(), 4u) << "two triangles each";
  ASSERT_EQ(moving.size(), 2u);
  for (const Fragment& f : still) {
    const bool mirrored = voxel_cell(f.voxel).x == 3;
    EXPECT_EQ(voxel_cell(f.voxel), (Cell{mirrored ? 3 : 1, 2, 3}));
    EXPECT_EQ(f.cutout, mirrored);
    EXPECT_NEAR(f.area.y, 0.5f, 1e-6f) << "a mirrored front stays the front";
  }
  EXPECT_EQ(voxel_cell(moving[0].voxel), (Cell{2, 2, 3}));
  EXPECT_TRUE(moving[0].cutout);
  EXPECT_LE(still[0].voxel, still[3].voxel);
  EXPECT_NE(still[1].voxel, still[2].voxel);
}

}  // namespace
}  // namespace ssphh::methods::vct
