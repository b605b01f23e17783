#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/image/transfer.h>
#include <ssphh/shading/surface.h>

namespace ssphh::shading::test {
namespace {

using scene::Scene;

void expect_near(const vec3& a, const vec3& b, float tolerance, const std::string& what = {}) {
  EXPECT_NEAR(glm::distance(a, b), 0, tolerance) << what << " (" << a.x << ", " << a.y << ", " << a.z
                                                 << ") and (" << b.x << ", " << b.y << ", " << b.z << ")";
}

/// Right triangle in the plane z = 0 that faces +z; u right and v down over it.
Scene triangle_scene() {
  Scene scene;
  scene::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.uvs[0] = {{0, 1}, {1, 1}, {0, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.material = 0;
  scene.meshes.push_back(mesh);
  scene.materials.emplace_back();
  return scene;
}

Surface look(const Scene& scene, const vec3& wo, const mat4& world = mat4(1), const vec2& at = vec2(0.25f)) {
  const mat3 normal_matrix = glm::transpose(glm::inverse(mat3(world)));
  return surface_at(scene, scene.meshes[0], scene.meshes[0].material, 0, at, world, normal_matrix,
                    glm::normalize(wo));
}

int add_texture(Scene& scene, int width, int height, std::vector<std::uint8_t> rgba) {
  scene.textures.push_back({"texture", width, height, std::move(rgba)});
  return static_cast<int>(scene.textures.size()) - 1;
}

/// One texel of a linear value 0..255.
int add_texel(Scene& scene, std::uint8_t r, std::uint8_t g, std::uint8_t b, std::uint8_t a = 255) {
  return add_texture(scene, 1, 1, {r, g, b, a});
}

TEST(SurfaceAt, NormalsFaceTheSideTheRayCameFrom) {
  const Scene scene = triangle_scene();
  for (const float side : {1.0f, -1.0f}) {
    const Surface s = look(scene, {0.3f, 0.1f, side});
    expect_near(s.position, {0.25f, 0.25f, 0}, 1e-6f);
    expect_near(s.geometric_normal, {0, 0, side}, 1e-6f);
    expect_near(s.normal, {0, 0, side}, 1e-6f);
  }
}

TEST(SurfaceAt, NormalsFollowTheInverseTransposeAndPositionsTheMatrix) {
  Scene scene = triangle_scene();
  scene.meshes[0].normals.assign(3, glm::normalize(vec3(1, 0, 1)));
  mat4 world(1);
  world[0][0] = 4;  // stretched along x: normals turn away from x
  world[3] = vec4(1, 2, 3, 1);
  const Surface s = look(scene, {0, 0, 1}, world);
  expect_near(s.position, {2, 2.25f, 3}, 1e-5f);
  expect_near(s.normal, glm::normalize(vec3(0.25f, 0, 1)), 1e-6f);
  expect_near(s.geometric_normal, {0, 0, 1}, 1e-6f);
}

TEST(SurfaceAt, ShadingNormalsInterpolateAndNeverFaceAway) {
  Scene scene = triangle_scene();
  scene.meshes[0].normals = {vec3(0, 0, 1), glm::normalize(vec3(1, 0, 0.2f)), vec3(0, 0, 1)};
  expect_near(look(scene, {0, 0, 1}, mat4(1), {0.5f, 0}).normal,
              glm::normalize(vec3(0, 0, 1) + glm::normalize(vec3(1, 0, 0.2f))), 1e-6f);
  // Seen against its slant the interpolated normal faces away; it is bent just to the horizon
  const vec3 wo = glm::normalize(vec3(-1, 0, 0.1f));
  const Surface s = look(scene, wo, mat4(1), {0.9f, 0});
  EXPECT_GT(glm::dot(s.normal, wo), 0);
  EXPECT_LT(glm::dot(s.normal, wo), 0.01f);
  EXPECT_NEAR(glm::length(s.normal), 1, 1e-5f);
  // All normals inside out, as some exporters write them
  scene.meshes[0].normals.assign(3, vec3(0, 0, -1));
  expect_near(look(scene, {0, 0.2f, 1}).normal, {0, 0, 1}, 1e-6f);
  expect_near(look(scene, {0, 0.2f, -1}).normal, {0, 0, -1}, 1e-6f);
}

TEST(SurfaceAt, NormalsThatPointBehindTheirTriangleAreTurnedAndOnlyThose) {
  Scene scene = triangle_scene();
  const vec3 behind = glm::normalize(vec3(1, 0, -0.5f));
  scene.meshes[0].normals.assign(3, behind);
  expect_near(look(scene, {-1, 0, 1}).normal, -behind, 1e-6f);
  expect_near(look(scene, {1, 0, -1}).normal, behind, 1e-6f, "from the back");
  scene.meshes[0].normals.assign(3, vec3(1, 0, 0));
  expect_near(look(scene, {1, 0, 1}).normal, {1, 0, 0}, 1e-6f, "within the triangle's plane");
}

TEST(SurfaceAt, NormalMapGreenPointsUpTheImage) {
  Scene scene = triangle_scene();
  auto& material = scene.materials[0];
  material.normal_texture.texture = add_texel(scene, 255, 128, 128);  // toward +u
  const vec3 tilted_u = glm::normalize(vec3(1, 0, 0));
  EXPECT_GT(glm::dot(look(scene, {1, 0, 1}).normal, tilted_u), 0.99f);
  material.normal_texture.texture =
      add_texel(scene, 128, 218, 218);  // 45° toward green: up the image, +y here
  expect_near(look(scene, {0, 0, 1}).normal, glm::normalize(vec3(0, 1, 1)), 0.02f);
  material.normal_scale = 0.5f;
  expect_near(look(scene, {0, 0, 1}).normal, glm::normalize(vec3(0, 0.5f, 1)), 0.02f);
  // Seen from behind the bump is the same bump
  expect_near(look(scene, {0, 0, -1}).normal, -glm::normalize(vec3(0, 0.5f, 1)), 0.02f);
}

TEST(SurfaceAt, NormalMapIsFlatWhereItsCoordinatesLieOnALine) {
  Scene scene = triangle_scene();
  scene.materials[0].normal_texture.texture = add_texel(scene, 218, 128, 218);  // 45° toward +u
  EXPECT_GT(look(scene, {0, 0, 1}).normal.x, 0.5f);
  scene.meshes[0].uvs[0] = {{0, 0}, {1, 0.5f}, {0.5f, 0.25f}};  // u and v have no direction here
  expect_near(look(scene, {0, 0, 1}).normal, {0, 0, 1}, 1e-6f);
}

TEST(SurfaceAt, NormalMapTurnsWithMirroredTextureAndMirroredInstance) {
  Scene scene = triangle_scene();
  auto& material = scene.materials[0];
  material.normal_texture.texture = add_texel(scene, 218, 128, 218);  // 45° toward +u
  for (vec2& uv : scene.meshes[0].uvs[0]) uv.x = -uv.x;
  expect_near(look(scene, {0, 0, 1}).normal, glm::normalize(vec3(-1, 0, 1)), 0.02f, "mirrored u");
  scene = triangle_scene();
  scene.materials[0].normal_texture.texture = add_texel(scene, 128, 218, 218);  // 45° up the image
  mat4 mirror(1);
  mirror[0][0] = -1;
  expect_near(look(scene, {0, 0, 1}, mirror).normal, glm::normalize(vec3(0, 1, 1)), 0.02f,
              "mirrored instance");
  EXPECT_GT(look(scene, {0, 0, 1}, mirror).geometric_normal.z, 0);
}

TEST(SurfaceAt, StoredTangentsAgreeWithComputedOnes) {
  Scene scene = triangle_scene();
  scene.materials[0].normal_texture.texture = add_texel(scene, 200, 60, 200);
  const vec3 computed = look(scene, {0, 0, 1}).normal;
  scene.meshes[0].tangents.assign(3, vec4(1, 0, 0, 1));
  expect_near(look(scene, {0, 0, 1}).normal, computed, 1e-5f);
  scene.meshes[0].tangents.assign(3, vec4(1, 0, 0, -1));
  EXPECT_GT(glm::distance(look(scene, {0, 0, 1}).normal, computed), 0.5f) << "handedness matters";
}

TEST(SurfaceAt, ParametersFollowMetallicRoughnessRules) {
  Scene scene = triangle_scene();
  auto& material = scene.materials[0];
  material.base_color = {0.8f, 0.4f, 0.2f};
  material.ior = 1.5f;
  Surface s = look(scene, {0, 0, 1});
  expect_near(s.bsdf.diffuse, material.base_color, 1e-6f);
  expect_near(s.bsdf.f0, vec3(0.04f), 1e-6f);
  material.specular = 0;
  EXPECT_EQ(look(scene, {0, 0, 1}).bsdf.f0, vec3(0));
  EXPECT_TRUE(is_lambertian(look(scene, {0, 0, 1}).bsdf));
  material.specular = 1, material.metallic = 1;
  s = look(scene, {0, 0, 1});
  EXPECT_EQ(s.bsdf.diffuse, vec3(0));
  expect_near(s.bsdf.f0, material.base_color, 1e-6f);
  // Texture: green roughness, blue metallic; the roughness keeps its sign, the diffuse one is left alone
  material.specular_roughness = -0.5f, material.diffuse_roughness = -0.3f, material.metallic = 0.5f;
  material.metallic_roughness_texture.texture = add_texel(scene, 7, 51, 102);
  s = look(scene, {0, 0, 1});
  EXPECT_FLOAT_EQ(s.bsdf.specular_roughness, -0.5f * 0.2f);
  EXPECT_FLOAT_EQ(s.bsdf.diffuse_roughness, -0.3f);
  expect_near(s.bsdf.diffuse, 0.8f * material.base_color, 1e-5f);
  expect_near(s.bsdf.f0, glm::mix(vec3(0.04f), material.base_color, 0.2f), 1e-5f);
}

TEST(SurfaceAt, GlassIsTheTransmittedShareOfWhatIsNoMetal) {
  Scene scene = triangle_scene();
  auto& material = scene.materials[0];
  material.base_color = {0.8f, 0.4f, 0.2f};
  material.ior = 1.7f, material.specular_roughness = -0.5f;
  EXPECT_EQ(look(scene, {0, 0, 1}).glass.share, 0);
  material.transmission = 0.5f, material.metallic = 0.2f;
  material.transmission_texture.texture = add_texel(scene, 204, 0, 0);
  Surface s = look(scene, {0, 0, 1});
  EXPECT_NEAR(s.glass.share, 0.5f * 0.8f * 0.8f, 1e-5f);
  EXPECT_TRUE(s.glass.sheet);
  EXPECT_EQ(s.glass.ior, 1.7f);
  EXPECT_EQ(s.glass.roughness, 0.5f) << "magnitude";
  expect_near(s.glass.tint, material.base_color, 1e-6f);
  EXPECT_EQ(s.glass.absorption, vec3(0));
  // Both shares together: metal as much as it says, and of the dielectric base what is no glass.
  const float opaque = 1 - s.glass.share;
  expect_near(opaque * s.bsdf.diffuse, 0.8f * 0.6f * material.base_color, 1e-5f);
  const float f0 = (0.7f / 2.7f) * (0.7f / 2.7f);
  expect_near(opaque * s.bsdf.f0, 0.8f * 0.6f * vec3(f0) + 0.2f * material.base_color, 1e-5f);
  // A body absorbs by distance; which side it is seen from counts.
  material.thickness = 1, material.attenuation_color = {0.5f, 1, 0}, material.attenuation_distance = 2;
  s = look(scene, {0, 0, 1});
  EXPECT_FALSE(s.glass.sheet);
  EXPECT_FALSE(s.glass.inside);
  EXPECT_TRUE(look(scene, {0, 0, -1}).glass.inside);
  EXPECT_NEAR(std::exp(-2 * s.glass.absorption.x), 0.5f, 1e-6f);
  EXPECT_EQ(s.glass.absorption.y, 0);
  EXPECT_LT(std::exp(-2 * s.glass.absorption.z), 1e-29f);
  EXPECT_TRUE(std::isfinite(s.glass.absorption.z));
  const GlassParams alone = glass_at(scene, scene.meshes[0], 0, 0, vec2(0.25f));
  EXPECT_EQ(alone.share, s.glass.share);
  EXPECT_EQ(alone.absorption, s.glass.absorption);
  material.unlit = true;
  EXPECT_EQ(look(scene, {0, 0, 1}).glass.share, 0);
}

TEST(SurfaceAt, BaseColourIsFactorTimesDecodedTextureTimesVertexColour) {
  Scene scene = triangle_scene();
  auto& material = scene.materials[0];
  material.base_color = vec3(0.5f);
  material.base_color_texture.texture = add_texel(scene, 128, 255, 0, 128);
  scene.meshes[0].colors = {vec4(1), vec4(0, 1, 1, 1), vec4(1)};
  const Surface s = look(scene, {0, 0, 1}, mat4(1), {0.5f, 0.25f});
  EXPECT_NEAR(s.bsdf.diffuse.x, 0.5f * image::srgb_to_linear(128.0f / 255) * 0.5f, 1e-6f);
  EXPECT_NEAR(s.bsdf.diffuse.y, 0.5f, 1e-6f);
  EXPECT_EQ(s.bsdf.diffuse.z, 0);
  EXPECT_EQ(s.alpha, 1) << "opaque ignores alpha";
  material.alpha_mode = scene::AlphaMode::blend;
  EXPECT_NEAR(look(scene, {0, 0, 1}).alpha, 128.0f / 255, 1e-6f);
  material.alpha_mode = scene::AlphaMode::mask;
  EXPECT_EQ(look(scene, {0, 0, 1}).alpha, 1);
  material.alpha_cutoff = 0.6f;
  EXPECT_EQ(look(scene, {0, 0, 1}).alpha, 0);
}

TEST(SurfaceAt, EmitsFromTheFrontUnlessDoubleSidedOrUnlit) {
  Scene scene = triangle_scene();
  auto& material = scene.materials[0];
  material.emission = vec3(2, 4, 6);
  EXPECT_EQ(look(scene, {0, 0, 1}).emission, material.emission);
  EXPECT_EQ(look(scene, {0, 0, -1}).emission, vec3(0));
  material.double_sided = true;
  EXPECT_EQ(look(scene, {0, 0, -1}).emission, material.emission);
  material.emission_texture.texture = add_texel(scene, 188, 255, 0);
  expect_near(look(scene, {0, 0, 1}).emission, {2 * image::srgb_to_linear(188.0f / 255), 4, 0}, 1e-5f);
  material.unlit = true, material.double_sided = false;
  for (const float side : {1.0f, -1.0f}) {
    const Surface s = look(scene, {0, 0, side});
    EXPECT_TRUE(s.unlit);
    EXPECT_EQ(s.emission, material.base_color);
    EXPECT_EQ(s.bsdf.diffuse, vec3(0));
    EXPECT_EQ(s.bsdf.f0, vec3(0));
  }
}

TEST(SurfaceAt, DefaultMaterialAndDegenerateTrianglesAreHarmless) {
  Scene scene = triangle_scene();
  scene.meshes[0].material = -1;
  expect_near(look(scene, {0, 0, 1}).bsdf.diffuse, scene::Material{}.base_color, 1e-6f);
  scene.meshes[0].positions[2] = scene.meshes[0].positions[1];
  scene.meshes[0].normals.assign(3, vec3(0));
  const Surface s = look(scene, {0, 1, 1});
  EXPECT_TRUE(is_finite(s.normal) && is_finite(s.geometric_normal));
  EXPECT_GT(glm::dot(s.normal, vec3(0, 1, 1)), 0);
}

TEST(SampleTexture, InterpolatesBetweenTexelCentres) {
  Scene scene;
  scene::TextureUse use;
  use.texture = add_texture(scene, 2, 1, {0, 0, 0, 255, 255, 255, 255, 255});
  use.wrap_u = scene::Wrap::clamp;
  const auto at = [&](float u) { return sample_texture(scene, use, {vec2(u, 0.5f), vec2(0)}, false).x; };
  EXPECT_FLOAT_EQ(at(0.25f), 0);
  EXPECT_FLOAT_EQ(at(0.5f), 0.5f);
  EXPECT_FLOAT_EQ(at(0.625f), 0.75f);
  EXPECT_FLOAT_EQ(at(0.75f), 1);
  EXPECT_FLOAT_EQ(at(7), 1) << "clamped";
  use.wrap_u = scene::Wrap::repeat;
  EXPECT_FLOAT_EQ(at(0), 0.5f) << "the last texel is the first one's neighbour";
  EXPECT_FLOAT_EQ(at(3.625f), 0.75f);
  EXPECT_FLOAT_EQ(at(-0.375f), 0.75f);
  use.wrap_u = scene::Wrap::mirror;
  EXPECT_FLOAT_EQ(at(0), 0);
  EXPECT_FLOAT_EQ(at(1.375f), 0.75f);
  EXPECT_FLOAT_EQ(at(-0.625f), 0.75f);
  for (const float turns : {2.0f, -4.0f, 26.0f, -998.0f}) {
    EXPECT_FLOAT_EQ(at(turns + 0.625f), 0.75f) << turns;
    EXPECT_FLOAT_EQ(at(turns - 0.625f), 0.75f) << turns;
    EXPECT_FLOAT_EQ(at(turns + 1), 1) << turns;
  }
  use.nearest = true;
  EXPECT_FLOAT_EQ(at(0.49f), 0);
  EXPECT_FLOAT_EQ(at(0.51f), 1);
}

TEST(SampleTexture, DecodesColoursNotAlpha) {
  Scene scene;
  scene::TextureUse use;
  use.texture = add_texel(scene, 128, 0, 255, 128);
  const vec4 encoded = sample_texture(scene, use, {vec2(0), vec2(0)}, true);
  EXPECT_FLOAT_EQ(encoded.x, image::srgb_to_linear(128.0f / 255));
  EXPECT_FLOAT_EQ(encoded.w, 128.0f / 255);
  EXPECT_FLOAT_EQ(sample_texture(scene, use, {vec2(0), vec2(0)}, false).x, 128.0f / 255);
  EXPECT_EQ(sample_texture(scene, {}, {vec2(0), vec2(0)}, true), vec4(1)) << "no texture";
}

TEST(SampleTexture, TransformsScaleThenRotateThenMove) {
  // 4×4 texels whose red is the column, green the row; nearest lookup tells where a coordinate went
  Scene scene;
  std::vector<std::uint8_t> texels;
  for (std::uint8_t y = 0; y < 4; ++y) {
    for (std::uint8_t x = 0; x < 4; ++x) texels.insert(texels.end(), {x, y, 0, 255});
  }
  scene::TextureUse use;
  use.texture = add_texture(scene, 4, 4, texels);
  use.nearest = true, use.uv_set = 1;
  const auto texel = [&](const vec2& uv) {
    const vec4 c = sample_texture(scene, use, {vec2(0), uv}, false);
    return vec2(std::round(c.x * 255), std::round(c.y * 255));
  };
  EXPECT_EQ(texel({0.3f, 0.6f}), vec2(1, 2));
  use.scale = {0.5f, 1};
  EXPECT_EQ(texel({0.6f, 0.6f}), vec2(1, 2));
  use.offset = {0.25f, -0.25f};
  EXPECT_EQ(texel({0.6f, 0.6f}), vec2(2, 1));
  // Counter-clockwise on the image by a quarter turn: right becomes up, v = −0.3 wraps to 0.7
  use = {use.texture, 1, {0.01f, 0}, {1, 1}, pi / 2, scene::Wrap::repeat, scene::Wrap::repeat, true};
  EXPECT_EQ(texel({0.3f, 0}), vec2(0, 2));
  EXPECT_EQ(texel({0, 0.3f}), vec2(1, 3)) << "down becomes right, v just below 0 or 0";
}

TEST(SampleTexture, SurvivesAbsurdCoordinates) {
  Scene scene;
  scene::TextureUse use;
  use.texture = add_texture(scene, 2, 2, std::vector<std::uint8_t>(16, 200));
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const scene::Wrap wrap : {scene::Wrap::repeat, scene::Wrap::mirror, scene::Wrap::clamp}) {
    use.wrap_u = use.wrap_v = wrap;
    for (const float x : {inf, -inf, nan, 1e30f, -1e30f, -1e-30f, 1.0f, 2.0f}) {
      for (const bool nearest : {false, true}) {
        use.nearest = nearest;
        EXPECT_NEAR(sample_texture(scene, use, {vec2(x, 0.5f), vec2(0)}, false).x, 200.0f / 255, 1e-6f);
        EXPECT_NEAR(sample_texture(scene, use, {vec2(0.5f, x), vec2(0)}, false).x, 200.0f / 255, 1e-6f);
      }
    }
  }
}

TEST(SampleTexture, IsWhiteWhereThereIsNone) {
  Scene scene;
  scene::TextureUse use;
  const auto look_up = [&] { return sample_texture(scene, use, {vec2(0.5f), vec2(0.5f)}, true); };
  EXPECT_EQ(look_up(), vec4(1)) << "no texture";
  for (const bool wide : {false, true}) {
    scene.textures = {{"empty", wide ? 1 : 0, wide ? 0 : 1, {}}};
    use.texture = 0;
    EXPECT_EQ(look_up(), vec4(1)) << "one without texels";
  }
}

}  // namespace
}  // namespace ssphh::shading::test
