/// Shadow rays tens of kilometres from the origin, where positions are rounded to millimetres: no lamp is in
/// the shadow of its own or a near surface, and no blocker is missed.

#include <gtest/gtest.h>

#include "hand_made.h"
#include "posed_scene.h"
#include "tracer_data.h"

namespace ssphh::test {
namespace {

/// Direct light on an 8×8 m floor that begins at a far corner; whole metres are exact there.
class FarFloor {
 public:
  explicit FarFloor(float away) : corner_(away, 0.5f * away, -0.25f * away) {
    add_quad_facing_up(0, lambertian(albedo));
  }

  void add_quad_facing_up(float height, const scene::Material& material) {
    add_object(scene, scene::make_quad(at(0, height, 8), vec3(8, 0, 0), vec3(0, 0, -8)), material);
  }
  void add_quad_facing_down(float height, const scene::Material& material) {
    add_object(scene, scene::make_quad(at(0, height, 0), vec3(8, 0, 0), vec3(0, 0, 8)), material);
  }
  void add_bulb(float height) { add_light(scene, scene::LightType::point, 40, at(4, height, 4)); }
  vec3 at(float x, float y, float z) const { return corner_ + vec3(x, y, z); }
  /// Bound of the rounding errors at the place, as shadow rays take it.
  float error() const { return trace::position_error(corner_.x + 8); }

  /// Contributions of depth 1 found by sampling lights, and their sum.
  struct Light {
    int count = 0;
    vec3 sum{0};
    void add(int depth, int, const vec3& value, const vec3&) {
      if (depth == 1) ++count, sum += value;
    }
    void first_hit(const shading::Surface&, const vec3&, const trace::Ray&, const trace::Hit&) {}
  };
  static constexpr int batches = 40, paths = 50;
  /// Rays straight down from 1 m above random points of the floor; `wide`: share of the floor's width around
  /// its centre.
  std::vector<Light> direct_light(float wide = 1) const {
    const trace::TracerData data(std::make_shared<const trace::SceneGeometry>(scene), scene, 0);
    const trace::PathOptions options{1, true, trace::Strategy::nee_only};
    trace::RayTask task;
    Pcg32 random(3);
    std::vector<Light> lights(batches);
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
      for (std::uint32_t s = 0; s < paths; ++s) {
        const vec2 u = 4.0f + 8 * wide * (random.uniform2() - 0.5f);
        trace_path(data.geometry, data.emitters(), {at(u.x, 1, u.y), vec3(0, -1, 0)}, {batch, s}, options,
                   task, lights[batch]);
      }
    }
    return lights;
  }
  int lit_paths(float wide = 1) const {
    int count = 0;
    for (const Light& light : direct_light(wide)) count += light.count;
    return count;
  }

  static constexpr vec3 albedo{0.2f, 0.5f, 0.8f};
  scene::Scene scene;

 private:
  vec3 corner_;
};

constexpr int all_paths = FarFloor::batches * FarFloor::paths;
const float distances[] = {1e4f, 1e5f};

TEST(FarShadow, AGlowingSquareIsNotInItsOwnShadow) {
  for (const float away : distances) {
    FarFloor far(away);
    const vec3 emission(3, 1, 2);
    far.add_quad_facing_down(8, lambertian(vec3(0), emission));
    Samples means[3];
    int lit = 0;
    for (const FarFloor::Light& light : far.direct_light()) {
      lit += light.count;
      for (int c = 0; c < 3; ++c) means[c].add(static_cast<double>(light.sum[c]) / FarFloor::paths);
    }
    EXPECT_EQ(lit, all_paths) << "every light sample is seen, " << away << " m away";
    for (int c = 0; c < 3; ++c) {
      // Equal squares at the distance of their side: F = 0.199825 (Howell, C-11). 8 mm of rounding in 8 m.
      const double expected = static_cast<double>(FarFloor::albedo[c] * emission[c]) * 0.199825;
      EXPECT_TRUE(mean_is(means[c], expected, {1e-3, 6}, 2e-3 * expected)) << away << " m away, " << c;
    }
  }
}

// The floor's rounding errors are those of its far corners: by so much rays start above it, here by more than
// a ten-thousandth of the lamp's height.
TEST(FarShadow, ALampLowOverAWidePlainLightsIt) {
  constexpr float half = 500, height = 1.2f, side = 0.2f, away = 2;
  const vec3 emission(3, 1, 2);
  scene::Scene scene;
  add_object(scene, scene::make_quad(vec3(-half, 0, half), vec3(2 * half, 0, 0), vec3(0, 0, -2 * half)),
             lambertian(FarFloor::albedo));
  add_object(scene, scene::make_quad(vec3(-side / 2, height, -side / 2), vec3(side, 0, 0), vec3(0, 0, side)),
             lambertian(vec3(0), emission));
  const trace::TracerData data(std::make_shared<const trace::SceneGeometry>(scene), scene, 0);
  trace::RayTask task;
  FarFloor::Light light;
  constexpr std::uint32_t count = 4096;
  for (std::uint32_t s = 0; s < count; ++s) {
    trace_path(data.geometry, data.emitters(), {vec3(away, 1, 0), vec3(0, -1, 0)}, {0, s},
               {1, true, trace::Strategy::nee_only}, task, light);
  }
  EXPECT_EQ(light.count, count);
  const double r2 = double{height} * height + double{away} * away;
  const double factor =
      double{side} * side * height * height / (r2 * r2) / pi_d;  // small lamp: cos² A / π r²
  for (int c = 0; c < 3; ++c) {
    const double expected = double{emission[c] * FarFloor::albedo[c]} * factor;
    EXPECT_NEAR(static_cast<double>(light.sum[c]) / count, expected, 0.01 * expected) << c;
  }
}

TEST(FarShadow, ABulbJustBelowACeilingLightsTheFloor) {
  for (const float away : distances) {
    FarFloor far(away);
    far.add_bulb(8);
    far.add_quad_facing_down(8 + 0.7f * far.error(), lambertian(vec3(0)));
    EXPECT_EQ(far.lit_paths(), all_paths) << away;
  }
}

TEST(FarShadow, ABulbJustAboveACeilingDoesNot) {
  for (const float away : distances) {
    FarFloor far(away);
    far.add_bulb(8);
    // Rays begin one error above the floor and end two errors and 1e-4 of their length before the bulb.
    far.add_quad_facing_down(8 - 2.2f * far.error() - 8e-4f, lambertian(vec3(0)));
    EXPECT_EQ(far.lit_paths(0.1f), 0) << away;
  }
}

TEST(FarShadow, ABlockerJustAboveTheFloorIsMet) {
  for (const float away : distances) {
    FarFloor far(away);
    far.add_bulb(8);
    far.add_quad_facing_up(1.5f * far.error(), lambertian(vec3(0)));
    // The camera's rays would see the blocker: they start below it.
    const PosedScene embree(far.scene);
    trace::RayTask task;
    trace::Hit hit;
    ASSERT_TRUE(embree.intersect({far.at(4, -1, 4), vec3(0, 1, 0)}, 0, task, hit));
    vec3 origin;
    embree.surface(hit, vec3(0, 1, 0), origin);
    EXPECT_TRUE(embree.occluded({origin, vec3(0, 1, 0), 8}, 0, task)) << away;
    EXPECT_FALSE(embree.occluded({origin + vec3(0, far.error(), 0), vec3(0, 1, 0), 8}, 0, task)) << away;
  }
}

TEST(FarShadow, SurfacesThatFaceEachOtherAreVisible) {
  for (const float away : distances) {
    FarFloor far(away);
    far.add_quad_facing_down(8, lambertian(vec3(0.5f)));
    const trace::PathTracer tracer(far.scene);
    for (const vec2& a : {vec2(1, 2), vec2(5, 3), vec2(6, 7)}) {
      for (const vec2& b : {vec2(7, 1), vec2(2, 6), vec2(5, 3)}) {
        const vec3 below = far.at(a.x, 0, a.y), above = far.at(b.x, 8, b.y);
        EXPECT_TRUE(tracer.visible(below, above)) << away;
        EXPECT_TRUE(tracer.visible(above, below)) << away;
        EXPECT_FALSE(tracer.visible(below - vec3(0, 1, 0), above)) << away;
        EXPECT_FALSE(tracer.visible(below, above + vec3(0, 1, 0))) << away;
      }
    }
  }
}

}  // namespace
}  // namespace ssphh::test
