/// Meshes that an engine has in OpenGL already: the pictures of those that the renderer uploads.

#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>

#include "change_lighting.h"
#include "engines_meshes.h"
#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

using realtime::MeshBuffers;
using realtime::Renderer;

/// Every attribute, in some meshes and not in others: texels by either set of coordinates, a normal map,
/// colours, a mask that lets light through; and meshes of more triangles than a piece has.
scene::Scene stage_of_all_attributes() {
  scene::Scene s = stage(matte({0.9f, 0.3f, 0.5f}));
  add_stage_lamp(s, {});
  scene::Texture& texture = s.textures.emplace_back();
  texture.width = texture.height = 2;
  texture.rgba = {250, 40, 30, 255, 30, 220, 50, 90, 90, 160, 240, 255, 180, 170, 210, 200};
  s.materials[0].base_color_texture = {.texture = 0, .uv_set = 1, .scale = {3, 3}};
  s.materials[1].normal_texture = {.texture = 0, .scale = {2, 2}};
  s.materials[2].base_color_texture = {.texture = 0, .scale = {4, 4}, .nearest = true};
  s.materials[2].alpha_mode = scene::AlphaMode::mask;
  for (scene::Mesh& mesh : s.meshes) {
    mesh.uvs = {};
    for (const vec3& p : mesh.positions) {
      const vec2 uv(p.x + 0.3f * p.z, p.y - 0.2f * p.z);
      mesh.uvs[0].push_back(uv);
      if (&mesh == &s.meshes[0]) mesh.uvs[1].emplace_back(uv.y + 0.1f, p.z);
      if (&mesh == &s.meshes[1]) mesh.tangents.emplace_back(1, 0, 0, -1);
      if (&mesh != &s.meshes[0]) mesh.colors.emplace_back(0.5f + 0.4f * glm::sin(3.0f * p), 0.9f);
    }
  }
  s.meshes[1].normals.clear();
  add_mesh(s, scene::make_torus_knot(2, 3, 0.4f, 0.2f, 0.1f, 256, 16), 3, {-1, 1.8f, 0});
  return s;
}

class Meshes : public WithGl {
 protected:
  static image::Image draw(Renderer& renderer, const scene::Scene& scene) {
    renderer.draw(scene::camera_pose(scene, ""), {}, {.width = 64, .height = 40});
    return renderer.read_back();
  }
};

TEST_F(Meshes, OfAnEngineAreDrawnFromItsBuffers) {
  for (const scene::Scene& scene :
       {scene::make_builtin("two-rooms"), scene::make_builtin("gallery3"), stage_of_all_attributes()}) {
    SCOPED_TRACE(scene.name);
    const EnginesMeshes engine(scene);
    Renderer own(gl(), scene, small_maps), theirs(gl(), scene, small_maps, 0, engine.meshes);
    for (Renderer* renderer : {&own, &theirs})
      renderer->set_probes(made_up_probes({{0, 1, 1}, {1, 1, 1}, {-1, 2, 0.5f}}));
    for (const float time : {0.0f, 0.5f}) {
      for (Renderer* renderer : {&own, &theirs})
        change_lighting(*renderer, [&](auto& state) { state.time = time; });
      const image::Image picture = draw(own, scene);
      EXPECT_GT(mean_luminance(picture), 0.01);
      EXPECT_EQ(draw(theirs, scene).pixels, picture.pixels) << time;
    }
    std::size_t uploaded = 0;
    for (const scene::Mesh& mesh : scene.meshes)
      uploaded += mesh.positions.size() * (12 + 60) + mesh.triangles.size() * 12;
    EXPECT_EQ(own.memory_bytes() - theirs.memory_bytes(), uploaded) << "places, attributes, indices";
  }
}

TEST_F(Meshes, SomeMayBeAnEnginesAndOthersNot) {
  const scene::Scene scene = stage_of_all_attributes();
  EnginesMeshes engine(scene);
  std::ranges::reverse(engine.meshes);
  Renderer own(gl(), scene, small_maps);
  const image::Image picture = draw(own, scene);
  for (const std::size_t count : {1u, 3u}) {
    Renderer theirs(gl(), scene, small_maps, 0, std::span(engine.meshes).first(count));
    EXPECT_EQ(draw(theirs, scene).pixels, picture.pixels) << count;
    EXPECT_LT(theirs.memory_bytes(), own.memory_bytes());
  }
}

/// A quad whose attributes are rounded so that small numbers hold them.
TEST_F(Meshes, NumbersMayBeSmall) {
  scene::Scene s;
  s.textures.emplace_back();
  s.textures[0].width = s.textures[0].height = 2;
  s.textures[0].rgba = {250, 40, 30, 255, 30, 220, 50, 255, 90, 160, 240, 255, 180, 170, 210, 255};
  s.materials = {matte(vec3(1))};
  s.materials[0].base_color_texture = {.texture = 0};
  s.materials[0].normal_texture = {.texture = 0};
  scene::Mesh mesh = scene::make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  mesh.uvs[0] = {{0, 0}, {0.5f, 0}, {1, 1}, {0, 0.25f}};
  mesh.colors.assign(4, vec4(51, 102, 204, 255) / 255.0f);
  mesh.tangents.assign(4, {1, 0, 0, 1});
  mesh.normals.assign(4, {0, 0, 1});
  add_mesh(s, mesh, 0);
  s.nodes.emplace_back().local.translation = {0, 0, 2};
  s.cameras.emplace_back().node = 1;
  s.lights.emplace_back().node = 1;
  s.lights[0].intensity = 9;
  scene::validate(s);
  Renderer own(gl(), s, small_maps);
  const image::Image picture = draw(own, s);
  EXPECT_GT(mean_luminance(picture), 0.01);

  const gl::Buffer places(std::span<const vec3>(mesh.positions)),
      corners(std::span<const uvec3>(mesh.triangles));
  struct Halves {
    std::uint16_t u, v;
  };
  const std::array<Halves, 4> uvs{{{0, 0}, {0x3800, 0}, {0x3c00, 0x3c00}, {0, 0x3400}}};
  const std::array<std::uint8_t, 4> color{51, 102, 204, 255};
  const gl::Buffer coordinates{std::span<const Halves>(uvs)}, colors{std::span<const std::uint8_t>(color)};
  MeshBuffers given{.positions = {places.id(), 0, 12},
                    .uvs = {{{coordinates.id(), 0, 4, gl::Component::f16}, {}}},
                    .colors = {colors.id(), 0, 0, gl::Component::unorm8},  // the same for all
                    .indices = {corners.id()}};
  struct Direction {
    gl::Component type;
    std::array<std::uint8_t, 8> normal, tangent;
  };
  for (const auto& [type, normal, tangent] :
       {Direction{gl::Component::snorm8, {0, 0, 127}, {127, 0, 0, 127}},
        Direction{gl::Component::unorm8, {0, 0, 255}, {255, 0, 0, 255}},
        Direction{gl::Component::snorm16, {0, 0, 0, 0, 255, 127}, {255, 127, 0, 0, 0, 0, 255, 127}},
        Direction{gl::Component::unorm16, {0, 0, 0, 0, 255, 255}, {255, 255, 0, 0, 0, 0, 255, 255}},
        Direction{gl::Component::snorm10, {0, 0, 0xf0, 0x1f}, {0xff, 0x01, 0, 0x40}}}) {
    const gl::Buffer directions[] = {gl::Buffer(std::span<const std::uint8_t>(normal)),
                                     gl::Buffer(std::span<const std::uint8_t>(tangent))};
    given.normals = {directions[0].id(), 0, 0, type};
    given.tangents = {directions[1].id(), 0, 0, type};
    Renderer theirs(gl(), s, small_maps, 0, std::array{given});
    PictureBounds bounds = PictureBounds::around(picture, 0.002f, 0.001f);
    EXPECT_TRUE(picture_is(draw(theirs, s), bounds)) << static_cast<int>(type);
  }
}

}  // namespace
}  // namespace ssphh::test
