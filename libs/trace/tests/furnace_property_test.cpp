/// Energy: a room whose walls give back what they take has the radiance 1 everywhere, whatever stands in it.

#include "property.h"
#include "random_room.h"

namespace ssphh::test {
namespace {

using testing::AssertionResult;
using testing::AssertionSuccess;

constexpr int cases = 24;

/// Walls that reflect ρ and emit 1 − ρ, each channel its own.
scene::Scene furnace(const vec3& rho) {
  scene::Scene scene;
  add_room(scene, lambertian(rho, 1.0f - rho));
  return scene;
}

trace::RenderState seen(const scene::Scene& scene, std::uint64_t seed) {
  return render(scene, view_of_room(12, 16, 1 << 20, seed));
}

TEST(FurnaceProperty, ABodyThatEmitsWhatItDoesNotReflectCannotBeSeen) {
  EXPECT_TRUE(for_all(seeds(), vectors3(0, 0.9f), vectors3(0, 1))
                  .cases(cases)
                  .holds([](std::uint64_t seed, const vec3& rho, const vec3& albedo) -> AssertionResult {
                    scene::Scene scene = furnace(rho);
                    RoomDraw draw(seed);
                    add_object(scene, draw.body(), lambertian(albedo, 1.0f - albedo), "body");
                    const trace::RenderState state = seen(scene, seed);
                    for (int c = 0; c < 3; ++c) {
                      // Float sums of 16 samples and a bounce's product each: 1e-5.
                      const auto one = mean_is(pixels_of(state.color, c), 1, {1e-3, 3 * cases}, 1e-5);
                      if (!one) return one;
                    }
                    return AssertionSuccess();
                  }));
}

TEST(FurnaceProperty, NoMaterialGivesBackMoreThanItTakes) {
  EXPECT_TRUE(for_all(seeds(), vectors3(0, 0.9f))
                  .cases(cases)
                  .holds([](std::uint64_t seed, const vec3& rho) -> AssertionResult {
                    scene::Scene scene = furnace(rho);
                    RoomDraw draw(seed);
                    add_object(scene, draw.body(), draw.any_material(), "body");
                    const trace::RenderState state = seen(scene, seed);
                    for (int c = 0; c < 3; ++c) {
                      const Samples samples = pixels_of(state.color, c);
                      // 4.5 deviations above 1 come by chance in 3e-6 of the comparisons.
                      const double high = 1 + 4.5 * std::sqrt(samples.variance_of_mean()) + 1e-5;
                      if (const auto bounded = at_most(samples.mean(), high); !bounded) return bounded;
                    }
                    return AssertionSuccess();
                  }));
}

TEST(FurnaceProperty, EveryBounceAddsLightAndAllOfThemStayBelowTheirSeries) {
  EXPECT_TRUE(
      for_all(seeds(), vectors3(0.05f, 0.9f), vectors3(0.1f, 5), integers(0, 6))
          .cases(cases)
          .holds([](std::uint64_t seed, const vec3& rho, const vec3& emission, int depth) -> AssertionResult {
            scene::Scene scene;
            add_room(scene, lambertian(rho, emission));
            RoomDraw draw(seed);
            // Darker than the walls.
            add_object(scene, draw.body(), lambertian(rho * draw.triple(0, 1)), "body");
            trace::RenderParams params = view_of_room(8, 4, depth, seed);
            const image::Image less = render(scene, params).color;
            ++params.path.max_depth;
            const image::Image more = render(scene, params).color;
            for (int c = 0; c < 3; ++c) {
              const double r = static_cast<double>(rho[c]);
              if (const auto rises = at_most(mean_of(less, c), mean_of(more, c) * (1 + 1e-6)); !rises)
                return rises;
              double series = 0;
              for (int n = 0; n <= depth; ++n) series += std::pow(r, n);
              const Samples samples = pixels_of(less, c);
              const double high = series * static_cast<double>(emission[c]) * (1 + 1e-5) +
                                  4.5 * std::sqrt(samples.variance_of_mean());
              if (const auto bounded = at_most(samples.mean(), high); !bounded) return bounded;
            }
            return AssertionSuccess();
          }));
}

}  // namespace
}  // namespace ssphh::test
