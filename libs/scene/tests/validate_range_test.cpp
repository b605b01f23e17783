// The range of every number that validate() clamps: its ends are kept, what lies beyond is not.

#include <limits>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/query.h>

#include "not_finite.h"
#include "scene_fields.h"

namespace ssphh::scene {
namespace {

constexpr float largest = std::numeric_limits<float>::max();

template <class Owner>
struct Range {
  const char* name;
  float Owner::*field;
  float low, high;
};

const Range<Material> material_ranges[] = {
    {"alpha", &Material::alpha, 0, 1},
    {"metallic", &Material::metallic, 0, 1},
    {"diffuse roughness", &Material::diffuse_roughness, -1, 1},
    {"specular roughness", &Material::specular_roughness, -1, 1},
    {"specular", &Material::specular, 0, 1},
    {"ior", &Material::ior, 1, 1e6f},
    {"transmission", &Material::transmission, 0, 1},
    {"thickness", &Material::thickness, 0, largest},
    {"attenuation distance", &Material::attenuation_distance, 0, largest},
};

const Range<Light> light_ranges[] = {
    {"intensity", &Light::intensity, 0, largest},
    {"angular radius", &Light::angular_radius, 0, pi / 2},
    {"outer cone", &Light::outer_cone, 0, pi},
    {"inner cone", &Light::inner_cone, 0, 3},  // the outer cone's
    {"range", &Light::range, 0, largest},
};

Scene scene_of_one() {
  Scene scene;
  scene.nodes.resize(1);
  scene.materials.resize(1);
  scene.lights.resize(1);
  scene.lights[0].node = 0;
  scene.lights[0].outer_cone = 3;
  return scene;
}

template <class Owner>
void expect_range(const Range<Owner>& range, std::vector<Owner> Scene::*owners) {
  SCOPED_TRACE(range.name);
  const auto validated = [&](float value, std::size_t repairs) {
    Scene scene = scene_of_one();
    (scene.*owners)[0].*range.field = value;
    EXPECT_EQ(validate(scene).size(), repairs) << value;
    return (scene.*owners)[0].*range.field;
  };
  EXPECT_EQ(validated(range.low, 0), range.low);
  EXPECT_EQ(validated(range.high, 0), range.high);
  EXPECT_EQ(validated(range.low - 0.125f, 1), range.low);
  if (range.high < largest) {
    EXPECT_EQ(validated(range.high * 1.125f, 1), range.high);
  }
}

TEST(ValidateRange, MaterialsAreClampedToTheirRanges) {
  for (const Range<Material>& range : material_ranges) expect_range(range, &Scene::materials);
}

TEST(ValidateRange, LightsAreClampedToTheirRanges) {
  for (const Range<Light>& range : light_ranges) expect_range(range, &Scene::lights);
}

TEST(ValidateRange, ColoursAreClampedByComponent) {
  Scene scene = scene_of_one();
  scene.materials[0].base_color = {-0.5f, 0.75f, 1.5f};
  scene.materials[0].emission = {7, -1, 9};
  scene.lights[0].color = {3, 0.5f, -2};
  scene.meshes.resize(1);
  scene.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.meshes[0].triangles = {{0, 1, 2}};
  scene.meshes[0].colors = {vec4(0.25f), {2, -1, 0.5f, 1.5f}, vec4(1)};
  EXPECT_EQ(validate(scene).size(), 3u);
  EXPECT_EQ(scene.materials[0].base_color, vec3(0, 0.75f, 1));
  EXPECT_EQ(scene.materials[0].emission, vec3(7, 0, 9));
  EXPECT_EQ(scene.lights[0].color, vec3(3, 0.5f, 0));
  EXPECT_EQ(scene.meshes[0].colors[1], vec4(1, 0, 0.5f, 1));
}

// Thinner than 1e-10 of its longest side squared is degenerate: here of height 2e-10 and 0.5e-10 of a base
// of 1.
TEST(ValidateRange, ThinTrianglesStayAsLongAsTheyHaveANormal) {
  for (const auto& [height, kept] : {std::pair{2e-10f, 1u}, std::pair{0.5e-10f, 0u}}) {
    Scene scene;
    scene.meshes.resize(1);
    scene.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0.5f, height, 0}};
    scene.meshes[0].triangles = {{0, 1, 2}};
    validate(scene);
    EXPECT_EQ(scene.meshes[0].triangles.size(), kept) << height;
  }
}

// Normals may be off by half of 1e-3, rotations by 1e-4, before they are no unit vectors any more.
TEST(ValidateRange, VectorsAreLeftAsTheyAreWithinRounding) {
  const auto repairs = [](float normal, float rotation) {
    Scene scene = scene_of_one();
    scene.nodes[0].local.rotation = quat(rotation, 0, 0, 0);
    scene.meshes.resize(1);
    scene.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.meshes[0].normals.assign(3, vec3(0, 0, normal));
    scene.meshes[0].triangles = {{0, 1, 2}};
    return validate(scene).size();
  };
  EXPECT_EQ(repairs(1.0004f, 1.00009f), 0u);
  EXPECT_EQ(repairs(0.9996f, 0.99991f), 0u);
  EXPECT_EQ(repairs(1.0006f, 1), 1u);
  EXPECT_EQ(repairs(0.9994f, 1), 1u);
  EXPECT_EQ(repairs(1, 1.0002f), 1u);
  EXPECT_EQ(repairs(1, 0.9998f), 1u);
}

using test::nan;

/// Makes the last number of a field NaN; whether it has one.
template <class T>
bool spoil(T& field) {
  if constexpr (std::is_same_v<T, float>) {
    field = nan;
    return true;
  } else if constexpr (std::is_same_v<T, std::optional<float>>) {
    return spoil(field.emplace());
  } else if constexpr (std::is_same_v<T, std::optional<mat4>>) {
    return spoil(field.emplace(1)[2]);
  } else if constexpr (requires { field.length(); } && std::is_trivially_copyable_v<T>) {
    return spoil(field[field.length() - 1]);
  } else if constexpr (requires { field.back(); }) {
    return !field.empty() && spoil(field.back());
  } else {
    return false;
  }
}

TEST(ValidateRange, EveryNumberOfASceneMustBeFinite) {
  Scene plain = scene_of_one();
  plain.cameras.resize(1);
  plain.cameras[0].node = 0;
  plain.sphls = {{"s", 0, 0.1f, true}};
  plain.meshes.resize(1);
  Mesh& mesh = plain.meshes[0];
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.uvs[0] = mesh.uvs[1] = std::vector<vec2>(3);
  mesh.colors.assign(3, vec4(1));
  plain.animations.resize(1);
  plain.animations[0].channels = {{0, AnimationPath::scale, Interpolation::linear, {0}, {vec4(1)}}};
  plain.environment.emplace();
  plain.environment->equirect = image::Image(2, 1);
  EXPECT_TRUE(validate(plain).empty());

  int numbers = 0;
  for (bool more = true; more;) {
    Scene scene = plain;
    int i = 0;
    std::string spoiled;
    const auto visit = [&](const std::string& path, auto& field) {
      auto copy = field;
      if (!spoil(copy) || i++ != numbers) return;
      field = copy;
      spoiled = path;
    };
    test::SceneFields(scene, visit);
    more = !spoiled.empty();
    ++numbers;
    if (more) {
      EXPECT_THROW(validate(scene), Error) << spoiled;
    }
  }
  EXPECT_GT(numbers, 40);
}

}  // namespace
}  // namespace ssphh::scene
