#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/sun_sky.h>

#include "model/sky_edit.h"

namespace ssphh::viewer {
namespace {

Document house() {
  return make_document("builtin:house", scene::make_builtin("house"), 0);
}

vec3 toward_sun(const Document& document) {
  const int sun = scene::sun_light(*document.scene);
  return vec3(document.lighting().lights.at(static_cast<std::size_t>(sun)).world * vec4(0, 0, 1, 0));
}

TEST(SkyEdit, MovesTheSunWithItsSkyAndIsUndone) {
  Document document = house();
  const scene::LightingState before = document.lighting();
  EXPECT_EQ(before.environment_image, nullptr);
  scene::SunSkyParams sky = shown_sky(document).value();
  sky.elevation = 0.2f, sky.azimuth = 2;
  change_sky(document, sky);
  EXPECT_EQ(shown_sky(document).value(), sky);
  EXPECT_LT(glm::distance(toward_sun(document), scene::sun_direction(sky)), 1e-5f);
  const scene::LightingState now = document.lighting();
  ASSERT_NE(now.environment_image, nullptr);
  EXPECT_EQ(now, document.lighting()) << "asked twice, the light is the same";
  const std::size_t sun = static_cast<std::size_t>(scene::sun_light(*document.scene));
  EXPECT_FLOAT_EQ(now.lights[sun].intensity, max_component(scene::sun_irradiance(sky)));
  document.history.undo();
  EXPECT_EQ(document.lighting(), before);
}

TEST(SkyEdit, ASunThatWasDimmedByHandStaysSo) {
  Document document = house();
  const std::size_t sun = static_cast<std::size_t>(scene::sun_light(*document.scene));
  document.edit("dim", [&](Edits& e) { e.lights[sun].intensity = 3; });
  change_sky(document, at_hour(shown_sky(document).value(), 15));
  EXPECT_EQ(document.lighting().lights[sun].intensity, 3);
  document.edit("off", [&](Edits& e) { e.lights[sun].on = false; });
  EXPECT_EQ(document.lighting().lights[sun].intensity, 0);
}

TEST(SkyEdit, IsInTheSceneThatIsSaved) {
  Document document = house();
  scene::SunSkyParams night = shown_sky(document).value();
  night.model = scene::SkyModel::physical, night.elevation = -0.5f;
  change_sky(document, night);
  const scene::Scene saved = scene_to_save(document);
  EXPECT_EQ(saved.environment.value().equirect.pixels, scene::sky_image(night).pixels);
}

TEST(SkyEdit, PreethamsSunStaysAboveTheHorizon) {
  Document document = house();
  scene::SunSkyParams sky = shown_sky(document).value();
  sky.elevation = -0.5f;
  change_sky(document, sky);
  EXPECT_EQ(shown_sky(document)->elevation, 0);
  const scene::SunSkyParams noon = at_hour(sky, 12);
  EXPECT_NEAR(glm::degrees(noon.elevation), 90 - 48.1 + 23.4, 1);
  EXPECT_EQ(at_hour(noon, 13).time->latitude, noon.time->latitude);
}

TEST(SkyEdit, ScenesWithoutOneHaveNone) {
  EXPECT_FALSE(shown_sky(make_document("builtin:cornell", scene::make_builtin("cornell"), 0)));
}

}  // namespace
}  // namespace ssphh::viewer
