/// Light in rooms of any albedo and any size, by transport and by path tracing: bounded by its geometric
/// series, more with every bounce, and scaling with the room as its emitters say.

#include <ssphh/bake/bake.h>
#include <ssphh/place/init.h>
#include <ssphh/trace/path_tracer.h>

#include "property.h"
#include "property_room.h"

namespace ssphh::test {
namespace {

using testing::AssertionResult;
using testing::AssertionSuccess;

/// A closed room whose six walls glow with `emission`; albedos lie between `low` and `high`.
scene::Scene closed_room(std::uint64_t seed, const vec3& emission, const vec3& low, const vec3& high) {
  scene::Scene scene = coloured_room(emission);
  Pcg32 random(seed);
  for (scene::Material& wall : scene.materials) {
    wall.base_color = glm::mix(low, high, random.uniform3());
    wall.emission = emission;
  }
  return scene;
}

TEST(EnergyProperty, AClosedRoomLiesBetweenTheSeriesOfItsDarkestAndItsBrightestWall) {
  EXPECT_TRUE(for_all(seeds(), vectors3(0.1f, 5), vectors3(0.05f, 0.85f), vectors3(0, 0.85f))
                  .cases(20)
                  .holds([](std::uint64_t seed, const vec3& emission, const vec3& low,
                            const vec3& more) -> AssertionResult {
                    const vec3 high = glm::max(low, more);
                    const scene::Scene scene = closed_room(seed, emission, low, high);
                    for (const sh::RadianceSh& f : LitRoom(scene).light()) {
                      for (glm::length_t c = 0; c < 3; ++c) {
                        const auto series = [&](float rho) { return double(emission[c] * rho / (1 - rho)); };
                        const double mean = double(f[0][c] / root_4pi);
                        // The solver's 1e-3 over 1 − ρ, and albedos in 10 bits: 5e-4 over ρ (1 − ρ).
                        const auto rounding = [](float rho) {
                          return 1 + double((1e-3f + 5e-4f / rho) / (1 - rho));
                        };
                        if (auto high_enough = at_most(series(low[c]), mean * rounding(low[c])); !high_enough)
                          return high_enough << ", the darkest wall's series";
                        if (auto low_enough = at_most(mean, series(high[c]) * rounding(high[c])); !low_enough)
                          return low_enough << ", the brightest wall's series";
                      }
                    }
                    return AssertionSuccess();
                  }));
}

TEST(EnergyProperty, BrighterWallsOrMoreBouncesNeverTakeLightAway) {
  EXPECT_TRUE(for_all(seeds(), floats(0.1f, 1), integers(1, 6))
                  .cases(20)
                  .holds([](std::uint64_t seed, float dim, int applications) -> AssertionResult {
                    const scene::Scene bright = swinging_room(seed);
                    scene::Scene dark = bright;
                    dark.materials[0].base_color *= dim;
                    transport::RelightParams params = tiny_session();
                    const auto above = [](const std::vector<sh::RadianceSh>& less,
                                          const std::vector<sh::RadianceSh>& more, double tolerance) {
                      double worst = -INFINITY;
                      for (std::size_t i = 0; i < less.size(); ++i) {
                        for (glm::length_t c = 0; c < 3; ++c)
                          worst = std::max(worst, double(less[i][0][c]) / double(more[i][0][c]));
                      }
                      return at_most(worst, 1 + tolerance);
                    };
                    // Two solutions, each to 1e-3 over 1 − 0.8.
                    if (auto more =
                            above(LitRoom(dark, params).light(), LitRoom(bright, params).light(), 1e-2);
                        !more)
                      return more << ": darker walls";
                    params.op = probes::LightOperator::bounce;
                    params.bounce.applications = applications;
                    const std::vector<sh::RadianceSh> once = LitRoom(bright, params).light();
                    ++params.bounce.applications;
                    return above(once, LitRoom(bright, params).light(), 1e-6);
                  }));
}

/// The room in other units: lengths times a power of two.
scene::Scene grown(scene::Scene scene, float size) {
  for (scene::Mesh& mesh : scene.meshes) {
    for (vec3& p : mesh.positions) p *= size;
  }
  for (scene::Node& node : scene.nodes) node.local.translation *= size;
  for (scene::Sphl& sphl : scene.sphls) sphl.radius *= size;
  return scene;
}

TEST(EnergyProperty, LargerRoomsKeepTheLightOfSurfacesAndSkiesAndPointLampsFadeWithTheSquare) {
  EXPECT_TRUE(
      for_all(seeds(), integers(-3, 3))
          .cases(20)
          .holds([](std::uint64_t seed, int exponent) -> AssertionResult {
            const float size = std::ldexp(1.0f, exponent);
            const scene::Scene scene = swinging_room(seed), large = grown(scene, size);
            transport::RelightParams params = tiny_session();
            LitRoom small_room(scene, params);
            params.transport.surfel_size *= size;
            LitRoom large_room(large, params);
            small_room.session.update(), large_room.session.update();
            const auto small_light = small_room.session.reflected_by_group(),
                       large_light = large_room.session.reflected_by_group();
            for (const std::string name : {"bulb", "spot", "panel", "leaf", "environment"}) {
              const auto g = static_cast<std::size_t>(small_room.group(name));
              const bool lamp = name == "bulb" || name == "spot";
              // Lamps are exact. Glow and sky are drawn anew by their points' bits, with 4 and 16 rays at
              // each; another power of the size would be a half at least.
              if (auto same = at_most(
                      apart(large_light[g], times(small_light[g], vec3(lamp ? 1 / (size * size) : 1))),
                      lamp ? 2e-3 : 0.3);
                  !same)
                return same << ": " << name;
            }
            return AssertionSuccess();
          }));
}

TEST(EnergyProperty, ABakedLampMayBeSplitInTwoHalvesAndBakesAreLinear) {
  EXPECT_TRUE(
      for_all(seeds(), integers(0, 1), integers(-8, 8))
          .cases(20)
          .holds([](std::uint64_t seed, int lamp, int exponent) -> AssertionResult {
            scene::Scene scene = swinging_room(seed);
            // That lamp alone: which light a path's sample takes is then of no consequence.
            scene.environment.reset();
            scene.materials[1].emission = scene.materials[2].emission = vec3(0);
            scene.lights.erase(scene.lights.begin() + (1 - lamp));
            const auto baked = [&](const scene::Scene& s) {
              bake::BakeParams params;
              params.face_size = 4, params.path = {3, 1, 2, seed}, params.viz = false;
              bake::BakeReport report;
              std::vector<sh::RadianceSh> light;
              for (const probes::Probe& probe :
                   bake::bake(trace::PathTracer(s), place::init_from_scene(s, 3), params, {}, report).probes)
                light.push_back(probe.self);
              return light;
            };
            const std::vector<sh::RadianceSh> whole = baked(scene);
            scene::Scene split = scene, bright = scene;
            split.lights[0].intensity /= 2;
            split.lights.push_back(split.lights[0]);
            split.lights[1].name = "twin";
            const float k = std::ldexp(1.0f, exponent);
            bright.lights[0].intensity *= k;
            if (baked(bright) != times(whole, vec3(k)))
              return testing::AssertionFailure() << "not linear in the lamp's intensity";
            return at_most(apart(baked(split), whole), 2e-5);  // sums of 96 texels in float
          }));
}

}  // namespace
}  // namespace ssphh::test
