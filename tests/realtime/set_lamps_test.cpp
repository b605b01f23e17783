/// Other lamps in a renderer that is there: the pictures of one that was made with them, and what it takes.

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/sun_sky.h>

#include "change_lighting.h"
#include "error_message.h"
#include "gl_context.h"
#include "pictures.h"

namespace ssphh::test {
namespace {

using realtime::Renderer;

class SetLamps : public WithGl {
 protected:
  SetLamps() : scene_(scene::make_builtin("two-rooms")) {
    scene_.materials[2].emission = vec3(3, 2, 1);
    scene::SunSkyParams sky;
    sky.width = 32;
    scene::add_sun_sky(scene_, sky);
    scene::validate(scene_);
  }

  /// A spot with a profile and a ball come, another lamp goes; groups that come and go number the others
  /// anew.
  scene::Scene with_other_lamps() const {
    scene::Scene other = scene_;
    other.lights.erase(other.lights.begin());
    for (const auto type : {scene::LightType::spot, scene::LightType::sphere}) {
      scene::Light light;
      light.name = name_of(type), light.group = "new";
      light.type = type, light.radius = 0.1f, light.intensity = 30, light.color = {1, 0.5f, 0.2f};
      light.node = static_cast<int>(other.nodes.size());
      other.nodes.emplace_back().local.translation = {-2, 2, 0.5f};
      if (type == scene::LightType::spot)
        light.profile = {"p",
                         std::make_shared<const scene::PhotometricTable>(scene::PhotometricTable{
                             scene::Photometry::c, {0, 30, 90}, {0, 180, 360}, {1, 5, 2, 1, 0, 3, 1, 5, 2}})};
      other.lights.insert(other.lights.begin(), light);
    }
    scene::validate(other);
    return other;
  }

  static image::Image draw(Renderer& renderer, const scene::Scene& scene) {
    renderer.draw(scene::camera_pose(scene, ""), {}, {.width = 48, .height = 27});
    return renderer.read_back();
  }
  Renderer make(const scene::Scene& scene) {
    return Renderer(gl(), scene,
                    {.light_map_size = 64,
                     .area_map_size = 16,
                     .sun_map_size = 64,
                     .environment_map_size = 64,
                     .environment_samples = 4});
  }

  scene::Scene scene_;
};

TEST_F(SetLamps, GivesThePicturesOfARendererMadeWithThem) {
  const scene::Scene other = with_other_lamps();
  const probes::ProbeSet probes = made_up_probes(scene_);
  Renderer before = make(scene_), after = make(other), changed = make(scene_);
  for (Renderer* renderer : {&before, &after, &changed}) renderer->set_probes(probes);
  const image::Image own = draw(changed, scene_);
  EXPECT_EQ(own.pixels, draw(before, scene_).pixels);
  changed.set_lamps(other);
  EXPECT_EQ(changed.lighting(), after.lighting());
  const image::Image now = draw(changed, scene_);
  EXPECT_EQ(now.pixels, draw(after, scene_).pixels);
  EXPECT_NE(now.pixels, own.pixels);
  // Factors of groups reach surfaces that glow and lamps under their new numbers.
  const auto dim = [](auto& state) {
    for (std::size_t g = 0; g < state.group_scales.size(); ++g)
      state.group_scales[g] = vec3(0.3f * float(g + 1));
  };
  change_lighting(changed, dim), change_lighting(after, dim);
  EXPECT_EQ(draw(changed, scene_).pixels, draw(after, scene_).pixels);
  changed.set_lamps(scene_);
  EXPECT_EQ(draw(changed, scene_).pixels, own.pixels) << "and back again, factors of before gone";
}

TEST_F(SetLamps, AFlatLampOfAnotherSizeHasItsOwnLightAndShadows) {
  // As many shadow maps as before, at other places
  const auto with_lamp = [&](scene::LightType type, const vec2& size) {
    scene::Scene scene = scene_;
    scene::Light& lamp = scene.lights.emplace_back();
    lamp.name = "flat", lamp.type = type, lamp.size = size, lamp.radius = 0.4f, lamp.intensity = 30;
    lamp.node = static_cast<int>(scene.nodes.size());
    scene.nodes.emplace_back().local = {{-2, 2, 0.5f}, glm::angleAxis(-1.2f, vec3(1, 0, 0)), vec3(1)};
    scene::validate(scene);
    return scene;
  };
  const scene::Scene small = with_lamp(scene::LightType::rectangle, {0.2f, 0.1f}),
                     large = with_lamp(scene::LightType::rectangle, {1.2f, 0.5f}),
                     disc = with_lamp(scene::LightType::disc, {});
  Renderer changed = make(small);
  const image::Image before = draw(changed, scene_);
  for (const scene::Scene* other : {&large, &disc, &small}) {
    changed.set_lamps(*other);
    Renderer fresh = make(*other);
    EXPECT_EQ(draw(changed, scene_).pixels, draw(fresh, scene_).pixels);
    EXPECT_EQ(draw(changed, scene_).pixels == before.pixels, other == &small);
  }
}

TEST_F(SetLamps, KeepsTimeEnvironmentAndGlowingProbes) {
  const scene::Scene other = with_other_lamps();
  const auto state = [&](auto& now) {
    now.time = 0.5f;
    now.environment_rotation = 1;
    now.environment_image = std::make_shared<image::Image>(8, 4, 3);
    for (float& v : std::const_pointer_cast<image::Image>(now.environment_image)->pixels) v = 0.25f;
    now.emission = {{0, sh::RadianceSh(0)}};
    now.emission[0].leaving[0] = vec3(1, 2, 3);
  };
  Renderer changed = make(scene_), after = make(other);
  for (Renderer* renderer : {&changed, &after}) renderer->set_probes(made_up_probes(scene_));
  change_lighting(changed, state), change_lighting(after, state);
  draw(changed, scene_);
  changed.set_lamps(other);
  EXPECT_EQ(changed.lighting().time, 0.5f);
  EXPECT_EQ(changed.lighting().emission, after.lighting().emission);
  EXPECT_EQ(draw(changed, scene_).pixels, draw(after, scene_).pixels);
}

// Nobody asked for maps of what probes hold; once they are gone, they are drawn.
TEST_F(SetLamps, DrawsTheMapsThatBakedGroupsDidNotNeed) {
  probes::ProbeSet baked = made_up_probes(scene_);
  baked.light_groups[0] = {scene::light_groups(scene_)[0], vec3(1), scene::LightMode::baked};
  scene::Scene other = scene_;
  other.lights[0].intensity *= 2;
  Renderer changed = make(scene_), after = make(other);
  changed.set_probes(baked);
  draw(changed, scene_);
  changed.set_lamps(other);
  changed.clear_probes();
  EXPECT_EQ(draw(changed, scene_).pixels, draw(after, scene_).pixels);
}

// What stands still in the light of what stands still is drawn once, glass before it included.
class KeptMaps : public SetLamps {
 protected:
  /// Draws with these lamps, and tells how many maps that took; the picture is that of a fresh renderer.
  int drawn_with(Renderer& renderer, const scene::Scene& scene) {
    renderer.set_lamps(scene);
    const image::Image picture = draw(renderer, scene);
    const int maps = renderer.stats().shadow_maps_drawn;
    Renderer fresh = make(scene);
    fresh.set(renderer.lighting());
    draw(fresh, scene);  // the sun's follow what the first one saw
    EXPECT_EQ(picture.pixels, draw(fresh, scene).pixels);
    EXPECT_EQ(renderer.lighting(), fresh.lighting());
    return maps;
  }
  /// As `scene`, with another lamp before all others, aside of them.
  static scene::Scene with(scene::Scene scene, scene::LightType type) {
    scene::Light lamp;
    lamp.type = type, lamp.radius = 0.1f, lamp.intensity = 20;
    lamp.node = static_cast<int>(scene.nodes.size());
    scene::Node& node = scene.nodes.emplace_back();
    node.local.translation = {-1.5f, 1.5f, 0.3f * static_cast<float>(scene.lights.size())};
    node.local.rotation = glm::angleAxis(-1.1f, vec3(1, 0, 0));
    scene.lights.insert(scene.lights.begin(), lamp);
    scene::validate(scene);
    return scene;
  }
  Renderer drawn() {
    Renderer renderer = make(scene_);
    draw(renderer, scene_), draw(renderer, scene_);
    return renderer;
  }
  static constexpr int cube = 6, ball = 8 * cube, cascades = 6;
};

TEST_F(KeptMaps, OfALampThatComesItsOwnAloneAreDrawn) {
  using enum scene::LightType;
  Renderer renderer = drawn();
  const scene::Scene one = with(scene_, point), two = with(one, sphere), three = with(two, sphere);
  EXPECT_EQ(drawn_with(renderer, one), cube);
  EXPECT_EQ(drawn_with(renderer, two), ball);
  EXPECT_EQ(drawn_with(renderer, three), ball);
  EXPECT_EQ(drawn_with(renderer, with(three, directional)), cascades);
}

TEST_F(KeptMaps, WhenALampGoesNoneIsDrawn) {
  using enum scene::LightType;
  scene_ = with(with(scene_, directional), sphere);
  const scene::Scene many = with(with(with(scene_, point), sphere), directional);
  Renderer renderer = make(many);
  draw(renderer, many), draw(renderer, many);
  EXPECT_EQ(drawn_with(renderer, scene_), 0);
  renderer.set_lamps(many);
  EXPECT_EQ(drawn_with(renderer, scene_), 0) << "there and back before a frame";
}

TEST_F(KeptMaps, HaveTheirGlass) {
  scene::Material& pane = scene_.materials[0];
  pane.transmission = 1, pane.base_color = {0.5f, 0.9f, 0.7f};
  ASSERT_TRUE(pane.is_glass());
  Renderer renderer = drawn();
  EXPECT_EQ(drawn_with(renderer, with(scene_, scene::LightType::point)), cube);
}

// What changes between other lamps and the next frame changes the maps of before.
TEST_F(KeptMaps, SeeADoorThatMovedMeanwhile) {
  const scene::Scene other = with(scene_, scene::LightType::point);
  Renderer renderer = drawn(), after = make(other);
  renderer.set_lamps(other);
  const auto open = [](auto& state) { state.time = 0.5f; };
  change_lighting(renderer, open), change_lighting(after, open);
  draw(after, other);
  EXPECT_EQ(draw(renderer, other).pixels, draw(after, other).pixels);
  EXPECT_GT(renderer.stats().shadow_maps_drawn, cube);
}

TEST_F(SetLamps, UploadsLampsAlone) {
  scene::Scene large = scene_;
  // Five thousand triangles more
  scene::Mesh& mesh = large.meshes[0];
  const std::vector<uvec3> own = mesh.triangles;
  while (mesh.triangles.size() < 5'000) mesh.triangles.insert(mesh.triangles.end(), own.begin(), own.end());
  Renderer renderer = make(large);
  const auto bytes = [&] {
    renderer.draw(scene::camera_pose(large, ""), {}, {.width = 8, .height = 4});
    return renderer.stats().bytes_uploaded;
  };
  EXPECT_GT(bytes(), 100'000u);
  scene::Scene other = large;
  other.lights.push_back(other.lights[0]);
  renderer.set_lamps(other);
  EXPECT_LT(bytes(), 60'000u);
}

TEST_F(SetLamps, OfAnotherSceneOrTooManyAreRefusedAndEverythingStays) {
  Renderer renderer = make(scene_);
  const image::Image before = draw(renderer, scene_);
  scene::Scene other = scene_;
  other.instances.pop_back();
  const std::string strange = "lamps: they are of a scene with other geometry";
  EXPECT_EQ(message_of([&] { renderer.set_lamps(other); }), strange);
  other = scene_, other.instances[0].node = other.instances[1].node + 1;
  EXPECT_EQ(message_of([&] { renderer.set_lamps(other); }), strange);
  other = scene_, other.materials.emplace_back();
  EXPECT_EQ(message_of([&] { renderer.set_lamps(other); }), strange);
  other = scene_, other.lights[0].node = 10'000;
  EXPECT_NE(message_of([&] { renderer.set_lamps(other); }), "no error");
  other = scene_;
  scene::Light sun;
  sun.type = scene::LightType::directional, sun.node = 0;
  other.lights.insert(other.lights.end(), 100, sun);
  EXPECT_THAT(message_of([&] { renderer.set_lamps(other); }), testing::HasSubstr("parallel shadow maps"));
  EXPECT_EQ(draw(renderer, scene_).pixels, before.pixels);
}

}  // namespace
}  // namespace ssphh::test
