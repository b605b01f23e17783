/// VIZ: cube maps of ghost spheres, and the light they throw.

#include <array>

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>

#include "ghost_emitters.h"
#include "hand_made.h"

namespace ssphh::test {
namespace {

const scene::Scene empty_space;

/// ∫ L dω over a cube map, red.
double integral(const image::CubeMap& map) {
  double sum = 0;
  for (std::size_t f = 0; f < 6; ++f) {
    for (int y = 0; y < map.size; ++y) {
      for (int x = 0; x < map.size; ++x) {
        sum += static_cast<double>(map.faces[f].at(x, y)[0]) * texel_solid_angle(x, y, map.size);
      }
    }
  }
  return sum;
}

image::CubeMap ghost(const scene::Scene& scene, const rays::GhostSphere& ghost,
                     const rays::CubeRequest& request) {
  return trace::PathTracer(scene).ghost_radiance(request, std::span(&ghost, 1), nullptr, {}).front();
}

TEST(Ghost, DirectViewIntegratesToTheConesSolidAngle) {
  // Small spheres have their own samples, which all count when nothing is in the way: exact up to float sums.
  for (const float distance : {1.5f, 3.0f, 20.0f}) {
    const rays::CubeRequest request{vec3(1, 2, 3), 64, {0, 1, 16, 4}};
    const vec3 direction = glm::normalize(vec3(1, -0.5f, 2));
    const double measured = integral(ghost({}, {request.position + distance * direction, 0.1f}, request));
    const double expected = 2 * pi_d * (1 - std::sqrt(1 - std::pow(0.1 / static_cast<double>(distance), 2)));
    EXPECT_NEAR(measured, expected, 2e-4 * expected) << distance;
  }
}

TEST(Ghost, LargeSphereIsSeenByTexelRays) {
  Samples measured;
  const double expected = 2 * pi_d * (1 - std::sqrt(1 - 0.25));
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const rays::CubeRequest request{vec3(0), 16, {0, 1, 4, seed}};
    const image::CubeMap map = ghost({}, {vec3(0, 0, 2), 1}, request);
    measured.add(integral(map));
    // In the middle of the sphere there is no noise.
    EXPECT_NEAR(map.faces[4].at(8, 8)[0], 1, 1e-6);
  }
  EXPECT_TRUE(mean_is(measured, expected, {}, 1e-6));
}

TEST(Ghost, SmallSphereHasLowNoisePerTexel) {
  // Reference coverage of each texel from 32² points; the estimate's error summed over texels stays below 2
  // %.
  const rays::CubeRequest request{vec3(0), 64, {0, 1, 16, 4}};
  const rays::GhostSphere sphere{vec3(2, 1, 2), 0.1f};
  const image::CubeMap map = ghost({}, sphere, request);
  const vec3 axis = glm::normalize(sphere.center);
  const float cos_edge = std::sqrt(1 - 0.01f / 9);
  double error = 0, total = 0;
  for (int f = 0; f < 6; ++f) {
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        int inside = 0;
        for (int i = 0; i < 1024; ++i) {
          const float s = (static_cast<float>(x) + (static_cast<float>(i % 32) + 0.5f) / 32) / 64;
          const float t = (static_cast<float>(y) + (static_cast<float>(i / 32) + 0.5f) / 32) / 64;
          inside += glm::dot(cube_direction({f, s, t}), axis) > cos_edge;
          if (i == 0 && glm::dot(cube_direction({f, s, t}), axis) < 0.99f) break;
        }
        const double coverage = inside / 1024.0;
        error += std::abs(static_cast<double>(map.faces[f].at(x, y)[0]) - coverage);
        total += coverage;
      }
    }
  }
  EXPECT_GT(total, 5);
  EXPECT_LT(error, 0.02 * total);
}

TEST(Ghost, LightsAFloorAsASphereLightWould) {
  // The floor is seen from above; the ball is as strong as a sphere light of radiance 1.
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f, 0.25f, 1)));
  std::array<Samples, 3> viz, light;
  const vec3 ball(0.5f, 1, 0);
  scene::Scene lit = scene;
  add_light(lit, scene::LightType::sphere, 1, ball).radius = 0.3f;
  const trace::PathTracer tracer(scene), reference(lit);
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const rays::CubeRequest request{vec3(0, 2.5f, 0.5f), 8, {2, 1, 4, seed}};
    const std::vector<rays::GhostSphere> ghosts{{ball, 0.3f}};
    const image::CubeMap a = tracer.ghost_radiance(request, ghosts, nullptr, {}).front();
    const rays::GroupRadiance b = reference.incident_radiance(request, {}).front();
    for (std::size_t c = 0; c < 3; ++c) {
      // The −y face sees the floor, and the ball too.
      double sum_a = 0, sum_b = 0;
      for (std::size_t i = c; i < a.faces[3].pixels.size(); i += 3) {
        sum_a += static_cast<double>(a.faces[3].pixels[i]);
        sum_b += static_cast<double>(b.emitted.faces[3].pixels[i] + b.reflected.faces[3].pixels[i]);
      }
      viz[c].add(sum_a), light[c].add(sum_b);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(means_agree(viz[c], light[c], {1e-3, 3}));
}

TEST(Ghost, WallHidesTheSphereAndEmittersAreOff) {
  scene::Scene scene;
  add_object(scene, scene::make_box(vec3(1, -50, -50), vec3(1.1f, 50, 50)), lambertian(vec3(0), vec3(9)),
             "glowing wall");
  add_constant_sky(scene, vec3(5));
  EXPECT_EQ(integral(ghost(scene, {vec3(2, 0, 0), 0.1f}, {vec3(0), 16, {3, 1, 4, 1}})), 0);
}

TEST(Ghost, SphereNeitherBlocksNorReflects) {
  // Seen through a near ball, the far one is as bright as without it.
  const rays::CubeRequest request{vec3(0), 32, {1, 1, 4, 2}};
  const std::vector<rays::GhostSphere> both{{vec3(0, 0, 1), 0.3f}, {vec3(0, 0, 4), 0.5f}};
  const std::vector<image::CubeMap> maps =
      trace::PathTracer(empty_space).ghost_radiance(request, both, nullptr, {});
  const double expected = 2 * pi_d * (1 - std::sqrt(1 - 1.0 / 64));
  EXPECT_NEAR(integral(maps[1]), expected, 2e-4 * expected);
}

TEST(Ghost, ProbeInsideASphereSeesOneEverywhere) {
  const image::CubeMap map = ghost({}, {vec3(0.1f, 0, 0), 0.5f}, {vec3(0), 8, {0, 1, 2, 2}});
  for (const image::Image& face : map.faces) {
    for (const float v : face.pixels) EXPECT_NEAR(v, 1, 1e-6);
  }
  // A wall inside the ball, lit by it from everywhere: ρ · 1 besides the direct view.
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  const image::CubeMap lit = ghost(scene, {vec3(0), 1}, {vec3(0, 0.2f, 0), 8, {1, 1, 4, 2}});
  EXPECT_NEAR(lit.faces[3].at(4, 4)[0], 1.5f, 1e-5);
}

TEST(Ghost, SinkReceivesWhatTheMapsHold) {
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.5f)));
  const rays::CubeRequest request{vec3(0.2f, 0.1f, 0), 8, {3, 2, 4, 7}};
  const std::vector<rays::GhostSphere> ghosts{
      {vec3(0.6f), 0.1f}, {vec3(-0.4f, 0, 0), 0.4f}, {vec3(0, 0.9f, 0), 0.2f}};
  std::array<std::array<double, 3>, rays::RadianceSource::ghost_chunk_count> sums{};
  std::array<bool, rays::RadianceSource::ghost_chunk_count> unit{};
  unit.fill(true);
  const auto sink = [&](int chunk, const rays::GhostPath& path) {
    const auto c = static_cast<std::size_t>(chunk);
    sums[c][path.emitter] += static_cast<double>(path.throughput.x);
    unit[c] = unit[c] && std::abs(glm::length(path.direction) - 1) < 1e-5f &&
              std::abs(glm::length(path.emission) - 1) < 1e-5f;
  };
  const std::vector<image::CubeMap> maps = trace::PathTracer(scene).ghost_radiance(request, ghosts, sink, {});
  for (std::size_t j = 0; j < 3; ++j) {
    double sum = 0;
    for (const auto& chunk : sums) sum += chunk[j];
    EXPECT_NEAR(sum, integral(maps[j]), 1e-5 * sum);
    EXPECT_GT(sum, 0.01);
  }
  for (const bool ok : unit) EXPECT_TRUE(ok);
}

TEST(Ghost, EmissionDirectionOfADirectPathIsOppositeToTheView) {
  const std::vector<rays::GhostSphere> ghosts{{vec3(0, 0, 3), 0.1f}};
  std::array<float, rays::RadianceSource::ghost_chunk_count> worst;
  worst.fill(-1);
  const auto sink = [&](int chunk, const rays::GhostPath& path) {
    float& w = worst[chunk];
    w = std::max(w, glm::dot(path.direction, path.emission));
  };
  (void)trace::PathTracer(empty_space).ghost_radiance({vec3(0), 8, {1, 1, 4, 7}}, ghosts, sink, {});
  for (const float w : worst) EXPECT_LT(w, -0.9999f);
}

/// Of balls that are seen under a cone of sine s, whose cosine is at most c, each is looked at in proportion
/// to s² c.
TEST(Ghost, BallsAreChosenByTheLightThatTheyMayGive) {
  const trace::PathVertex floor{vec3(0), vec3(0, 1, 0)};
  const auto ball = [](float cosine, float distance, float radius) {
    return trace::GhostEmitters::Ball{distance * vec3(std::sqrt(1 - cosine * cosine), cosine, 0), radius,
                                      true};
  };
  const trace::GhostEmitters balls(
      {ball(1, 2, 0.2f), ball(0.1f, 2, 0.2f), ball(1, 2, 0.4f), ball(-0.9f, 2, 0.4f)});
  const std::array<double, 4> light = {0.01 * 1.1, 0.01 * 0.2, 0.04 * 1.2, 0};
  constexpr int choices = 100000;
  std::array<int, 4> chosen{};
  for (int i = 0; i < choices; ++i) {
    const auto sample = balls.sample(0, floor, (static_cast<float>(i) + 0.5f) / choices, vec2(0.5f));
    ASSERT_TRUE(sample);
    ++chosen[sample->group];
  }
  for (std::size_t j = 0; j < 4; ++j)
    EXPECT_NEAR(chosen[j] / double{choices}, light[j] / (light[0] + light[1] + light[2]), 2e-5) << j;
}

TEST(Ghost, NoSpheresGiveNoMaps) {
  EXPECT_TRUE(trace::PathTracer(empty_space).ghost_radiance({vec3(0), 4, {}}, {}, nullptr, {}).empty());
}

}  // namespace
}  // namespace ssphh::test
