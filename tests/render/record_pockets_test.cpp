/// Records where surfels are too few: in pockets, below what touches a floor.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/transport/fitted_weights.h>

#include "solved_scene.h"

namespace ssphh::test {
namespace {

/// The underside of the lamp that lies on the cove's ledge: nobody sees it, and no record stands there.
bool on_the_ledge(const rays::SurfacePoint& p) {
  return p.normal.y < -0.9f && std::abs(p.position.y - 2.79f) < 1e-3f;
}

TEST(RecordPockets, AreEverywhereThatASurfelWouldSeeNone) {
  const SolvedScene gallery(scene::make_builtin("gallery1"));
  const std::vector<rays::SurfacePoint> all = transport::surfel_points(gallery.network());
  const rays::PosedWorld world(gallery.source, 0);
  const auto unlit = [&](const std::vector<rays::SurfacePoint>& records) {
    const probes::SurfaceInterpolation known(
        records, [&](const vec3& a, const vec3& b) { return world.visible(a, b); });
    return std::ranges::count_if(all, [&](const rays::SurfacePoint& p) {
      probes::SurfaceShares shares;
      return known.at(p, shares).empty();
    });
  };
  constexpr int most = 150;
  const auto gather = gallery.where_needed(most, 32);
  EXPECT_LE(gather->points().size(), 2u * most);
  const auto spread = unlit(transport::spread_points(all, most));
  ASSERT_GT(spread, static_cast<long>(all.size() / 25)) << "so few see all: nothing is tested";
  EXPECT_LT(unlit(gather->points()), spread / 2);
}

TEST(RecordPockets, AreNearMostPatches) {
  // A point at the border of the next one's reach is told by that alone, however little it weighs.
  const SolvedScene gallery(scene::make_builtin("gallery1"));
  const rays::PosedWorld world(gallery.source, 0);
  const std::vector<rays::SurfacePoint> patches = transport::surfel_points(gallery.network(), 4);
  const auto from_afar = [&](int most) {
    const auto gather = gallery.where_needed(most, 32);
    const probes::SurfaceInterpolation known(
        gather->points(), [&](const vec3& a, const vec3& b) { return world.visible(a, b); });
    return std::ranges::count_if(patches, [&](const rays::SurfacePoint& p) {
      probes::SurfaceShares storage;
      return !on_the_ledge(p) &&
             std::ranges::none_of(known.at(p, storage), [&](const probes::SurfaceShare& share) {
               return glm::distance(known.position(share.point), p.position) <
                      2.3f * known.spacing(share.point);
             });
    });
  };
  // 2,166 of 10 × 13,571 patches; 2,808 where any point within reach will do.
  long sum = 0;
  for (int most = 110; most <= 200; most += 10) sum += from_afar(most);
  EXPECT_LT(sum, 2450);
}

TEST(RecordPockets, ThoseOfPatchesLeaveNoSurfelWithoutAny) {
  // Records at patches make the reach of those around shorter, which lit surfels before.
  const SolvedScene gallery(scene::make_builtin("gallery1"));
  const std::vector<rays::SurfacePoint> all = transport::surfel_points(gallery.network());
  const rays::PosedWorld world(gallery.source, 0);
  const auto gather = gallery.where_needed(400, 32);
  const probes::SurfaceInterpolation known(gather->points(),
                                           [&](const vec3& a, const vec3& b) { return world.visible(a, b); });
  const auto unlit = std::ranges::count_if(all, [&](const rays::SurfacePoint& p) {
    probes::SurfaceShares shares;
    return !on_the_ledge(p) && known.at(p, shares).empty();
  });
  EXPECT_LT(gather->points().size(), 800u) << "there was room for more";
  EXPECT_EQ(unlit, 0) << "10 of " << all.size() << " where surfels are not asked again";
}

TEST(RecordPockets, AreDenserThanSurfelsBelowABall) {
  // A room with a lamp, and a ball that touches its floor: half as far from there as a surfel is wide, the
  // light is a fraction of what it is a surfel farther out.
  constexpr float radius = 0.4f, size = 0.25f;
  scene::Scene scene;
  scene::Mesh room = scene::make_box({-1.5f, 0, -1.5f}, {1.5f, 2.2f, 1.5f});
  for (uvec3& t : room.triangles) std::swap(t.y, t.z);
  for (vec3& n : room.normals) n = -n;
  add_body(scene, "room", std::move(room), {0.7f, 0.5f, 0.3f});
  scene::Mesh ball = scene::make_sphere(radius);
  for (vec3& x : ball.positions) x.y += radius;
  add_body(scene, "ball", std::move(ball), {0.3f, 0.5f, 0.7f});
  add_body(scene, "lamp", scene::make_box({-0.3f, 2.1f, -0.3f}, {0.3f, 2.15f, 0.3f}), vec3(0.6f), vec3(3));
  add_sphl(scene, "probe", {0.8f, 1.2f, 0.7f});
  scene::validate(scene);
  const SolvedScene lit(std::move(scene), size);
  std::vector<rays::SurfacePoint> ring;
  for (int i = 0; i < 16; ++i) {
    const float angle = 2 * pi * static_cast<float>(i) / 16;
    ring.push_back({0.5f * size * vec3(std::cos(angle), 0, std::sin(angle)), {0, 1, 0}});
  }
  std::vector<probes::RecordLight> truth;
  SurfaceGather(lit.network(), ring, 1024).light(lit.lit, truth);
  const auto records = lit.where_needed(4000, 256);
  const std::vector<double> errors = lit.errors_between(*records, ring, truth);
  double error = 0, light = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) error += errors[i], light += double(glm::length(truth[i][3]));
  EXPECT_LT(error, 0.4 * light) << "0.24; 0.80 where none stand but at surfels";
}

}  // namespace
}  // namespace ssphh::test
