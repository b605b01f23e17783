/// What is meant where nobody says anything.

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

}  // namespace
}  // namespace ssphh::rays
