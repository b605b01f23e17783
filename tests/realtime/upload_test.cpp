/// What changes cost: bytes sent, maps drawn, memory taken.

#include <gmock/gmock.h>

#include <ssphh/shading/bsdf.h>

#include "change_lighting.h"
#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

using realtime::FrameSettings;
using realtime::FrameStats;
using realtime::Renderer;
using realtime::RendererParams;

/// Of blocks as shaders read them.
constexpr std::uint64_t frame_block = 13 * 16, material_block = 16 * 16, instance_block = 9 * 16,
                        emitter_block = (6 + 64 * 3 + 121) * 16;
const RendererParams small{
    .light_map_size = 16, .area_map_size = 16, .sun_map_size = 16, .environment_map_size = 16};

class Uploads : public WithGl {
 protected:
  const FrameStats& frame(Renderer& renderer, const scene::Scene& scene, const vec3& aside = vec3(0)) {
    scene::CameraPose pose = scene::camera_pose(scene, "");
    pose.world[3] += vec4(aside, 0);
    return renderer.draw(pose, {}, {.width = 8, .height = 4});
  }
  /// Bytes of the first frame after `change`, beside those of every frame.
  template <class Change>
  std::uint64_t bytes_of(Renderer& renderer, const scene::Scene& scene, const Change& change) {
    frame(renderer, scene);
    EXPECT_EQ(frame(renderer, scene).bytes_uploaded, frame_block);
    change();
    const std::uint64_t bytes = frame(renderer, scene).bytes_uploaded - frame_block;
    EXPECT_EQ(frame(renderer, scene).bytes_uploaded, frame_block) << "and nothing again";
    return bytes;
  }
  std::size_t memory_of(const scene::Scene& scene) { return Renderer(gl(), scene, small).memory_bytes(); }
};

TEST_F(Uploads, AreThoseOfTheBlocksThatChange) {
  scene::Scene s = stage(matte(vec3(0.5f)));
  s.materials[3].emission = vec3(1);
  s.instances[3].light_group = "glow";
  add_stage_lamp(s, {});
  scene::AnimationChannel moves;
  moves.node = 2, moves.times = {0, 1}, moves.values = {vec4(-1, 0, -0.5f, 0), vec4(-1, 0, 0.5f, 0)};
  s.animations.push_back({"box", {moves}});
  scene::validate(s);
  Renderer renderer(gl(), s, small);
  EXPECT_EQ(bytes_of(renderer, s, [] {}), 0u);
  EXPECT_EQ(bytes_of(renderer, s, [&] { renderer.set_material(1, s.materials[2]); }), material_block);
  EXPECT_EQ(bytes_of(renderer, s, [&] { change_lighting(renderer, [](auto& state) { state.time = 0.5f; }); }),
            instance_block);
  EXPECT_EQ(bytes_of(renderer, s, [&] { change_lighting(renderer, [](auto& state) { state.time = 0.5f; }); }),
            0u);
  const auto dim = [](auto& state) { state.lights[0].intensity = 3; };
  EXPECT_EQ(bytes_of(renderer, s, [&] { change_lighting(renderer, dim); }), emitter_block);
  EXPECT_EQ(bytes_of(renderer, s, [&] { change_lighting(renderer, dim); }), 0u);
  EXPECT_EQ(
      bytes_of(renderer, s,
               [&] { change_lighting(renderer, [](auto& state) { state.group_scales[0] = vec3(2); }); }),
      emitter_block)
      << "a lamp has no surface";
  EXPECT_EQ(
      bytes_of(renderer, s,
               [&] { change_lighting(renderer, [](auto& state) { state.group_scales[1] = vec3(2); }); }),
      emitter_block + instance_block);
}

TEST_F(Uploads, MemoryIsThatOfTheSceneAndItsMaps) {
  const scene::Scene one = stage(matte(vec3(0.5f)));
  const std::size_t before = memory_of(one);
  scene::Scene more = one;
  more.instances.push_back(more.instances[0]);
  EXPECT_EQ(memory_of(more) - before, 256u) << "a block of an instance";
  more = one;
  more.materials.push_back(more.materials[0]);
  EXPECT_EQ(memory_of(more) - before, 256u) << "and of a material";
  more = one;
  more.meshes.push_back(more.meshes[0]);
  EXPECT_EQ(memory_of(more) - before, 4u * (12 + 60) + 6 * 4) << "places, attributes, indices";
  more = one;
  more.textures.emplace_back();
  more.textures[0].width = 8, more.textures[0].height = 3, more.textures[0].rgba.assign(8 * 3 * 4, 9);
  EXPECT_EQ(memory_of(more), before) << "nobody reads it";
  more.materials[0].base_color_texture.texture = more.materials[1].base_color_texture.texture = 0;
  EXPECT_EQ(memory_of(more) - before, 128u) << "with its mipmaps, a third more";
  more.materials[1].normal_texture.texture = 0;
  EXPECT_EQ(memory_of(more) - before, 256u) << "once more as what is no colour";
  more = one;
  more.environment.emplace();
  const std::size_t constant = memory_of(more);
  more.environment->equirect = image::Image(16, 8, 3);
  more.environment->equirect.pixels.assign(16 * 8 * 3, 1);
  EXPECT_EQ(memory_of(more) - constant, (16u * 8 - 1) * 16);
}

TEST_F(Uploads, MapsAreThoseThatEveryKindOfLampNeeds) {
  const auto maps = [&](const auto& add, const RendererParams& params = small) {
    scene::Scene s = stage(matte(vec3(0.5f)));
    add(s);
    scene::validate(s);
    Renderer renderer(gl(), s, params);
    const int drawn = frame(renderer, s).shadow_maps_drawn;
    EXPECT_EQ(frame(renderer, s).shadow_maps_drawn, 0);
    return drawn;
  };
  const auto lamp = [](scene::LightType type, float extent = 0) {
    return [=](scene::Scene& s) {
      scene::Light light;
      light.type = type, light.radius = light.angular_radius = extent;
      add_stage_lamp(s, light);
    };
  };
  using enum scene::LightType;
  EXPECT_EQ(maps(lamp(point)), 6);
  EXPECT_EQ(maps(lamp(sphere, 0.1f)), 8 * 6) << "eight points";
  EXPECT_EQ(maps(lamp(directional)), 6) << "cascades";
  EXPECT_EQ(maps(lamp(directional, 0.1f)), 7 * 6) << "parts of its disc";
  RendererParams fewer = small;
  fewer.sun_samples = 4, fewer.area_samples = 3, fewer.environment_samples = 5;
  EXPECT_EQ(maps(lamp(directional, 0.1f), fewer), 4 * 6);
  const auto panel = [](bool both) {
    return [=](scene::Scene& s) {
      s.materials.push_back(matte(vec3(0)));
      s.materials.back().emission = vec3(3), s.materials.back().double_sided = both;
      add_mesh(s, scene::make_quad({-0.5f, 3, -0.3f}, {1, 0, 0}, {0, 0, 0.8f}), 4);
    };
  };
  EXPECT_EQ(maps(panel(false)), 16 * 5) << "points, each without what is behind it";
  EXPECT_EQ(maps(panel(true)), 16 * 6);
  EXPECT_EQ(maps(panel(false), fewer), 3 * 5);
  const auto sky = [](scene::Scene& s) { s.environment.emplace(); };
  EXPECT_EQ(maps(sky), 32);
  EXPECT_EQ(maps(sky, fewer), 5);
  fewer.area_samples = fewer.environment_samples = 0;
  EXPECT_EQ(maps(panel(false), fewer), 5) << "one is the least";
  EXPECT_EQ(maps(sky, fewer), 1);
  fewer.area_samples = fewer.environment_samples = 999;
  EXPECT_EQ(maps(sky, fewer), 64) << "and 64 the most";
}

TEST_F(Uploads, FacesThatALampDoesNotReachAreNotDrawn) {
  const auto maps = [&](scene::Scene s) {
    scene::validate(s);
    Renderer renderer(gl(), s, {.light_map_size = 16, .area_map_size = 16, .area_samples = 1});
    return frame(renderer, s).shadow_maps_drawn;
  };
  // Of a cone along a cube's diagonal: three faces' axes are 54.74 degrees, 0.9553, away, the others 2.1863;
  // a face reaches as far as its corners, 0.9553
  for (const auto& [cone, faces] : {std::pair(0.1f, 3), std::pair(1.22f, 3), std::pair(1.24f, 6)}) {
    scene::Scene s = stage(matte(vec3(0.5f)));
    scene::Light spot;
    spot.type = scene::LightType::spot, spot.outer_cone = cone;
    add_stage_lamp(s, spot);
    s.nodes.back().local.rotation = glm::quatLookAt(glm::normalize(vec3(1, -1, -1)), vec3(0, 1, 0));
    EXPECT_EQ(maps(s), faces) << cone;
  }
  // Of a panel turned by an angle, the face behind it: wholly so while that is below 35.26 degrees, 0.6155
  for (const auto& [angle, faces] : {std::pair(0.59f, 5), std::pair(0.63f, 6)}) {
    scene::Scene s = stage(matte(vec3(0.5f)));
    s.materials.push_back(matte(vec3(0)));
    s.materials.back().emission = vec3(3);
    add_mesh(s, scene::make_quad({-0.5f, 0, -0.3f}, {1, 0, 0}, {0, 0, 0.8f}), 4, {0, 3, 0});
    s.nodes.back().local.rotation = glm::angleAxis(angle, vec3(1, 0, 0));
    EXPECT_EQ(maps(s), faces) << angle;
  }
}

TEST_F(Uploads, SunsMapsAreKeptWhileTheViewMovesLittle) {
  scene::Scene s = stage(matte(vec3(0.5f)));
  scene::Light sun;
  sun.type = scene::LightType::directional;
  add_stage_lamp(s, sun);
  for (const bool parallel : {false, true}) {
    s.cameras[0].orthographic = parallel;
    Renderer renderer(gl(), s, small);
    EXPECT_EQ(frame(renderer, s).shadow_maps_drawn, 6);
    EXPECT_EQ(frame(renderer, s, vec3(1e-5f)).shadow_maps_drawn, 0);
    const int moved = frame(renderer, s, vec3(0.8f, 0, 0)).shadow_maps_drawn;
    EXPECT_GE(moved, 1);
    EXPECT_LE(moved, 5) << "the last one holds the whole scene";
  }
}

TEST_F(Uploads, MetalUnderAnEvenSkyReflectsItsAlbedoOfIt) {
  // Whatever the roughness: the lobe's mean of what is the same everywhere
  scene::Scene s;
  s.materials.emplace_back().base_color = {0.9f, 0.6f, 0.4f};
  s.materials[0].metallic = 1;
  add_mesh(s, scene::make_sphere(1, 96, 48), 0);
  s.nodes.emplace_back().local.translation = {0, 0, 3.4f};
  s.cameras.emplace_back().node = 1;
  s.environment.emplace().color = {0.5f, 1, 2};
  scene::validate(s);
  const PictureSize size{32, 32};
  const scene::CameraPose pose = scene::camera_pose(s, "");
  const trace::TransportScene source(s);
  const PixelPoints points(source, pose, size);
  Renderer renderer(gl(), s, {.sun_map_size = 64, .environment_map_size = 64, .environment_samples = 8});
  for (const float roughness : {0.05f, 0.33f, 0.7f}) {
    s.materials[0].specular_roughness = roughness;
    renderer.set_material(0, s.materials[0]);
    FrameSettings settings;
    settings.view = realtime::View::direct;
    renderer.draw(pose, settings, {.width = size.width, .height = size.height});
    PictureBounds bounds = PictureBounds::around(points.picture([&](const PixelPoint& p) {
      const float cosine = glm::dot(glm::normalize(p.point.position), p.wo);
      return vec3(0.5f, 1, 2) *
             shading::directional_albedo({vec3(0), {0.9f, 0.6f, 0.4f}, 0, roughness}, cosine);
    }),
                                                 0.01f, 0.002f);
    // At the rim facets stand in the sky's way
    for (const PixelPoint& p : points.pixels)
      bounds.left_out.push_back(p.hit.escaped() || glm::dot(glm::normalize(p.point.position), p.wo) < 0.35f);
    EXPECT_TRUE(picture_is(renderer.read_back(), bounds)) << roughness;
  }
}

}  // namespace
}  // namespace ssphh::test
