/// Reflection, textures and surfaces number by number, as they were: closed forms and integrals elsewhere
/// tell what they should be, and bound it more loosely.

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/shading/surface.h>

#include "bsdf_models.h"
#include "busy_scene.h"
#include "number_list.h"

namespace ssphh::shading::test {
namespace {

using ssphh::test::NumberList;

/// Beside all models, parameters at the ends of their ranges and beyond.
std::vector<NamedBsdf> listed_models() {
  std::vector<NamedBsdf> models = bsdf_models();
  models.push_back({"occluded", {vec3(0.7f, 0.5f, 0.3f), vec3(0.004f, 0.01f, 0.007f), 0.2f, 0.63f}});
  models.push_back({"too rough", {vec3(0.6f), vec3(0.05f), 1.7f, 1.4f}});
  models.push_back({"too rough Phong", {vec3(0.6f), vec3(0.05f), -1.7f, -1.4f}});
  models.push_back({"Disney diffuse 0.52", {vec3(0.9f, 0.8f, 0.7f), vec3(0), 0.52f, 1}});
  models.push_back({"dark", {vec3(0), vec3(0.3f, 0.2f, 0.1f), 0, 0.45f}});
  return models;
}

const std::vector<vec3> ways{direction(0.93f, 0.4f), direction(0.37f, 2.9f), direction(0.08f, 5.1f)};

TEST(SurfaceList, OfReflectionIsWhatItWas) {
  NumberList list;
  for (const auto& [name, params] : listed_models()) {
    list.add(name, is_lambertian(params));
    for (const vec3& wo : ways) {
      for (const vec3& wi : ways) list.add(" value", eval_bsdf(params, wo, wi), pdf_bsdf(params, wo, wi));
      for (const float lobe : {0.05f, 0.35f, 0.83f}) {
        const auto s = sample_bsdf(params, wo, lobe, {0.37f, 0.61f});
        s ? list.add(" sample", s->wi, s->weight, s->pdf) : list.add(" sample", "none");
      }
      list.add(" albedo", directional_albedo(params, wo.z));
    }
  }
  // As narrow as lobes get, and narrower: densities of such lobes have no digits that last.
  for (const float roughness : {0.0f, 0.02f, 0.034f, 0.11f, -0.02f, -0.11f}) {
    const BsdfParams params{vec3(0.2f, 0.4f, 0.6f), vec3(0.3f, 0.2f, 0.5f), 0, roughness};
    for (const vec3& wo : ways) list.add("narrow", directional_albedo(params, wo.z));
  }
  const BsdfParams plain;
  for (const vec3& w : {vec3(0.6f, 0, -0.8f), vec3(1, 0, 0)}) {
    EXPECT_EQ(eval_bsdf(plain, w, ways[0]), vec3(0));
    EXPECT_EQ(eval_bsdf(plain, ways[0], w), vec3(0));
    EXPECT_FALSE(sample_bsdf(plain, w, 0.9f, {0.3f, 0.4f}));
  }
  list.expect("libs/shading/tests/expected/reflection.txt");
}

TEST(SurfaceList, OfTexturesIsWhatItWas) {
  const scene::Scene scene = ssphh::test::busy_scene();
  NumberList list;
  const std::vector<vec2> places{{0.31f, 0.77f}, {-0.24f, 1.36f}, {2.83f, -1.58f}, {0.02f, 0.98f}, {1, 1}};
  for (const scene::Wrap u : {scene::Wrap::repeat, scene::Wrap::mirror, scene::Wrap::clamp}) {
    for (const scene::Wrap v : {scene::Wrap::repeat, scene::Wrap::mirror, scene::Wrap::clamp}) {
      for (const int kind : {0, 1, 2, 3}) {
        const scene::TextureUse use{.texture = kind % 2,
                                    .uv_set = kind % 3 == 1 ? 1 : 0,
                                    .offset = {0.1f, -0.23f},
                                    .scale = {1.3f, 0.7f},
                                    .rotation = kind == 2 ? 0 : 0.6f,
                                    .wrap_u = u,
                                    .wrap_v = v,
                                    .nearest = kind == 3};
        for (const vec2& at : places) {
          const vec2 uv[2] = {at, vec2(0.4f) + 0.6f * vec2(at.y, at.x)};
          list.add("texel", sample_texture(scene, use, uv, kind < 2));
        }
      }
    }
  }
  list.expect("libs/shading/tests/expected/textures.txt");
}

/// A bent quad with all that a mesh may have, each corner another.
scene::Mesh full_mesh() {
  scene::Mesh mesh;
  mesh.positions = {{-0.5f, 0.1f, 0}, {0.6f, -0.2f, 0.1f}, {0.4f, 0.9f, -0.2f}, {-0.7f, 0.8f, 0.3f}};
  mesh.normals = {{0, 0, 1}, {0.3f, 0, 0.9f}, {-0.2f, 0.4f, 0.8f}, {0.1f, -0.3f, 0.7f}};
  for (vec3& n : mesh.normals) n = glm::normalize(n);
  mesh.uvs[0] = {{0.1f, 0.9f}, {1.2f, 0.8f}, {0.9f, 0.1f}, {0, 0.2f}};
  mesh.uvs[1] = {{0.3f, 0.1f}, {0.2f, 0.7f}, {1.1f, 0.6f}, {0.9f, -0.2f}};
  mesh.colors = {{1, 0.5f, 0.2f, 0.9f}, {0.4f, 1, 0.6f, 0.8f}, {0.7f, 0.3f, 1, 0.5f}, {0.9f, 0.9f, 0.4f, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(SurfaceList, OfSurfacesIsWhatItWas) {
  scene::Scene scene = ssphh::test::busy_scene();
  for (const std::size_t m : {1u, 5u}) {  // one more of each, by the second set of coordinates
    scene.materials.push_back(scene.materials[m]);
    scene::Material& other = scene.materials.back();
    other.base_color_texture = {.texture = 0, .uv_set = 1},
    other.normal_texture = {.texture = 3, .uv_set = 1};
    other.specular_roughness = -0.6f, other.alpha_mode = scene::AlphaMode::blend, other.alpha = 0.7f;
  }
  const scene::Mesh full = full_mesh();
  scene::Mesh tangents = full, bare = full;
  tangents.tangents = {{1, 0.1f, 0, -1}, {0.9f, 0.3f, 0.1f, -1}, {0.8f, 0, 0.2f, -1}, {1, 0, 0.3f, -1}};
  bare.normals.clear(), bare.colors.clear(), bare.uvs[1].clear();
  mat4 world = glm::mat4_cast(glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, -1))));
  world[1] *= 1.4f, world[2] *= -0.8f, world[3] = vec4(0.3f, -0.4f, 1.2f, 1);
  const mat3 normals = glm::transpose(glm::inverse(mat3(world)));
  NumberList list;
  for (int m = -1; m < static_cast<int>(scene.materials.size()); ++m) {
    for (const scene::Mesh* mesh : {&full, &std::as_const(tangents), &std::as_const(bare)}) {
      for (const vec3& wo : {vec3(0.3f, -0.2f, 0.9f), vec3(-0.5f, 0.1f, -0.8f), vec3(0.98f, 0.1f, 0.05f)}) {
        for (const std::uint32_t triangle : {0u, 1u}) {
          const vec2 at(0.23f, 0.41f);
          const Surface s = surface_at(scene, *mesh, m, triangle, at, world, normals, glm::normalize(wo));
          list.add("surface", m, s.position, s.geometric_normal, s.normal, s.emission, s.alpha, s.unlit);
          list.add(" of", s.bsdf.diffuse, s.bsdf.f0, s.bsdf.diffuse_roughness, s.bsdf.specular_roughness,
                   coverage_at(scene, *mesh, m, triangle, at));
        }
      }
    }
  }
  list.expect("libs/shading/tests/expected/surfaces.txt");
}

}  // namespace
}  // namespace ssphh::shading::test
