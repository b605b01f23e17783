/// What a relight session shows depends on its state alone, not on the way there; and it is linear in light.

#include "property.h"
#include "property_room.h"

namespace ssphh::test {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

constexpr int change_kinds = 6, group_count = 5;

/// One change of what a session can be told, coded as a number so that sequences shrink.
void change(LitRoom& room, int code) {
  const int kind = code % change_kinds;
  const auto amount = 0.25f * static_cast<float>(1 + code / change_kinds);
  LitSession& session = room.session;
  switch (kind) {
    case 0:
      session.state.time = std::fmod(amount, 2.0f);
      break;
    case 1: {
      scene::LightState lamp = session.state.lights[0];
      lamp.world[3] = vec4(0.7f - 0.5f * amount, 0.1f * amount, 0.5f, 1);
      session.state.lights[0] = lamp;
      break;
    }
    case 2: {
      scene::LightState lamp = session.state.lights[1];
      lamp.intensity = amount, lamp.color.y = 1 / amount;
      session.state.lights[1] = lamp;
      break;
    }
    case 3:
      session.state.group_scales[code / change_kinds % group_count] = vec3(amount, 1 / amount, 0.5f);
      break;
    case 4:
      session.state.environment_rotation = amount;
      break;
    default: {
      sh::RadianceSh glow(1);
      glow[0] = vec3(amount, 1, 0.3f), glow[2] = vec3(0.1f);
      session.shine(code / change_kinds % 2, code % 4 == 0 ? sh::RadianceSh() : glow);
    }
  }
}

std::vector<sh::RadianceSh> shown(LitRoom& room) {
  std::vector<sh::RadianceSh> all = room.light();
  for (int i = 0; i < 2; ++i) all.push_back(room.session.emitted(i));
  return all;
}

Generator<std::vector<int>> walks() {
  return lists(integers(0, 12 * change_kinds - 1), 0, 4);
}

TEST(RelightProperty, AfterAnyWalkAndBackTheBitsAreThoseOfAFreshSession) {
  EXPECT_TRUE(
      for_all(seeds(), walks(),
              one_of<probes::LightOperator>({probes::LightOperator::surfel, probes::LightOperator::bounce}))
          .cases(20)
          .holds([](std::uint64_t seed, std::vector<int> walk, probes::LightOperator op) {
            const scene::Scene scene = swinging_room(seed);
            transport::RelightParams params = tiny_session();
            params.op = op;
            if (op == probes::LightOperator::bounce)
              std::erase_if(walk, [](int code) { return code % change_kinds == 5; });
            LitRoom room(scene, params);
            const scene::LightingState own = room.session.state;
            const std::vector<sh::RadianceSh> before = shown(room);
            for (const int code : walk) change(room, code), room.session.update();
            room.session.state = own;
            return shown(room) == before;
          }));
}

TEST(RelightProperty, ManyUpdatesOrOneForAllChangesGiveTheSameBits) {
  EXPECT_TRUE(for_all(seeds(), walks()).cases(20).holds([](std::uint64_t seed, const std::vector<int>& walk) {
    const scene::Scene scene = swinging_room(seed);
    LitRoom one(scene), many(scene);
    many.session.update();
    for (const int code : walk) {
      change(one, code), change(many, code);
      many.session.update();
    }
    return shown(one) == shown(many);
  }));
}

TEST(RelightProperty, AWarmWalkEndsWithinTheSolversTolerance) {
  EXPECT_TRUE(for_all(seeds(), walks()).cases(20).holds([](std::uint64_t seed, const std::vector<int>& walk) {
    const scene::Scene scene = swinging_room(seed);
    transport::RelightParams warm = tiny_session();
    warm.warm_start = true;
    LitRoom cold_room(scene), warm_room(scene, warm);
    warm_room.session.update();
    for (const int code : walk) {
      change(cold_room, code), change(warm_room, code);
      warm_room.session.update();
    }
    // A residual of 1e-3 leaves that over 1 − (largest albedo 0.8), of the largest surfel's light, in either
    // answer; a surfel may have several times a probe's.
    return at_most(apart(warm_room.light(), cold_room.light()), 2 * 1e-3 / (1 - 0.8) * 4);
  }));
}

TEST(RelightProperty, GroupsAddUpWithAnyScales) {
  EXPECT_TRUE(for_all(seeds(), vectors3(0, 3), vectors3(0, 3))
                  .cases(20)
                  .holds([](std::uint64_t seed, const vec3& bulb, const vec3& panel) {
                    const scene::Scene scene = swinging_room(seed);
                    transport::RelightParams params = tiny_session();
                    params.solve.tolerance = 1e-5f;
                    LitRoom room(scene, params);
                    std::vector<vec3> scales(room.source.light_groups().size(), vec3(1));
                    scales[std::size_t(room.group("bulb"))] = bulb;
                    scales[std::size_t(room.group("panel"))] = panel;
                    for (std::size_t g = 0; g < scales.size(); ++g)
                      room.session.state.group_scales[g] = scales[g];
                    const std::vector<sh::RadianceSh> all = room.light();
                    const auto parts = room.session.reflected_by_group();
                    std::vector<sh::RadianceSh> sum(all.size(), sh::RadianceSh(params.degree));
                    for (std::size_t g = 0; g < scales.size(); ++g) {
                      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += times(parts[g], scales[g])[i];
                    }
                    // As above, for each group's solution.
                    return at_most(apart(sum, all), 5 * 1e-5 / (1 - 0.8) * 4 * 4);
                  }));
}

TEST(RelightProperty, ALampMayBeSplitInTwoHalvesOfOneGroupOrTwo) {
  EXPECT_TRUE(for_all(seeds(), integers(0, 1), integers(0, 1))
                  .cases(20)
                  .holds([](std::uint64_t seed, int lamp, int apart_too) {
                    const scene::Scene scene = swinging_room(seed);
                    scene::Scene split = scene;
                    const auto which = static_cast<std::size_t>(lamp);
                    split.lights[which].intensity /= 2;
                    split.lights.push_back(split.lights[which]);
                    if (apart_too) split.lights.back().name = "twin";
                    // Both lamps are points: their direct light is exact, and sums round.
                    return at_most(apart(LitRoom(split).light(), LitRoom(scene).light()), 1e-5);
                  }));
}

TEST(RelightProperty, AllLightTimesKIsTimesKToTheBit) {
  EXPECT_TRUE(for_all(seeds(), integers(-12, 12)).cases(20).holds([](std::uint64_t seed, int exponent) {
    const float k = std::ldexp(1.0f, exponent);
    const scene::Scene scene = swinging_room(seed);
    scene::Scene brighter = scene;
    for (scene::Light& light : brighter.lights) light.intensity *= k;
    for (scene::Material& material : brighter.materials) material.emission *= k;
    brighter.environment->color *= k;
    return LitRoom(brighter).light() == times(LitRoom(scene).light(), vec3(k));
  }));
}

}  // namespace
}  // namespace ssphh::test
