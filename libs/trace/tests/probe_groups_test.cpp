/// Pictures lit by probes: what of them belongs to the light groups, and what is looked up.

#include <gtest/gtest.h>

#include "hand_made.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

/// The same light from everywhere: radiance `light`, or `moving` at bodies that move.
class EvenLight final : public rays::IndirectLight {
 public:
  explicit EvenLight(const vec3& light, const vec3& moving = vec3(0)) : light_(light), moving_(moving) {}
  vec3 irradiance(const rays::SurfacePoint& at) const override { return pi * glossy(at, {}, 0); }
  vec3 glossy(const rays::SurfacePoint& at, const vec3&, float) const override {
    return at.moves ? moving_ : light_;
  }

 private:
  vec3 light_, moving_;
};

/// Three lamps of three colours, one of them a glowing square: passes differ.
scene::Scene coloured_lamps() {
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.2f, 0.5f, 0.7f)));
  add_object(scene, scene::make_quad(vec3(-0.4f, 0.95f, -0.4f), vec3(0.8f, 0, 0), vec3(0, 0, 0.8f)),
             lambertian(vec3(0), vec3(1, 5, 2)), "panel");
  add_light(scene, scene::LightType::point, 1, vec3(-0.6f), vec3(0, -1, 0), "bulb").color =
      vec3(0.1f, 0.4f, 2);
  scene::Light& globe =
      add_light(scene, scene::LightType::sphere, 3, vec3(0.6f, 0.3f, 0.4f), vec3(0, -1, 0), "globe");
  globe.radius = 0.1f, globe.color = vec3(2, 0.3f, 0.7f);
  return scene;
}

trace::RenderParams inside_view(int max_depth, int passes) {
  trace::RenderParams params;
  params.projection = trace::Projection::equirect;
  params.width = 16, params.height = 8;
  params.camera.world = look_at(vec3(0.1f, 0.2f, 0.3f), vec3(0));
  params.path = {max_depth, passes, 3, 5};
  params.per_group = true;
  return params;
}

const vec3 probe_light(0.3f, 1.1f, 0.6f);

trace::RenderState render_with_probes(const scene::Scene& scene, const trace::RenderParams& params) {
  trace::RenderState state;
  trace::PathTracer(scene).render_with(EvenLight(probe_light), params, state);
  return state;
}

/// Sums of a few passes in another order: 1e-6 of the picture's largest values.
constexpr float rounding = 1e-5f;

void expect_probes_picture(const trace::RenderState& state, int passes) {
  ASSERT_EQ(state.passes_done, passes);
  ASSERT_EQ(state.groups.size(), 3u);
  for (std::size_t i = 0; i < state.color.pixels.size(); ++i) {
    float sum = 0;
    for (const image::Image& group : state.groups) sum += group.pixels[i];
    ASSERT_NEAR(sum, state.direct.pixels[i], rounding) << "groups and direct light, float " << i;
    ASSERT_NEAR(sum + state.indirect.pixels[i], state.color.pixels[i], rounding)
        << "groups, the probes' light and the picture, float " << i;
    // Even light L leaves ρ L, once in every pass.
    const auto c = static_cast<int>(i % 3);
    ASSERT_NEAR(state.indirect.pixels[i], state.albedo.pixels[i] * probe_light[c], rounding) << "float " << i;
  }
}

TEST(ProbeGroups, AndTheProbesLightAddUpToThePicture) {
  for (const int passes : {1, 4}) {
    SCOPED_TRACE(passes);
    expect_probes_picture(render_with_probes(coloured_lamps(), inside_view(3, passes)), passes);
  }
}

TEST(ProbeGroups, HoldTheBitsOfDirectLightWithoutProbes) {
  const scene::Scene scene = coloured_lamps();
  const trace::RenderState probes = render_with_probes(scene, inside_view(3, 4));
  const trace::RenderState direct = render(scene, inside_view(1, 4));
  ASSERT_EQ(probes.groups.size(), direct.groups.size());
  for (std::size_t g = 0; g < direct.groups.size(); ++g) {
    EXPECT_GT(mean_of(direct.groups[g], 0), 1e-3);
    EXPECT_EQ(probes.groups[g].pixels, direct.groups[g].pixels) << "group " << g;
  }
}

TEST(ProbeGroups, SavedAndResumedAreThoseOfAnUninterruptedRender) {
  const scene::Scene scene = coloured_lamps();
  const TempDir folder;
  const trace::RenderState first = render_with_probes(scene, inside_view(3, 1));
  trace::save_state(first, folder / "state");
  trace::RenderState resumed = trace::load_state(folder / "state", first.key);
  trace::PathTracer(scene).render_with(EvenLight(probe_light), inside_view(3, 4), resumed);
  expect_probes_picture(resumed, 4);
  const trace::RenderState whole = render_with_probes(scene, inside_view(3, 4));
  EXPECT_EQ(resumed.color.pixels, whole.color.pixels);
  for (std::size_t g = 0; g < whole.groups.size(); ++g)
    EXPECT_EQ(resumed.groups[g].pixels, whole.groups[g].pixels) << "group " << g;
}

TEST(ProbeGroups, DepthOneLeavesTheProbesLightOut) {
  const trace::RenderState state = render_with_probes(coloured_lamps(), inside_view(1, 2));
  EXPECT_GT(mean_of(state.direct, 1), 0.01);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(mean_of(state.indirect, c), 0);
}

}  // namespace
}  // namespace ssphh::test
