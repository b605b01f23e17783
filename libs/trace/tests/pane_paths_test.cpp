/// Emitters that panes mirror, as paths find them: by closed forms, and as scattered rays alone do.

#include <array>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include <ssphh/shading/glass.h>

#include "hand_made.h"
#include "tracer_data.h"

namespace ssphh::test {
namespace {

using trace::Strategy;

constexpr vec3 tint(0.9f, 0.6f, 0.3f);

scene::Material tinted_glass() {
  scene::Material m;
  m.base_color = tint;
  m.specular_roughness = 0, m.transmission = 1;
  return m;
}

/// A pane that faces +x, from the floor up.
void add_upright_pane(scene::Scene& scene, float x, float height = 2) {
  add_object(scene, scene::make_quad(vec3(x, 0, 1), vec3(0, 0, -2), vec3(0, height, 0)), tinted_glass(),
             "pane");
}

struct Values {
  vec3 sum{0};
  int depth = 0;
  void add(int at, int, const vec3& v, const vec3&) { sum += v, depth = std::max(depth, at); }
  void first_hit(const shading::Surface&, const vec3&, const trace::Ray&, const trace::Hit&) {}
};

/// Means over 16 samples of independent sequences along one ray, channel by channel.
std::array<Samples, 3> light_along(const scene::Scene& scene, const trace::Ray& ray, Strategy strategy,
                                   bool by_panes, int count, int max_depth = 4,
                                   int* deepest_found = nullptr) {
  const trace::TracerData data(std::make_shared<const trace::SceneGeometry>(scene), scene, 0);
  EXPECT_NE(data.panes(), nullptr);
  trace::RayTask task;
  std::array<Samples, 3> samples;
  int deepest = 0;
  for (int i = 0; i < count; ++i) {
    Values values;
    for (std::uint32_t s = 0; s < 16; ++s) {
      trace_path(data.geometry, data.emitters(), ray, {hash_combine(11, static_cast<std::uint64_t>(i)), s},
                 {.max_depth = max_depth, .strategy = strategy, .panes = by_panes ? data.panes() : nullptr},
                 task, values);
    }
    EXPECT_LE(values.depth, max_depth);
    deepest = std::max(deepest, values.depth);
    for (int c = 0; c < 3; ++c) samples[c].add(static_cast<double>(values.sum[c]) / 16);
  }
  EXPECT_EQ(task.invalid, 0u);
  if (deepest_found) *deepest_found = deepest;
  return samples;
}

/// A lamp, a body, a sky; last a lamp and a sky.
constexpr int kinds = 4, sky = 2, lamp_and_sky = 3;

void add_emitter(scene::Scene& scene, int kind) {
  if (kind == lamp_and_sky) add_emitter(scene, sky);
  if (kind == 0 || kind == lamp_and_sky) {
    add_light(scene, scene::LightType::sphere, 3, vec3(1.2f, 1, 0.3f)).radius = 0.4f;
  } else if (kind == 1) {
    add_object(scene, scene::make_box(vec3(1, 0.6f, -0.2f), vec3(1.3f, 1, 0.2f)),
               lambertian(vec3(0), vec3(3, 2, 1)), "glowing");
  } else {
    add_constant_sky(scene, vec3(1, 2, 3));
  }
}

// Between panes, one of them behind something; on floors that scatter in all directions and in few.
TEST(PanePaths, FindWhatScatteredRaysFind) {
  for (int kind = 0; kind < kinds; ++kind) {
    for (const bool glossy : {false, true}) {
      SCOPED_TRACE(testing::Message() << "emitter " << kind << (glossy ? ", glossy" : ""));
      scene::Scene scene;
      scene::Material floor = lambertian(vec3(0.6f, 0.5f, 0.4f));
      if (glossy) floor.metallic = 1, floor.specular_roughness = 0.45f;
      add_floor(scene, floor);
      add_upright_pane(scene, 0), add_upright_pane(scene, 2, 1.2f);
      add_object(scene, scene::make_box(vec3(1.5f, 0, -1), vec3(1.6f, 0.3f, 0)), lambertian(vec3(0.5f)));
      add_emitter(scene, kind);
      const trace::Ray ray{vec3(0.7f, 0.6f, 0.4f), glm::normalize(vec3(-0.1f, -1, -0.2f))};
      const auto both = light_along(scene, ray, Strategy::mis, true, 2500);
      const auto by_rays = light_along(scene, ray, Strategy::mis, false, 2500);
      const auto rays_alone = light_along(scene, ray, Strategy::bsdf_only, true, 2500);
      for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(means_agree(both[c], by_rays[c], {1e-3, 36}, 1e-6)) << c;
        EXPECT_TRUE(means_agree(both[c], rays_alone[c], {1e-3, 36}, 1e-6)) << c;
        const double most = kind >= sky ? 1.25 : 1;  // a wide sky gains nothing
        EXPECT_LT(both[c].variance_of_mean(), most * by_rays[c].variance_of_mean()) << c;
      }
    }
  }
}

/// A sun, half a degree wide, that shines down on the floor and into a pane.
scene::Scene sunny(float angle = 0.005f) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.6f, 0.5f, 0.4f)));
  add_upright_pane(scene, 0);
  add_light(scene, scene::LightType::directional, 3, vec3(0), vec3(-1, -1, 0)).angular_radius = angle;
  return scene;
}

TEST(PanePaths, ASunInAPaneIsFoundByFew) {
  const scene::Scene scene = sunny();
  const trace::Ray down{vec3(0.7f, 0.5f, 0), vec3(0, -1, 0)};
  int deepest = 0;
  const auto found = light_along(scene, down, Strategy::mis, true, 64, 2, &deepest);
  EXPECT_EQ(deepest, 2) << "to the pane, and from there";
  const float cosine = std::sqrt(0.5f);
  const vec3 mirrored = shading::sheet_reflectance({.share = 1, .tint = tint}, cosine);
  const vec3 expected = vec3(0.6f, 0.5f, 0.4f) / pi * 3.0f * cosine * (vec3(1) + mirrored);
  const auto direct = light_along(scene, down, Strategy::mis, true, 64, 1);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(found[c].mean() / static_cast<double>(expected[c]), 1, 5e-3) << c;  // over the sun's extent
    EXPECT_LT(std::sqrt(found[c].variance_of_mean()), 2e-3 * found[c].mean()) << c;
    const auto straight = static_cast<double>(expected[c] / (1 + mirrored[c]));
    EXPECT_NEAR(direct[c].mean() / straight, 1, 5e-3) << "what is mirrored has depth 2";
  }
}

// Light that goes down through a rough sheet meets the lower half of a pane whose upper half is above it.
TEST(PanePaths, FindWhatGoesThroughARoughSheet) {
  scene::Scene scene;
  scene::Material frosted = tinted_glass();
  frosted.specular_roughness = 0.6f;
  add_object(scene, scene::make_quad(vec3(0.01f, 1, 2), vec3(3, 0, 0), vec3(0, 0, -4)), frosted, "sheet");
  add_upright_pane(scene, 0);
  add_light(scene, scene::LightType::sphere, 3, vec3(1.2f, 0.3f, 0.3f)).radius = 0.25f;
  const trace::Ray ray{vec3(0.5f, 1.5f, 0), glm::normalize(vec3(-0.05f, -1, 0))};
  const auto both = light_along(scene, ray, Strategy::mis, true, 4000);
  const auto by_rays = light_along(scene, ray, Strategy::mis, false, 4000);
  for (int c = 0; c < 3; ++c) EXPECT_TRUE(means_agree(both[c], by_rays[c], {1e-3, 3}, 1e-6)) << c;
}

TEST(PanePaths, PicturesAndProbesFindIt) {
  const scene::Scene scene = sunny();
  const float cosine = std::sqrt(0.5f);
  const vec3 mirrored = shading::sheet_reflectance({.share = 1, .tint = tint}, cosine);
  const vec3 direct = vec3(0.6f, 0.5f, 0.4f) / pi * 3.0f * cosine;
  const trace::RenderState state = render(scene, view_point(vec3(0.7f, 0, 0), 4, 2));
  for (int c = 0; c < 3; ++c) {
    const auto channel = static_cast<double>(direct[c] * (1 + mirrored[c]));
    EXPECT_NEAR(mean_of(state.color, c) / channel, 1, 5e-3) << c;
  }
  // The texels right below a probe, above the spot
  rays::CubeRequest request;
  request.position = vec3(0.7f, 0.05f, 0), request.face_size = 8;
  request.path = {.max_depth = 2, .passes = 1, .spp = 16, .seed = 1};
  const auto groups = trace::PathTracer(scene).incident_radiance(request, {});
  const int down = 3;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(groups[0].reflected.faces[down].rgb(4, 4)[c] / (direct[c] * (1 + mirrored[c])), 1, 1e-2f)
        << c;
  }
}

TEST(PanePaths, PointsOfSurfacesFindItToo) {
  const scene::Scene scene = sunny();
  const rays::SurfacePoint lit{vec3(0.7f, 0, 0), vec3(0, 1, 0)}, beyond{vec3(2.5f, 0, 0), vec3(0, 1, 0)},
      behind{vec3(-0.7f, 0, 0), vec3(0, 1, 0)};
  const std::vector<rays::SurfacePoint> points{lit, beyond, behind};
  const auto found = trace::PathTracer(scene).surface_irradiance(points, {.max_depth = 2, .spp = 256}, {});
  const float cosine = std::sqrt(0.5f);
  const vec3 mirrored = shading::sheet_reflectance({.share = 1, .tint = tint}, cosine);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(found[0].indirect[c] / (3 * cosine * mirrored[c]), 1, 1e-2f) << c;
    EXPECT_EQ(found[1].indirect[c], 0) << "its mirror image lies above the pane";
    EXPECT_EQ(found[2].indirect[c], 0) << "the pane's other side";
  }
  const auto direct = trace::PathTracer(scene).surface_irradiance(points, {.max_depth = 1, .spp = 64}, {});
  EXPECT_EQ(direct[0].indirect, vec3(0)) << "mirrored light has come by one scattering event more";
}

TEST(PanePaths, ChancesOfAllPanesAreThatOfAny) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  for (int i = 0; i < 5; ++i) add_upright_pane(scene, static_cast<float>(i));
  const trace::TracerData data(std::make_shared<const trace::SceneGeometry>(scene), scene, 0);
  const trace::PaneMirrors& mirrors = *data.panes();
  const vec3 up(0, 1, 0);
  for (const vec3& at : {vec3(1.3f, 0, 0), vec3(-30, 0, 0), vec3(2, 0.5f, 0)}) {
    std::map<const trace::Pane*, int> taken;
    constexpr int draws = 20000;
    for (int i = 0; i < draws; ++i) {
      const auto choice = mirrors.choose(at, up, (static_cast<float>(i) + 0.5f) / draws);
      if (!choice.pane) continue;
      ++taken[choice.pane];
      EXPECT_FLOAT_EQ(choice.chance, mirrors.chance(at, up, *choice.pane));
    }
    ASSERT_FALSE(taken.empty());
    for (const auto& [pane, count] : taken)
      EXPECT_NEAR(static_cast<float>(count) / draws, mirrors.chance(at, up, *pane), 1e-3f);
    EXPECT_EQ(taken.size(), at.x == 2 ? 4u : 5u) << "one that the point lies in mirrors nothing to it";
  }
}

TEST(PanePaths, OfVeryManyTheLargestAreAsked) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  for (int i = 0; i < 300; ++i) add_upright_pane(scene, 0.1f * static_cast<float>(i), i < 44 ? 1.0f : 2.0f);
  const trace::TracerData data(std::make_shared<const trace::SceneGeometry>(scene), scene, 0);
  std::set<const trace::Pane*> asked;
  for (int i = 0; i < 20000; ++i) {
    const auto choice =
        data.panes()->choose(vec3(-1, 0, 0), vec3(0, 1, 0), (static_cast<float>(i) + 0.5f) / 20000);
    ASSERT_NE(choice.pane, nullptr);
    EXPECT_GT(choice.pane->area, 3) << "a small one";
    asked.insert(choice.pane);
  }
  EXPECT_EQ(asked.size(), trace::PaneMirrors::most_panes);
  EXPECT_EQ(data.panes()->at({1, 0, {}, 0}), nullptr) << "a small one is left to scattered rays";
  EXPECT_NE(data.panes()->at({300, 0, {}, 0}), nullptr);
}

TEST(PanePaths, BentAndCutOutPanesAreLeftToScatteredRays) {
  scene::Scene scene = sunny();
  const auto mirrors = [&] {
    const trace::TracerData data(std::make_shared<const trace::SceneGeometry>(scene), scene, 0);
    return data.panes() != nullptr;
  };
  EXPECT_TRUE(mirrors());
  scene.materials[1].alpha_mode = scene::AlphaMode::blend;
  EXPECT_FALSE(mirrors());
  scene.materials[1].alpha_mode = scene::AlphaMode::opaque;
  scene.meshes[1].normals = {vec3(1, 0, 0), vec3(1, 0, 0), glm::normalize(vec3(1, 0.2f, 0)), vec3(1, 0, 0)};
  EXPECT_FALSE(mirrors());
  scene.meshes[1].normals.assign(4, glm::normalize(vec3(1, 0.2f, 0)));
  EXPECT_FALSE(mirrors()) << "all of them lean";
  scene.meshes[1].normals.assign(4, vec3(-1, 0, 0));
  EXPECT_TRUE(mirrors()) << "a pane has two sides";
}

// A sun fills a pane that looks small as well.
TEST(PanePaths, ADistantPaneIsFoundByFewToo) {
  scene::Scene scene = sunny();
  add_object(scene, scene::make_quad(vec3(29, 0, 0.5f), vec3(2, 0, 0), vec3(0, 0.6f, 0)), tinted_glass());
  scene.lights[0].node = add_node(scene, "low sun", vec3(0), looking(vec3(-30, -1, 0)));
  const trace::Ray down{vec3(30, 0.5f, 0), vec3(0, -1, 0)};
  const auto found = light_along(scene, down, Strategy::mis, true, 64, 2);
  const auto direct = light_along(scene, down, Strategy::mis, true, 64, 1);
  const vec3 mirrored = shading::sheet_reflectance({.share = 1, .tint = tint}, 1);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found[c].mean() / direct[c].mean() - 1, static_cast<double>(mirrored[c]), 5e-3) << c;
}

}  // namespace
}  // namespace ssphh::test
