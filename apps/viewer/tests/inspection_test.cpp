// The pixel inspector: what stands at a point, and what lights it.

#include "model/inspection.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/scene/primitives.h>

#include "gl_stage.h"
#include "model/lengths.h"
#include "model/objects.h"
#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

probes::ProbeSet lit_set(std::initializer_list<vec3> places) {
  probes::ProbeSet set;
  set.degree = 2;
  set.light_groups.push_back({"all"});
  for (const vec3& place : places) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.name = fmt::format("at {}", place.x);
    probe.position = place;
    sh::RadianceSh light(2);
    // Radiance of 1, 2, … from everywhere: E = π L.
    light[0] = vec3(static_cast<float>(set.probes.size()) / 0.28209479f);
    probe.groups.push_back({light, light});
  }
  probes::merge_groups(set);
  return set;
}

constexpr auto sees_all = [](const vec3&, const vec3&) { return true; };

TEST(Inspection, OfASurfaceTellsWhatStandsThere) {
  const scene::Scene scene = scene::make_builtin("cornell");
  Edits edits = edits_of(scene);
  const rays::RayQuery ray{{0, 1, 3}, {0, 0, -1}};
  const std::vector<mat4> world = scene::world_matrices(scene, 0);
  const auto body = pick_body(scene, world, ray);
  ASSERT_TRUE(body);
  const scene::Instance& instance = scene.instances[body->instance];
  const auto material = static_cast<std::size_t>(scene::instance_material(scene, instance));
  const auto found = inspect_surface(scene, edits, 0, ray);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->distance, body->distance);
  EXPECT_NEAR(found->position.z, 3 - body->distance, 1e-5f);
  EXPECT_NEAR(glm::length(found->normal), 1, 1e-5f);
  EXPECT_GT(found->normal.z, 0) << "toward the eye";
  EXPECT_EQ(found->object, node_name(scene, instance.node));
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found->albedo[c], scene.materials[material].base_color[c], 1e-5f) << "a Lambertian wall";
  edits.materials[material].base_color = {0.1f, 0.2f, 0.3f};
  edits.materials[material].name = "repainted";
  const auto painted = inspect_surface(scene, edits, 0, ray);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(painted->albedo[c], 0.1f * static_cast<float>(c + 1), 1e-5f);
  EXPECT_EQ(painted->material, "repainted");
  EXPECT_FALSE(inspect_surface(scene, edits, 0, {{0, 1, 3}, {0, 0, 1}})) << "nothing behind the eye";
}

TEST(Inspection, OfLightListsProbesByTheirShare) {
  const probes::ProbeSet set = lit_set({{-1, 1, 0}, {1, 1, 0}, {2, 1, 0}});
  probes::LookupParams params;
  params.weights.method = probes::WeightMethod::distance;
  const rays::SurfacePoint at{{0.5f, 0, 0}, {0, 1, 0}, false};
  const InspectedLight light = inspect_light(set, params, at, sees_all);
  EXPECT_FALSE(light.by_records);
  ASSERT_EQ(light.shares.size(), 3u);
  EXPECT_EQ(light.shares[0].name, "at 1");
  EXPECT_EQ(light.shares[2].name, "at 2") << "it stands as far off as the first, but lower";
  float sum = 0, mean = 0;
  for (const LightShare& share : light.shares) {
    sum += share.weight;
    mean += share.weight * (share.name == "at -1" ? 1.0f : share.name == "at 1" ? 2.0f : 3.0f);
  }
  EXPECT_NEAR(sum, 1, 1e-5f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.irradiance[c], pi * mean, 1e-3f * pi * mean);
  // What sees nothing lights nothing.
  const auto sees_left = [](const vec3& a, const vec3& b) { return std::min(a.x, b.x) < 0; };
  const InspectedLight hidden = inspect_light(set, params, at, sees_left);
  ASSERT_EQ(hidden.shares.size(), 1u);
  EXPECT_EQ(hidden.shares[0].name, "at -1");
  EXPECT_NEAR(hidden.irradiance.x, pi, 1e-3f);
}

/// A floor of records whose light grows along x is looked up there as it grows.
TEST(Inspection, OfLightTakesRecordsWhereTheyAreNear) {
  probes::ProbeSet set = lit_set({{0, 1, 0}});
  probes::SurfaceRecords records;
  records.groups.resize(1);
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 20; ++k) {
      const rays::SurfacePoint point{{0.1f * static_cast<float>(i), 0, 0.1f * static_cast<float>(k)}};
      probes::RecordLight light(0);
      light[3] = vec3(1, 2, 3) * (1 + point.position.x);
      records.points.push_back(point);
      records.groups[0].push_back(probes::pack(light, point.normal));
    }
  }
  set.surface = std::move(records);
  probes::merge_groups(set);
  const rays::SurfacePoint at{{0.93f, 0, 0.97f}, {0, 1, 0}, false};
  const InspectedLight light = inspect_light(set, {}, at, sees_all);
  EXPECT_TRUE(light.by_records);
  ASSERT_GT(light.shares.size(), 3u);
  float sum = 0;
  for (std::size_t i = 0; i < light.shares.size(); ++i) {
    sum += light.shares[i].weight;
    if (i > 0) {
      EXPECT_LE(std::abs(light.shares[i].weight), std::abs(light.shares[i - 1].weight));
    }
  }
  EXPECT_NEAR(sum, 1, 1e-2f);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(light.irradiance[c], 1.93f * static_cast<float>(c + 1),
                0.01f * 1.93f * static_cast<float>(c + 1));
  const InspectedLight far = inspect_light(set, {}, {{9, 0, 0}, {0, 1, 0}, false}, sees_all);
  EXPECT_FALSE(far.by_records) << "no record reaches there";
  EXPECT_EQ(far.shares.size(), 1u);
}

using Inspector = PanelStage;

TEST_F(Inspector, FollowsTheMouseUntilAClickPinsIt) {
  take_probes();
  app().settings.weights = probes::WeightMethod::distance;
  press({'I'});
  EXPECT_TRUE(app().inspecting);
  for (int i = 0; i < 4; ++i) mouse(700, 700);
  ASSERT_TRUE(app().inspection && app().inspection->surface);
  EXPECT_EQ(app().inspection->surface->material, "wall");
  // Every row: what it is, and the value beside it, two spaces between its parts.
  const Inspection& now = *app().inspection;
  const auto shows_all = [&](const char* format, const vec3& v) {
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(shows(fmt::format(fmt::runtime(format), v[c]))) << v[c];
  };
  for (const char* name : {"indirect irradiance", "diffuse albedo", "normal", "position [m]", "distance [m]",
                           "object", "material", "lit by probes"})
    EXPECT_TRUE(shows(name)) << name;
  shows_all("{:.4g}", now.light.irradiance);
  shows_all("{:.4g}", now.surface->albedo);
  shows_all("{:.3f}", now.surface->normal);
  const float away = now.surface->distance;
  for (int c = 0; c < 3; ++c) EXPECT_TRUE(shows(length_text(now.surface->position[c], away)));
  EXPECT_TRUE(shows(length_text(away, away)));
  EXPECT_TRUE(shows("wall"));
  ASSERT_GE(now.light.shares.size(), 2u);
  for (const LightShare& share :
       std::span(now.light.shares).first(std::min<std::size_t>(now.light.shares.size(), 6))) {
    EXPECT_TRUE(shows(fmt::format("{:.1f} %", 100 * share.weight)));
    EXPECT_TRUE(shows(share.name)) << share.name;
  }
  const vec3 first = app().inspection->surface->position;
  mouse(620, 720), mouse(620, 720);
  EXPECT_NE(app().inspection->surface->position, first);
  const Selection before = app().selection;
  click(700, 700);
  ASSERT_TRUE(app().pinned);
  EXPECT_EQ(app().selection, before) << "a click pins and selects nothing";
  mouse(620, 720), mouse(620, 720);
  EXPECT_EQ(app().inspection->surface->position, first);
  EXPECT_TRUE(shows("pinned"));
  press({'I'});
  EXPECT_FALSE(app().inspecting || app().pinned);
  EXPECT_FALSE(shows("diffuse albedo"));
}

class InspectedPicture : public GlStage {
 protected:
  void prepare() override {
    options_.settings = {{"exposure", "0"}, {"show", "wipe"}, {"truth-spp", "2"}, {"truth-depth", "1"}};
  }
  void ready() override {}
};

TEST_F(InspectedPicture, TellsRadianceAndTheTruthBeside) {
  app().open("builtin:cornell");
  app().toggle_inspector();
  app().pinned = vec2(0.3f, 0.6f);
  while (!app().settled()) {
    window_->clock += 0.05;
    turn();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  turn();
  ASSERT_TRUE(app().inspection && app().inspection->radiance && app().inspection->truth);
  const int x = 64 * 3 / 10, y = static_cast<int>(0.4f * 48);
  EXPECT_EQ(*app().inspection->radiance, app().picture.linear().rgb(x, y));
  EXPECT_EQ(*app().inspection->truth, app().reference.image().color->rgb(x, y));
  EXPECT_GT(app().inspection->radiance->y, 0);
  // Without a truth there is radiance, too.
  app().settings.show = Show::realtime;
  while (!app().settled()) turn();
  turn();
  ASSERT_TRUE(app().inspection->radiance);
  EXPECT_EQ(*app().inspection->radiance, app().picture.linear().rgb(x, y));
  EXPECT_FALSE(app().inspection->truth);
}

class Views : public PanelStage {
 protected:
  /// The view rests where it is.
  void stay() {
    for (int i = 0; i < 3; ++i) window_->clock += 0.2, app().note_view();
  }
};

TEST_F(Views, ChangesCanBeTakenBack) {
  const View start = start_view(app().document, ""), first = app().view;
  stay();
  app().view = moved(first, {1, 0, 0});
  const View second = app().view;
  stay();
  app().view = moved(second, {0, 1, 0});
  app().note_view();
  app().view = moved(second, {0, 2, 0});
  const View third = app().view;
  app().view_back();
  EXPECT_EQ(app().view, second) << "what was on the way counts for nothing";
  app().view_back();
  EXPECT_EQ(app().view, first);
  for (int i = 0; i < 2; ++i) {
    app().view_back();
    EXPECT_EQ(app().view, start) << "as it began, and no farther";
  }
  app().view_forward();
  EXPECT_EQ(app().view, first);
  app().view_forward();
  EXPECT_EQ(app().view, second);
  const auto press_once = [&](int key) {
    window_->queue.key(key, true), window_->queue.key(key, false);
    frames(3);
  };
  window_->queue.key(GLFW_KEY_LEFT_ALT, true);
  press_once(GLFW_KEY_RIGHT);
  EXPECT_EQ(app().view, third);
  press_once(GLFW_KEY_LEFT);
  EXPECT_EQ(app().view, second);
  EXPECT_FALSE(app().document.dirty()) << "a view is no edit";
}

TEST_F(Views, AlongTheAxes) {
  const vec3 center = app().view.center();
  const float focus = app().view.focus;
  const std::pair<int, vec3> keys[] = {
      {GLFW_KEY_KP_1, {0, 0, -1}}, {GLFW_KEY_KP_3, {-1, 0, 0}}, {GLFW_KEY_KP_7, {0, -1, 0}}};
  for (const auto& [key, direction] : keys) {
    for (const bool opposite : {false, true}) {
      press({key}, opposite);
      const vec3 wanted = opposite ? -direction : direction;
      EXPECT_NEAR(glm::distance(app().view.forward(), wanted), 0, 1e-5f) << key << opposite;
      EXPECT_NEAR(glm::distance(app().view.center(), center), 0, 1e-4f) << "what was looked at stays";
      EXPECT_NEAR(app().view.focus, focus, 1e-4f);
    }
  }
  const float seen = 2 * focus * std::tan(0.5f * app().view.yfov);
  press({GLFW_KEY_KP_5});
  EXPECT_TRUE(app().view.orthographic);
  EXPECT_NEAR(app().view.yheight, seen, 1e-3f) << "as large as before";
  press({GLFW_KEY_KP_5});
  EXPECT_FALSE(app().view.orthographic);
  app().view_back();
  EXPECT_TRUE(app().view.orthographic) << "each can be taken back";
}

}  // namespace
}  // namespace ssphh::viewer
