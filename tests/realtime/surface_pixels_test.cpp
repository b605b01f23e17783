/// What the G-buffer holds of surfaces with textures, at the middle of every pixel: the drawn views against
/// the CPU's own surfaces (libs/shading), which tests/render and libs/shading/tests hold against formulas.

#include <random>

#include <gmock/gmock.h>

#include <ssphh/gl/texture.h>
#include <ssphh/shading/surface.h>

#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

using realtime::Renderer;
using realtime::View;

constexpr PictureSize surface_size{60, 44};

/// Texels that are all different, smooth enough that a filter's eight bits do not count.
scene::Texture noise(const std::string& name, unsigned seed, int least, int most) {
  scene::Texture texture;
  texture.name = name, texture.width = 4, texture.height = 3;
  std::mt19937 random(seed);
  for (int i = 0; i < 4 * 4 * 3; ++i)
    texture.rgba.push_back(
        static_cast<std::uint8_t>(least + static_cast<int>(random() % static_cast<unsigned>(most - least))));
  return texture;
}

/// A quad with two sets of coordinates and colours at its corners, slanted before the camera.
scene::Scene sheet() {
  scene::Scene s;
  s.textures = {noise("colour", 1, 40, 255), noise("rough", 2, 60, 255), noise("emission", 3, 20, 255),
                noise("normal", 4, 96, 160)};
  // Normals point out of the surface
  for (std::size_t i = 2; i < s.textures[3].rgba.size(); i += 4) s.textures[3].rgba[i] = 240;
  s.materials = {matte({0.9f, 0.7f, 0.5f})};
  scene::Mesh mesh = scene::make_quad({-1.5f, -1, 0}, {3, 0, 0}, {0, 2, 0});
  mesh.uvs[0] = {{-0.1f, 1.2f}, {1.1f, 1.3f}, {1.2f, -0.2f}, {0.1f, -0.1f}};
  mesh.uvs[1] = {{0.9f, 0.1f}, {0.8f, 0.9f}, {0.1f, 0.8f}, {0.2f, 0.2f}};
  add_mesh(s, mesh, 0);
  s.nodes[0].local.rotation = glm::angleAxis(0.4f, glm::normalize(vec3(1, 2, 0.5f)));
  s.nodes.emplace_back().local.translation = {0.1f, -0.2f, 2.6f};
  s.cameras.emplace_back().node = 1;
  return s;
}

/// The CPU's surface at the middle of every pixel; none where the sheet is not, or near its edge.
std::vector<std::optional<shading::Surface>> surfaces_of(const scene::Scene& scene) {
  const scene::Mesh& mesh = scene.meshes[0];
  const mat4 world = scene::world_matrices(scene, 0)[0];
  const mat3 normals = glm::transpose(glm::inverse(mat3(world)));
  std::vector<std::optional<shading::Surface>> found;
  for (const rays::RayQuery& ray : pixel_rays(scene::camera_pose(scene, ""), surface_size)) {
    std::optional<shading::Surface>& surface = found.emplace_back();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto corner = [&](int c) { return vec3(world * vec4(mesh.positions[mesh.triangles[t][c]], 1)); };
      const vec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
      // origin + s direction = a + u ab + v ac
      const vec3 x = glm::inverse(mat3(-ray.direction, ab, ac)) * (ray.origin - a);
      const float edge = std::min({x.y, x.z, 1 - x.y - x.z});
      if (x.x > 0 && edge > 0.01f)
        surface = shading::surface_at(scene, mesh, 0, static_cast<std::uint32_t>(t), {x.y, x.z}, world,
                                      normals, -ray.direction);
    }
  }
  return found;
}

class SurfacePixels : public WithGl {
 protected:
  static image::Image draw(Renderer& renderer, const scene::Scene& scene, View view) {
    realtime::FrameSettings settings;
    settings.view = view;
    renderer.draw(scene::camera_pose(scene, ""), settings,
                  {.width = surface_size.width, .height = surface_size.height});
    return renderer.read_back();
  }
  /// `value(surface)` is what the view shows, up to `slack`.
  template <class Value>
  static void expect_view(const image::Image& drawn,
                          const std::vector<std::optional<shading::Surface>>& truth, float share, float slack,
                          const Value& value) {
    image::Image expected(surface_size.width, surface_size.height, 3);
    std::vector<bool> none;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      none.push_back(!truth[i]);
      if (truth[i])
        expected.set_rgb(static_cast<int>(i) % surface_size.width, static_cast<int>(i) / surface_size.width,
                         value(*truth[i]));
    }
    EXPECT_LT(std::ranges::count(none, true), surface_size.width * surface_size.height / 2);
    PictureBounds bounds = PictureBounds::around(expected, share, slack);
    bounds.left_out = none;
    EXPECT_TRUE(picture_is(drawn, bounds));
  }
  void expect_all(scene::Scene scene) {
    scene::validate(scene);
    Renderer renderer(gl(), scene);
    const auto truth = surfaces_of(scene);
    // A texel's eight bits, filtered by weights of eight bits: 2 of 255, which a normal's length may double
    // and sRGB's slope of at most 2.3 of a bright one may, too. Colours have 10 bits of their root
    expect_view(draw(renderer, scene, View::normal), truth, 0, 0.01f,
                [](const shading::Surface& s) { return 0.5f + 0.5f * s.normal; });
    expect_view(draw(renderer, scene, View::albedo), truth, 0.003f, 0.015f, [](const shading::Surface& s) {
      const shading::BsdfParams& b = s.bsdf;
      const shading::BsdfParams lobe{vec3(0), b.f0, 0, b.specular_roughness};
      const vec3 e = max_component(b.f0) > 0
                         ? shading::directional_albedo(lobe, std::max(glm::dot(s.normal, view_of(s)), 0.0f))
                         : vec3(0);
      return e + b.diffuse * (1.0f - e);
    });
    expect_view(draw(renderer, scene, View::direct), truth, 0.003f, 0.02f,
                [](const shading::Surface& s) { return s.emission; });
  }
  static vec3 view_of(const shading::Surface& s) {
    return glm::normalize(vec3(0.1f, -0.2f, 2.6f) - s.position);
  }
};

using Use = scene::TextureUse;

TEST_F(SurfacePixels, OfPlainMaterialsAreTheCpus) {
  expect_all(sheet());
  scene::Scene metal = sheet();
  scene::Material& m = metal.materials[0];
  m.metallic = 0.6f, m.specular = 0.8f, m.ior = 1.8f, m.specular_roughness = 0.5f;
  m.emission = {0.4f, 0.2f, 0.6f};
  expect_all(metal);
}

TEST_F(SurfacePixels, OfTexturesInEverySlotAreTheCpus) {
  // No two slots have the same transform, and they read both sets of coordinates
  scene::Scene s = sheet();
  scene::Material& m = s.materials[0];
  m.specular = 1, m.metallic = 0.9f, m.specular_roughness = 0.9f, m.ior = 1.6f;
  m.emission = {0.9f, 0.5f, 0.7f}, m.normal_scale = 0.7f;
  m.base_color_texture = {.texture = 0, .uv_set = 0, .offset = {0.13f, -0.27f}, .scale = {0.9f, 0.7f}};
  m.metallic_roughness_texture = {.texture = 1, .uv_set = 1, .offset = {-0.3f, 0.2f}, .rotation = 0.5f};
  m.emission_texture = {.texture = 2, .uv_set = 1, .scale = {-1.1f, 0.8f}, .rotation = -0.7f};
  m.normal_texture = {.texture = 3, .uv_set = 0, .offset = {0.2f, 0.4f}, .scale = {0.6f, 0.8f}};
  expect_all(s);
}

TEST_F(SurfacePixels, OfTexturesBeyondTheirEdgesAreTheCpus) {
  using scene::Wrap;
  for (const auto& [u, v, nearest] : {std::tuple(Wrap::repeat, Wrap::mirror, false),
                                      {Wrap::mirror, Wrap::clamp, false},
                                      {Wrap::clamp, Wrap::repeat, false},
                                      {Wrap::mirror, Wrap::repeat, true},
                                      {Wrap::repeat, Wrap::clamp, true}}) {
    scene::Scene s = sheet();
    s.materials[0].emission = vec3(1);
    const Use use{.texture = 0, .scale = {1.3f, 1.4f}, .wrap_u = u, .wrap_v = v, .nearest = nearest};
    s.materials[0].emission_texture = use;
    SCOPED_TRACE(testing::Message() << static_cast<int>(u) << static_cast<int>(v) << nearest);
    scene::validate(s);
    Renderer renderer(gl(), s);
    const image::Image drawn = draw(renderer, s, View::direct);
    const auto truth = surfaces_of(s);
    if (!nearest) {
      expect_view(drawn, truth, 0.003f, 0.02f, [](const shading::Surface& f) { return f.emission; });
      continue;
    }
    int same = 0, all = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!truth[i]) continue;
      const vec3 d =
          drawn.rgb(static_cast<int>(i) % surface_size.width, static_cast<int>(i) / surface_size.width) -
          truth[i]->emission;
      ++all, same += glm::length(d) < 0.02f;
    }
    // Of two neighbours that a pixel's middle lies between, rounding may choose either
    EXPECT_GE(same, all - 3);
    EXPECT_GT(all, 1000);
  }
}

TEST_F(SurfacePixels, OfVertexColoursAndTangentsAreTheCpus) {
  for (const float handedness : {1.0f, -1.0f}) {
    for (const float mirror : {1.0f, -1.0f}) {
      SCOPED_TRACE(testing::Message() << handedness << " " << mirror);
      scene::Scene s = sheet();
      scene::Mesh& mesh = s.meshes[0];
      mesh.colors = {
          {0.9f, 0.4f, 0.6f, 1}, {0.3f, 0.8f, 0.5f, 1}, {0.7f, 0.6f, 0.9f, 1}, {0.5f, 0.9f, 0.3f, 1}};
      for (int i = 0; i < 4; ++i) mesh.tangents.emplace_back(glm::normalize(vec3(1, 0.4f, 0)), handedness);
      s.nodes[0].local.scale = {1.2f * mirror, 0.8f, 1};
      s.materials[0].normal_texture = {.texture = 3, .scale = {0.5f, 0.5f}};
      expect_all(s);
    }
  }
}

TEST_F(SurfacePixels, OfAMirroredInstanceWithoutTangentsAreTheCpus) {
  scene::Scene s = sheet();
  s.nodes[0].local.scale = {-1, 1.1f, 1};
  s.materials[0].normal_texture = {.texture = 3, .uv_set = 1};
  s.materials[0].emission = {0.3f, 0.4f, 0.5f};
  expect_all(s);
}

TEST_F(SurfacePixels, OfABackAreTheCpus) {
  for (const bool both : {false, true}) {
    scene::Scene s = sheet();
    s.nodes[0].local.rotation = glm::angleAxis(pi - 0.4f, glm::normalize(vec3(0.2f, 1, 0)));
    s.materials[0].emission = {0.3f, 0.4f, 0.5f}, s.materials[0].double_sided = both;
    s.materials[0].normal_texture = {.texture = 3};
    expect_all(s);
  }
}

TEST_F(SurfacePixels, OfNormalsThatFaceAwayAreTurnedAsTheCpuDoes) {
  scene::Scene s = sheet();
  s.meshes[0].normals.assign(4, glm::normalize(vec3(1.5f, 0.3f, 0.05f)));
  s.nodes[0].local.rotation = glm::angleAxis(-0.9f, vec3(0, 1, 0));
  s.nodes[0].local.scale = vec3(1.3f);
  expect_all(s);
}

TEST_F(SurfacePixels, OfWhatIsUnlitAreItsColour) {
  scene::Scene s = sheet();
  s.materials[0].unlit = true;
  s.materials[0].base_color_texture = {.texture = 0};
  scene::validate(s);
  Renderer renderer(gl(), s);
  const auto truth = surfaces_of(s);
  expect_view(draw(renderer, s, View::direct), truth, 0.003f, 0.02f,
              [](const shading::Surface& surface) { return surface.emission; });
}

TEST_F(SurfacePixels, OfAMaskAreThereFromItsCutoffOn) {
  scene::Scene s = sheet();
  scene::Material& m = s.materials[0];
  m.alpha_mode = scene::AlphaMode::mask, m.alpha = 0.9f, m.alpha_cutoff = 0.55f, m.emission = vec3(1);
  m.base_color_texture = {.texture = 0, .scale = {0.8f, 0.8f}, .nearest = true};
  scene::validate(s);
  Renderer renderer(gl(), s);
  const image::Image drawn = draw(renderer, s, View::direct);
  const auto truth = surfaces_of(s);
  int off = 0, there = 0, all = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!truth[i]) continue;
    const bool shown =
        drawn.rgb(static_cast<int>(i) % surface_size.width, static_cast<int>(i) / surface_size.width).x >
        0.5f;
    ++all, there += shown, off += shown != (truth[i]->alpha == 1);
  }
  EXPECT_LE(off, 3) << "pixels whose middle lies between two texels";
  EXPECT_GT(there, all / 10);
  EXPECT_LT(there, all - all / 10);
}

TEST_F(SurfacePixels, OfPartialCoverAreThereAsOftenAsItSays) {
  for (const float alpha : {0.2f, 0.7f}) {
    scene::Scene s = sheet();
    s.materials[0].alpha_mode = scene::AlphaMode::blend, s.materials[0].alpha = alpha;
    s.materials[0].emission = vec3(1);
    scene::validate(s);
    Renderer renderer(gl(), s);
    const image::Image drawn = draw(renderer, s, View::direct);
    double there = 0, all = 0;
    const auto truth = surfaces_of(s);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!truth[i]) continue;
      ++all;
      there +=
          drawn.rgb(static_cast<int>(i) % surface_size.width, static_cast<int>(i) / surface_size.width).x >
          0.5f;
    }
    // Five standard errors of a binomial count: 6e-7
    const double share = static_cast<double>(alpha);
    EXPECT_NEAR(there / all, share, 5 * std::sqrt(share * (1 - share) / all));
  }
}

}  // namespace
}  // namespace ssphh::test
