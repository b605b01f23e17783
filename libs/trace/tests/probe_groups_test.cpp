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

/// Light of which some groups' direct light is part.
class WithDirect final : public rays::IndirectLight {
 public:
  explicit WithDirect(std::vector<std::string> groups) : groups_(std::move(groups)) {}
  vec3 irradiance(const rays::SurfacePoint&) const override { return pi * probe_light; }
  vec3 glossy(const rays::SurfacePoint&, const vec3&, float) const override { return probe_light; }
  std::vector<std::string> direct_groups() const override { return groups_; }

 private:
  std::vector<std::string> groups_;
};

trace::RenderState render_with_direct(const scene::Scene& scene, const trace::RenderParams& params,
                                      std::vector<std::string> groups) {
  trace::RenderState state;
  trace::PathTracer(scene).render_with(WithDirect(std::move(groups)), params, state);
  return state;
}

TEST(RenderWithDirect, SamplesNothingOfGroupsThatAreLookedUp) {
  const scene::Scene scene = coloured_lamps();
  const trace::RenderParams params = inside_view(2, 8);
  const trace::PathTracer tracer(scene);
  for (std::size_t held = 0; held < 3; ++held) {
    const std::vector<std::string>& names = tracer.light_groups();
    SCOPED_TRACE(names[held]);
    const trace::RenderState all = render_with_direct(scene, params, {});
    const trace::RenderState some = render_with_direct(scene, params, {names[held]});
    // What of the group is left is what the eye sees of its emitter.
    trace::RenderParams seen = params;
    seen.path.max_depth = 0;
    trace::RenderState emitters;
    tracer.render(seen, emitters);
    for (std::size_t g = 0; g < 3; ++g) {
      Samples difference;
      const image::Image &truth = g == held ? emitters.groups[g] : all.groups[g], &image = some.groups[g];
      for (std::size_t i = 0; i < image.pixels.size(); ++i)
        difference.add(static_cast<double>(image.pixels[i] - truth.pixels[i]));
      if (g == held) {
        EXPECT_EQ(difference.variance(), 0) << "nothing of it has noise";
        EXPECT_EQ(difference.mean(), 0);
      } else {
        EXPECT_TRUE(mean_is(difference, 0, {1e-3, 6}, 1e-5)) << names[g] << ": light of others stays";
      }
    }
    for (std::size_t i = 0; i < all.color.pixels.size(); ++i)
      ASSERT_NEAR(some.indirect.pixels[i], all.indirect.pixels[i], rounding) << "the lookup is added once";
  }
}

TEST(RenderWithDirect, SamplesAllWhereNothingIsLookedUp) {
  // At depth 1 a picture is of direct light, which must not be lost because a lookup would have it.
  const scene::Scene scene = coloured_lamps();
  const trace::RenderParams params = inside_view(1, 2);
  const trace::RenderState all = render_with_direct(scene, params, {});
  EXPECT_EQ(render_with_direct(scene, params, {"panel", "bulb", "globe"}).color.pixels, all.color.pixels);
}

TEST(RenderWithDirect, HasNoNoiseWhereAllGroupsAreLookedUp) {
  const scene::Scene scene = coloured_lamps();
  trace::RenderParams params = inside_view(2, 1);
  const std::vector<std::string> all = trace::PathTracer(scene).light_groups();
  const image::Image first = render_with_direct(scene, params, all).direct;
  params.path.max_depth = 0;
  trace::RenderState emitters;
  trace::PathTracer(scene).render(params, emitters);
  EXPECT_EQ(first.pixels, emitters.color.pixels) << "emitters as the eye sees them, and nothing else";
}

}  // namespace
}  // namespace ssphh::test
