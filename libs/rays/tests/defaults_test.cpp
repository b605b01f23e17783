/// What is meant where nobody says anything.

#include <span>

#include <gtest/gtest.h>

#include "dark_space.h"
#include "error_message.h"
#include "not_finite.h"

namespace ssphh::rays {
namespace {

using test::infinity;

TEST(RayDefaults, OfQuestionsAndAnswers) {
  const PathParams path;
  EXPECT_EQ(path.max_depth, 25);
  EXPECT_EQ(path.passes, 1);
  EXPECT_EQ(path.spp, 16);
  EXPECT_EQ(path.seed, 0u);
  const CubeRequest request;
  EXPECT_EQ(request.position, vec3(0));
  EXPECT_EQ(request.face_size, 64);
  EXPECT_EQ(RadianceSource::ghost_chunk_count, 48);
  const IrradianceEstimate estimate;
  EXPECT_EQ(estimate.direct + estimate.indirect + estimate.indirect_variance + estimate.indirect_covariance,
            vec3(0));
  const SurfacePoint point;
  EXPECT_EQ(point.position, vec3(0));
  EXPECT_EQ(point.normal, vec3(0, 1, 0));
  EXPECT_FALSE(point.moves);
  const RayQuery ray;
  EXPECT_EQ(ray.origin, vec3(0));
  EXPECT_EQ(ray.direction, vec3(0, 0, -1));
  EXPECT_EQ(ray.t_max, infinity);
  RayHit hit;
  EXPECT_TRUE(hit.escaped());
  EXPECT_EQ(hit.normal + hit.albedo + hit.emission, vec3(0));
  EXPECT_EQ(hit.group, -1);
  EXPECT_FALSE(hit.back);
  hit.distance = 1e30f;
  EXPECT_FALSE(hit.escaped());
  Photon photon;
  EXPECT_EQ(photon.origin + photon.power, vec3(0));
  EXPECT_EQ(photon.direction, vec3(0, 0, -1));
  EXPECT_EQ(photon.range_share(1e9f), 1) << "no range";
  photon.range = 2;
  EXPECT_FLOAT_EQ(photon.range_share(1), 15.0f / 16);
  EXPECT_EQ(photon.range_share(2), 0);
  EXPECT_EQ(photon.range_share(3), 0);
  const PhotonNumbers numbers;
  EXPECT_EQ(numbers.emitter, 0);
  EXPECT_EQ(numbers.place + numbers.direction, vec2(0));
  EXPECT_FLOAT_EQ(photon.range_share(0.5f), 255.0f / 256);
  const PartPoint part;
  EXPECT_EQ(part.albedo, vec3(0));
  EXPECT_FALSE(part.double_sided);
}

TEST(RayDefaults, OfASourceThatCanDoNoMoreThanItMust) {
  const test::DarkSpace source;
  EXPECT_EQ(source.backface_fraction(vec3(1)), 0);
  EXPECT_EQ(test::message_of([&] { source.surface_irradiance({}, {}, {}); }),
            "radiance source: it cannot trace irradiance at surface points");
}

/// What a radiance source must say: the rest has an answer.
class OfNothing final : public RadianceSource {
 public:
  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::vector<GroupRadiance> incident_radiance(const CubeRequest&, const Control&) const override {
    return {};
  }
  bool visible(const vec3&, const vec3&) const override { return true; }

 private:
  std::vector<std::string> groups_;
};

TEST(RayDefaults, OfARadianceSourceWithoutGhosts) {
  const OfNothing source;
  EXPECT_EQ(source.rays_traced(), 0u);
  EXPECT_EQ(test::message_of([&] { source.ghost_radiance({}, {}, {}, {}); }),
            "radiance source: it cannot trace light of ghost spheres");
}

/// A wall at x = 1 that stands for all rays to the right: what a transport source must say.
class Wall final : public TransportSource {
 public:
  scene::Bounds part_bounds(int) const override { return {vec3(1, -9, -9), vec3(1, 9, 9)}; }
  void intersect(int, std::span<const RayQuery> rays, std::span<RayHit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const float t = (1 - rays[i].origin.x) / rays[i].direction.x;
      hits[i] = {};
      if (t > 0 && t < rays[i].t_max) hits[i].distance = t;
    }
  }
  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::unique_ptr<DirectLight> direct_light(std::span<const scene::LightState>, std::span<const mat4>,
                                            const scene::EnvironmentState&) const override {
    return nullptr;
  }

 private:
  std::vector<std::string> groups_ = {"lamp"};
};

TEST(RayDefaults, OfAWorldThatStandsStill) {
  const Wall wall;
  EXPECT_EQ(wall.part_count(), 1);
  EXPECT_EQ(wall.part_name(0), "still");
  EXPECT_EQ(wall.part_pose(0, 3), mat4(1));
  EXPECT_EQ(test::message_of([&] { wall.part_pose(1, 0); }), "transport source: it has no such part");
  EXPECT_EQ(wall.duration(), 0);
  EXPECT_TRUE(wall.sample_part(0, 1).empty());
  EXPECT_TRUE(wall.lights(0).empty());
  EXPECT_TRUE(wall.light_names().empty());
  EXPECT_EQ(test::message_of([&] { wall.light_group_of(0); }), "transport source: it has no lamps");
  EXPECT_TRUE(wall.group_emits_from(0, 0));
  EXPECT_FALSE(wall.group_emits_from(0, 1));
  EXPECT_EQ(wall.rays_traced(), 0u);
  const RayQuery through{vec3(0), vec3(1, 0, 0), 2}, before{vec3(0), vec3(1, 0, 0), 0.5f};
  std::uint8_t blocked[3] = {7, 7, 7};
  wall.occluded(0, std::vector{through, before}, std::span(blocked).first(2));
  EXPECT_EQ(blocked[0], 1);
  EXPECT_EQ(blocked[1], 0);
  EXPECT_EQ(blocked[2], 7) << "behind those that are asked";
}

}  // namespace
}  // namespace ssphh::rays
