#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/unit.h>

#include "places.h"
#include "shared_scenes.h"

namespace ssphh::scene_io {
namespace {

using scene::Scene;

// Keeps warnings of real files out of the test's output.
class RealScenes : public testing::Test {
 protected:
  void SetUp() override {
    sink_ = set_log_sink([](LogLevel, const std::string&) {});
  }
  void TearDown() override { set_log_sink(sink_); }

 private:
  LogSink sink_;
};

float area(const Scene& scene, const scene::Instance& instance, const std::vector<mat4>& world) {
  const auto& mesh = scene.meshes[instance.mesh];
  const mat4& m = world[instance.node];
  float sum = 0;
  for (const uvec3& t : mesh.triangles) {
    const vec3 a(m * vec4(mesh.positions[t.x], 1)), b(m * vec4(mesh.positions[t.y], 1)),
        c(m * vec4(mesh.positions[t.z], 1));
    sum += 0.5f * glm::length(glm::cross(b - a, c - a));
  }
  return sum;
}

TEST_F(RealScenes, EveryKhronosSampleLoads) {
  SSPHH_SHARED_SCENE(folder, "gltf-samples");
  int loaded = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".gltf" && extension != ".glb") continue;
    SCOPED_TRACE(entry.path());
    const Scene scene = load_scene(entry.path().string());
    EXPECT_GT(scene::triangle_count(scene), 0u);
    ++loaded;
  }
  EXPECT_EQ(loaded, 25);
}

TEST_F(RealScenes, CamerasSampleHasAPerspectiveAndAnOrthographicCamera) {
  SSPHH_SHARED_SCENE(path, "gltf-samples/Cameras/glTF/Cameras.gltf");
  const Scene scene = load_scene(path.string());
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_FALSE(scene.cameras[0].orthographic);
  EXPECT_FLOAT_EQ(scene.cameras[0].yfov, 0.7f);
  EXPECT_FLOAT_EQ(scene.cameras[0].aspect.value(), 1.0f);
  EXPECT_TRUE(scene.cameras[1].orthographic);
  EXPECT_FLOAT_EQ(scene.cameras[1].yheight, 2.0f);
}

TEST_F(RealScenes, LampSampleHasItsPointLightsAndGlass) {
  SSPHH_SHARED_SCENE(path, "gltf-samples/LightsPunctualLamp/glTF/LightsPunctualLamp.gltf");
  const Scene scene = load_scene(path.string());
  EXPECT_EQ(scene.lights.size(), 5u);
  for (const auto& light : scene.lights) EXPECT_EQ(light.type, scene::LightType::point);
  EXPECT_TRUE(scene.ignored.empty());
  EXPECT_EQ(std::ranges::count_if(scene.materials, &scene::Material::is_glass), 1);
}

TEST_F(RealScenes, TextureTransformsReachTheMaterials) {
  SSPHH_SHARED_SCENE(path, "gltf-samples/TextureTransformTest/glTF/TextureTransformTest.gltf");
  const Scene scene = load_scene(path.string());
  const auto use = [&](const std::string& name) {
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const scene::Material& m) { return m.name == name; });
    EXPECT_NE(found, scene.materials.end()) << name;
    return found == scene.materials.end() ? scene::TextureUse{} : found->base_color_texture;
  };
  EXPECT_EQ(use("Offset U").offset, vec2(0.5f, 0));
  EXPECT_EQ(use("Offset V").offset, vec2(0, 0.5f));
  EXPECT_FLOAT_EQ(use("Rotation").rotation, 0.39269908169872415480783042290993786f);
  EXPECT_EQ(use("Scale").scale, vec2(1.5f));
  EXPECT_EQ(use("All").offset, vec2(-0.2f, -0.1f));
}

TEST_F(RealScenes, NegativeScalesTurnHandednessInTheWorldMatrix) {
  SSPHH_SHARED_SCENE(path, "gltf-samples/NegativeScaleTest/glTF/NegativeScaleTest.gltf");
  const Scene scene = load_scene(path.string());
  const auto world = scene::world_matrices(scene);
  const auto mirrored =
      std::count_if(scene.instances.begin(), scene.instances.end(),
                    [&](const scene::Instance& i) { return glm::determinant(mat3(world[i.node])) < 0; });
  EXPECT_GT(mirrored, 0);
  EXPECT_LT(mirrored, static_cast<std::ptrdiff_t>(scene.instances.size()));
}

TEST_F(RealScenes, SparseAccessorReplacesThreeVertices) {
  SSPHH_SHARED_SCENE(path, "gltf-samples/SimpleSparseAccessor/glTF/SimpleSparseAccessor.gltf");
  const Scene scene = load_scene(path.string());
  ASSERT_EQ(scene.meshes.size(), 1u);
  const auto& p = scene.meshes[0].positions;
  ASSERT_EQ(p.size(), 14u);
  EXPECT_EQ(p[8], vec3(1, 2, 0));
  EXPECT_EQ(p[10], vec3(3, 3, 0));
  EXPECT_EQ(p[12], vec3(5, 4, 0));
  EXPECT_EQ(p[9], vec3(2, 1, 0));
}

TEST_F(RealScenes, StripsFansAndListsCoverTheSameArea) {
  SSPHH_SHARED_SCENE(path, "gltf-samples/MeshPrimitiveModes/glTF/MeshPrimitiveModes.gltf");
  const Scene scene = load_scene(path.string());
  ASSERT_EQ(scene.instances.size(), 3u);  // strip, fan, list of the same square; points and lines are ignored
  const auto world = scene::world_matrices(scene);
  for (const auto& instance : scene.instances) {
    EXPECT_FLOAT_EQ(area(scene, instance, world), area(scene, scene.instances[0], world));
    const auto& mesh = scene.meshes[instance.mesh];
    for (const uvec3& t : mesh.triangles) {
      const vec3 n =
          glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
      EXPECT_GT(n.z, 0) << "all triangles face the viewer";
    }
  }
  EXPECT_EQ(scene.ignored.size(), 4u);
}

TEST_F(RealScenes, GpuInstancesBecomeNodes) {
  SSPHH_SHARED_SCENE(path, "gltf-samples/SimpleInstancing/glTF/SimpleInstancing.gltf");
  const Scene scene = load_scene(path.string());
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 125u);
  const auto bounds = scene::world_bounds(scene, scene::world_matrices(scene));
  EXPECT_GT(2 * bounds.radius(), 10.0f) << "the cubes are spread out";
}

TEST_F(RealScenes, SponzaIsComplete) {
  SSPHH_SHARED_SCENE(path, "sponza/sponza.glb");
  const Scene scene = load_scene(path.string());
  EXPECT_EQ(scene::triangle_count(scene), 66445u);
  EXPECT_EQ(scene.materials.size(), 19u);
  EXPECT_EQ(scene.textures.size(), 10u);
  const auto bounds = scene::world_bounds(scene, scene::world_matrices(scene));
  const vec3 size = bounds.max - bounds.min;
  EXPECT_NEAR(size.x, 34.8f, 0.05f);  // the folder's README gives one decimal
  EXPECT_NEAR(size.y, 16.6f, 0.05f);
  EXPECT_NEAR(size.z, 15.6f, 0.05f);
}

TEST_F(RealScenes, SponzaOverlayAddsViewLightAndSphls) {
  SSPHH_SHARED_SCENE(path, "sponza/sponza.glb");
  LoadOptions options;
  options.overlay = test::source_dir() / "examples/scenes/sponza.ssphh.json";
  const Scene scene = load_scene(path.string(), options);
  EXPECT_EQ(scene.sphls.size(), 6u);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, scene::LightType::sphere);
  const auto pose = scene::camera_pose(scene, "customary");
  EXPECT_NEAR(glm::length(vec3(pose.world[3]) - vec3(14.45f, 6.894f, -1.185f)), 0, 1e-6);
  const vec3 forward = -vec3(pose.world[2]);
  const vec3 expected = glm::normalize(vec3(13.456f, 6.784f, -1.159f) - vec3(14.45f, 6.894f, -1.185f));
  EXPECT_GT(glm::dot(forward, expected), 0.999999f);
  const float horizontal = 2 * std::atan(std::tan(pose.camera.yfov / 2) * pose.camera.aspect.value());
  EXPECT_NEAR(glm::degrees(horizontal), 90.5f, 1e-3f);  // float rounding of tan and atan
}

TEST_F(RealScenes, HotelRoomIsInMillimetresAndTheLoaderSaysSo) {
  SSPHH_SHARED_SCENE(path, "hotel-room/scene-decoded.glb");
  std::vector<std::string> messages;
  set_log_sink([&](LogLevel, const std::string& message) { messages.push_back(message); });
  const Scene scene = load_scene(path.string());
  EXPECT_EQ(scene::triangle_count(scene), 99029u);  // 112,805 counts 20,664 lines by threes
  EXPECT_THAT(messages, testing::Contains(testing::HasSubstr("\"unit\": 0.001")));
  messages.clear();
  LoadOptions options;
  options.unit = "auto";
  const Scene guessed = load_scene(path.string(), options);
  EXPECT_THAT(messages, testing::Contains(testing::HasSubstr("its unit is taken for the millimetre")));
  const auto bounds = scene::world_bounds(guessed, scene::world_matrices(guessed));
  EXPECT_LT(2 * bounds.radius(), 50);
}

TEST_F(RealScenes, InMetresAreNotTakenForOthers) {
  for (const char* name :
       {"sponza/sponza.glb", "living-room/living-room.obj", "cornell-mcguire/CornellBox-Original.obj"}) {
    SSPHH_SHARED_SCENE(path, name);
    EXPECT_EQ(guess_unit(load_scene(path.string())), 1) << name;
  }
}

TEST_F(RealScenes, LivingRoomIsComplete) {
  SSPHH_SHARED_SCENE(path, "living-room/living-room.obj");
  const Scene scene = load_scene(path.string());
  EXPECT_EQ(scene::triangle_count(scene), 142973u);  // 143,163 faces, of which 190 have no area
  EXPECT_EQ(scene.materials.size(), 19u);
  EXPECT_EQ(scene.instances.size(), 65u);
  std::size_t vertices = 0;
  for (const auto& mesh : scene.meshes) {
    vertices += mesh.positions.size();
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_EQ(mesh.uvs[0].size(), mesh.positions.size());
  }
  EXPECT_LE(vertices, 119519u) << "equal corners are one vertex";
}

TEST_F(RealScenes, LightsOfTheCornellBoxesShineDown) {
  SSPHH_SHARED_SCENE(folder, "cornell-mcguire");
  for (const char* name : {"Original", "Mirror", "Glossy", "Sphere"}) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene((folder / (std::string("CornellBox-") + name + ".obj")).string());
    int lights = 0;
    for (const auto& instance : scene.instances) {
      const auto& mesh = scene.meshes[instance.mesh];
      if (!scene.materials[mesh.material].emissive()) continue;
      ++lights;
      EXPECT_EQ(instance.light_group, "light");
      for (const uvec3& t : mesh.triangles) {
        const vec3 n =
            glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
        EXPECT_LT(n.y, 0) << "one-sided emission lights the box";
      }
    }
    EXPECT_EQ(lights, 1);
    EXPECT_EQ(scene::light_groups(scene), std::vector<std::string>{"light"});
  }
}

TEST_F(RealScenes, EveryBrokenGltfLoadsOrSaysWhatIsWrong) {
  SSPHH_SHARED_SCENE(folder, "broken/gltf");
  int files = 0, errors = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".gltf" && extension != ".glb") continue;
    ++files;
    SCOPED_TRACE(entry.path());
    try {
      load_scene(entry.path().string());
      if (std::getenv("SSPHH_LIST_BROKEN")) fprintf(stderr, "loads  %s\n", entry.path().filename().c_str());
    } catch (const Error& e) {
      ++errors;
      EXPECT_NE(e.where().find(entry.path().filename().string()), std::string::npos) << e.what();
      EXPECT_FALSE(e.problem().empty());
      if (std::getenv("SSPHH_LIST_BROKEN")) fprintf(stderr, "error  %s\n", e.what());
    }
  }
  EXPECT_EQ(files, 186);
  EXPECT_EQ(errors, 67);
}

}  // namespace
}  // namespace ssphh::scene_io
