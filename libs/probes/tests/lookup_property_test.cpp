/// Lookups do not care about the order of probes, the axes or the unit of length; they are linear in light.

#include <ssphh/probes/lookup.h>
#include <ssphh/sh/rotate.h>

#include "fake_source.h"
#include "property.h"
#include "set_generators.h"

namespace ssphh::probes {
namespace {

using namespace ssphh::test;

/// A room of probes, a wall in it that hides some, and a point that looks.
struct Room {
  ProbeSet set;
  vec3 wall_normal, wall_point;
  rays::SurfacePoint point;

  explicit Room(const SetShape& shape) : set(shape.make()) {
    Pcg32 random(shape.seed, 5);
    const auto direction = [&] { return glm::normalize(sample_uniform_sphere(random.uniform2())); };
    wall_normal = direction();
    wall_point = 3.0f + 4.0f * random.uniform3();
    point = {10.0f * random.uniform3(), direction()};
    // Of either sign, lifted so that little must be windowed away.
    for (Probe& probe : set.probes) {
      for (GroupLight& group : probe.groups) {
        for (std::size_t k = 0; k < group.reflected.values.size(); ++k)
          group.reflected.values[k] *= k == 0 ? 1.0f : 0.2f;
        group.reflected[0] = glm::abs(group.reflected[0]) + 1.0f;
      }
    }
    merge_groups(set);
  }

  vec3 look_up(LookupMethod lookup, std::optional<WeightMethod> weights, bool dering = false) const {
    FakeSource source;
    source.free = [this](const vec3& a, const vec3& b) {
      return (glm::dot(a - wall_point, wall_normal) > 0) == (glm::dot(b - wall_point, wall_normal) > 0);
    };
    LookupParams params;
    params.weights.method = weights;
    params.dering = dering;
    return make_lookup(lookup, set, source, params)->irradiance(point);
  }
};

/// `light` and `irradiance` with each of its weights.
struct Way {
  LookupMethod lookup;
  std::optional<WeightMethod> weights;
};
const std::vector<Way> all_ways{{LookupMethod::irradiance, WeightMethod::distance},
                                {LookupMethod::irradiance, WeightMethod::trilinear},
                                {LookupMethod::irradiance, WeightMethod::mls},
                                {LookupMethod::light, {}}};

/// Relative to what light there is, in the worst channel.
double apart(const vec3& a, const vec3& b) {
  return static_cast<double>(max_component(glm::abs(a - b)) / (1e-3f + max_component(b)));
}

testing::AssertionResult same_in_every_way(const Room& a, const Room& b, double tolerance,
                                           std::span<const Way> ways = all_ways) {
  for (const Way& way : ways) {
    const vec3 x = a.look_up(way.lookup, way.weights), y = b.look_up(way.lookup, way.weights);
    if (const auto close = at_most(apart(x, y), tolerance); !close)
      return testing::AssertionFailure()
             << close.message() << " by " << (way.weights ? name_of(*way.weights) : "light") << ": "
             << ssphh::test::describe(x) << ", not " << ssphh::test::describe(y);
  }
  return testing::AssertionSuccess();
}

/// Weights of up to 16 probes, a fit by 4×4 equations among them: float rounding of positions up to 10 m
/// relative to spacings of metres.
constexpr double fit_rounding = 2e-3;

TEST(LookupProperty, TheOrderOfProbesDoesNotMatter) {
  EXPECT_TRUE(
      for_all(set_shapes(1, 24, 3), seeds()).cases(60).holds([](const SetShape& shape, std::uint64_t seed) {
        const Room room(shape);
        Room other = room;
        other.set = permuted(room.set, random_order(std::size_t(shape.probes), seed));
        return same_in_every_way(other, room, 1e-5);
      }));
}

TEST(LookupProperty, AllWaysButTrilinearTurnWithTheScene) {
  const std::vector<Way> turning{all_ways[0], all_ways[2], all_ways[3]};  // trilinear stands along the axes
  EXPECT_TRUE(for_all(set_shapes(1, 24, 3), directions(), floats(0, 6))
                  .cases(60)
                  .holds([&](const SetShape& shape, const vec3& axis, float angle) {
                    const Room room(shape);
                    const quat turn = glm::angleAxis(angle, axis);
                    Room turned = room;
                    for (Probe& probe : turned.set.probes) {
                      probe.position = turn * probe.position;
                      for (GroupLight& group : probe.groups) {
                        group.reflected = sh::rotate(group.reflected, turn);
                        group.emitted = sh::rotate(group.emitted, turn);
                      }
                    }
                    merge_groups(turned.set);
                    turned.wall_normal = turn * room.wall_normal, turned.wall_point = turn * room.wall_point;
                    turned.point = {turn * room.point.position, turn * room.point.normal};
                    return same_in_every_way(turned, room, fit_rounding, turning);
                  }));
}

TEST(LookupProperty, MetresOrMillimetresOrMilesAreTheSame) {
  EXPECT_TRUE(for_all(set_shapes(1, 24, 3), integers(-10, 10))
                  .cases(60)
                  .holds([](const SetShape& shape, int exponent) {
                    const Room room(shape);
                    const float size = std::ldexp(1.0f, exponent);
                    Room larger = room;
                    for (Probe& probe : larger.set.probes) probe.position *= size, probe.radius *= size;
                    larger.wall_point *= size;
                    larger.point.position *= size;
                    return same_in_every_way(larger, room, fit_rounding);
                  }));
}

TEST(LookupProperty, LightTimesKIsIrradianceTimesKWindowedOrNot) {
  EXPECT_TRUE(for_all(set_shapes(1, 16, 3), integers(-16, 16), integers(0, 1))
                  .cases(60)
                  .holds([](const SetShape& shape, int exponent, int dering) {
                    const Room room(shape);
                    Room brighter = room;
                    const float k = std::ldexp(1.0f, exponent);
                    for (LightGroup& group : brighter.set.light_groups) group.scale *= k;
                    merge_groups(brighter.set);
                    // A power of two passes every rounding.
                    for (const Way& way : all_ways) {
                      if (brighter.look_up(way.lookup, way.weights, dering > 0) !=
                          k * room.look_up(way.lookup, way.weights, dering > 0))
                        return testing::AssertionFailure()
                               << (way.weights ? name_of(*way.weights) : "light") << " is not linear";
                    }
                    return testing::AssertionSuccess();
                  }));
}

TEST(LookupProperty, GroupsAddUpWhereNothingIsNegative) {
  EXPECT_TRUE(for_all(set_shapes(1, 16, 3)).cases(60).holds([](SetShape shape) {
    shape.groups = 2;
    const Room room(shape);
    Room first = room, second = room;
    first.set.light_groups[1].scale = second.set.light_groups[0].scale = vec3(0);
    merge_groups(first.set), merge_groups(second.set);
    for (const Way& way : std::span(all_ways).first(3)) {
      const vec3 a = first.look_up(way.lookup, way.weights), b = second.look_up(way.lookup, way.weights),
                 both = room.look_up(way.lookup, way.weights);
      // What would be negative is clamped to 0, which is not linear.
      if (std::min({a.x, a.y, a.z, b.x, b.y, b.z}) <= 0) continue;
      if (const auto close = at_most(apart(a + b, both), 1e-5); !close) return close;
    }
    return testing::AssertionSuccess();
  }));
}

}  // namespace
}  // namespace ssphh::probes
