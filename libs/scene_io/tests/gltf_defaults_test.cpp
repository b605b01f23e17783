// What glTF 2.0 and its extensions say of members that a file leaves out, and codes that it writes.

#include <gtest/gtest.h>

#include <ssphh/image/io.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf.h>

#include "glb_builder.h"

namespace ssphh::scene_io {
namespace {

using scene::Scene;
using test::GlbBuilder;

Scene load_json(const std::string& members) {
  const std::string json = "{\"asset\":{\"version\":\"2.0\"}," + members + "}";
  return load_gltf(std::as_bytes(std::span(json)), "test.gltf");
}

void expect_default(const scene::Material& m) {
  EXPECT_EQ(m.base_color, vec3(1));
  EXPECT_EQ(m.alpha, 1);
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.specular_roughness, 1);
  EXPECT_EQ(m.diffuse_roughness, 0);
  EXPECT_EQ(m.emission, vec3(0));
  EXPECT_EQ(m.specular, 1);
  EXPECT_EQ(m.ior, 1.5f);
  EXPECT_EQ(m.transmission, 0);
  EXPECT_EQ(m.alpha_mode, scene::AlphaMode::opaque);
  EXPECT_EQ(m.alpha_cutoff, 0.5f);
  EXPECT_EQ(m.normal_scale, 1);
  EXPECT_FALSE(m.double_sided);
  EXPECT_FALSE(m.unlit);
}

TEST(GltfDefaults, EmptyMaterialsAndPrimitivesWithoutOneAreWhiteRoughMetals) {
  for (const char* material : {"{}", "{\"pbrMetallicRoughness\":{}}", "{\"alphaMode\":\"OPAQUE\"}"}) {
    SCOPED_TRACE(material);
    expect_default(load_json(std::string("\"materials\":[") + material + "]").materials.at(0));
  }
  GlbBuilder b;
  b.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  const Scene scene = load_gltf(
      b.glb("\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
            "\"materials\":[{\"doubleSided\":true}]"),
      "test.glb");
  const int material = scene::instance_material(scene, scene.instances.at(0));
  ASSERT_EQ(material, 1);
  expect_default(scene.materials.at(1));
}

TEST(GltfDefaults, MaterialExtensionsGoToTheirFields) {
  const Scene scene = load_json(
      "\"materials\":[{\"alphaMode\":\"MASK\",\"alphaCutoff\":0.3,\"emissiveFactor\":[0.5,0.25,1],"
      "\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.7},\"KHR_materials_specular\":{\"specularFactor\":0."
      "6},"
      "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":6},\"KHR_materials_unlit\":{}}},"
      "{\"emissiveFactor\":[0.5,0.25,1],\"extensions\":{\"KHR_materials_ior\":{},\"KHR_materials_specular\":{"
      "},"
      "\"KHR_materials_emissive_strength\":{}}},"
      "{\"extensions\":{\"KHR_materials_ior\":{\"ior\":0}}}]");
  const scene::Material &given = scene.materials.at(0), &left_out = scene.materials.at(1);
  EXPECT_EQ(given.alpha_mode, scene::AlphaMode::mask);
  EXPECT_EQ(given.alpha_cutoff, 0.3f);
  EXPECT_EQ(given.ior, 1.7f);
  EXPECT_EQ(given.specular, 0.6f);
  EXPECT_EQ(given.emission, vec3(3, 1.5f, 6));
  EXPECT_TRUE(given.unlit);
  EXPECT_EQ(left_out.ior, 1.5f);
  EXPECT_EQ(left_out.specular, 1);
  EXPECT_EQ(left_out.emission, vec3(0.5f, 0.25f, 1));
  // 0 asks for a Fresnel term of 1: (ior − 1)²/(ior + 1)² within 1e-5
  const float ior = scene.materials.at(2).ior;
  EXPECT_NEAR(std::pow((ior - 1) / (ior + 1), 2), 1, 1e-5);
}

TEST(GltfDefaults, GlassIsAThinSheetUnlessAVolumeSaysThatItIsThick) {
  const Scene scene = load_json(
      "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0},"
      "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":0.75},"
      "\"KHR_materials_volume\":{\"thicknessFactor\":0.5,\"attenuationDistance\":2,"
      "\"attenuationColor\":[0.5,0.25,1]}}},"
      "{\"extensions\":{\"KHR_materials_transmission\":{},\"KHR_materials_volume\":{}}},"
      "{\"extensions\":{\"KHR_materials_volume\":{\"thicknessFactor\":0.5}}}]");
  const scene::Material &body = scene.materials.at(0), &left_out = scene.materials.at(1);
  EXPECT_EQ(body.transmission, 0.75f);
  EXPECT_EQ(body.thickness, 0.5f);
  EXPECT_EQ(body.attenuation_distance, 2);
  EXPECT_EQ(body.attenuation_color, vec3(0.5f, 0.25f, 1));
  EXPECT_TRUE(body.is_glass());
  EXPECT_EQ(left_out.transmission, 0);
  EXPECT_EQ(left_out.thickness, 0);
  EXPECT_EQ(left_out.attenuation_color, vec3(1));
  EXPECT_EQ(left_out.attenuation_distance, 0) << "absorbs nothing";
  EXPECT_EQ(scene.materials.at(2).thickness, 0) << "a volume alone lets nothing in";
}

TEST(GltfDefaults, GlassThatCannotBeIsAnErrorThatNamesTheMember) {
  const auto said = [](const std::string& transmission, const std::string& volume) {
    try {
      load_json("\"materials\":[{\"extensions\":{\"KHR_materials_transmission\":" + transmission +
                ",\"KHR_materials_volume\":" + volume + "}}]");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(said("{}", "{}"), "");
  EXPECT_NE(said("{\"transmissionFactor\":1.5}", "{}").find("transmissionFactor"), std::string::npos);
  EXPECT_NE(said("{\"transmissionFactor\":-1}", "{}").find("transmissionFactor"), std::string::npos);
  EXPECT_NE(said("{}", "{\"thicknessFactor\":-1}").find("thicknessFactor"), std::string::npos);
  for (const char* distance : {"0", "-2"}) {
    const std::string message = said("{}", std::string("{\"attenuationDistance\":") + distance + "}");
    EXPECT_NE(message.find("attenuationDistance"), std::string::npos) << message;
    EXPECT_NE(message.find("must be greater than 0"), std::string::npos) << message;
  }
}

TEST(GltfDefaults, LightsAreWhiteOfIntensityOneWithoutRangeAndSpotsHaveAConeOf45Degrees) {
  const Scene scene = load_json(
      "\"nodes\":[{\"name\":\"n\",\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
      "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}},"
      "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":2}}}],"
      "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\"},{\"type\":\"spot\",\"spot\":"
      "{}},"
      "{\"type\":\"directional\",\"color\":[0.5,0.25,0.125],\"intensity\":3,\"range\":2}]}}");
  for (const std::size_t i : {0u, 1u}) {
    const scene::Light& light = scene.lights.at(i);
    EXPECT_EQ(light.color, vec3(1));
    EXPECT_EQ(light.intensity, 1);
    EXPECT_EQ(light.range, 0) << "unlimited";
  }
  EXPECT_EQ(scene.lights[0].name, "n") << "a light without a name has its node's";
  EXPECT_EQ(scene.lights[1].inner_cone, 0);
  EXPECT_FLOAT_EQ(scene.lights[1].outer_cone, glm::radians(45.0f));
  EXPECT_EQ(scene.lights[2].type, scene::LightType::directional);
  EXPECT_EQ(scene.lights[2].color, vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(scene.lights[2].intensity, 3);
  EXPECT_EQ(scene.lights[2].range, 0) << "suns reach everywhere";
}

TEST(GltfDefaults, CamerasAreGivenByTheirHalfHeightOrTheirAngle) {
  const Scene scene = load_json(
      "\"nodes\":[{\"camera\":0},{\"camera\":1}],\"cameras\":["
      "{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":6,\"ymag\":1.5,\"znear\":0,\"zfar\":9}},"
      "{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.7,\"aspectRatio\":1.25,\"znear\":0.1}}]");
  EXPECT_TRUE(scene.cameras.at(0).orthographic);
  EXPECT_EQ(scene.cameras[0].yheight, 3);
  EXPECT_EQ(scene.cameras[0].aspect, 4);
  EXPECT_FALSE(scene.cameras.at(1).orthographic);
  EXPECT_EQ(scene.cameras[1].yfov, 0.7f);
  EXPECT_EQ(scene.cameras[1].aspect, 1.25f);
}

TEST(GltfDefaults, SamplersRepeatAndInterpolateUnlessTheySayOtherwise) {
  GlbBuilder b;
  const int view = b.view(image::encode_png(image::Rgba8{1, 1, {1, 2, 3, 4}}));
  const Scene scene = load_gltf(
      b.glb(fmt::format("\"images\":[{{\"bufferView\":{},\"mimeType\":\"image/png\"}}],"
                        "\"samplers\":[{{}},{{\"wrapS\":33648,\"wrapT\":33071,\"magFilter\":9728}},"
                        "{{\"wrapS\":10497,\"magFilter\":9729,\"minFilter\":9728}}],"
                        "\"textures\":[{{\"source\":0}},{{\"source\":0,\"sampler\":0}},"
                        "{{\"source\":0,\"sampler\":1}},{{\"source\":0,\"sampler\":2}}],"
                        "\"materials\":[{{\"pbrMetallicRoughness\":{{\"baseColorTexture\":{{\"index\":0}},"
                        "\"metallicRoughnessTexture\":{{\"index\":1}}}},"
                        "\"normalTexture\":{{\"index\":2,\"texCoord\":1,\"scale\":0.4}},"
                        "\"emissiveTexture\":{{\"index\":3}}}}]",
                        view)),
      "test.glb");
  const scene::Material& m = scene.materials.at(0);
  for (const scene::TextureUse* use :
       {&m.base_color_texture, &m.metallic_roughness_texture, &m.emission_texture}) {
    EXPECT_EQ(use->texture, 0);
    EXPECT_EQ(use->wrap_u, scene::Wrap::repeat);
    EXPECT_EQ(use->wrap_v, scene::Wrap::repeat);
    EXPECT_FALSE(use->nearest) << "minFilter does not count";
    EXPECT_EQ(use->uv_set, 0);
    EXPECT_EQ(use->scale, vec2(1));
    EXPECT_EQ(use->offset, vec2(0));
  }
  EXPECT_EQ(m.normal_texture.wrap_u, scene::Wrap::mirror);
  EXPECT_EQ(m.normal_texture.wrap_v, scene::Wrap::clamp);
  EXPECT_TRUE(m.normal_texture.nearest);
  EXPECT_EQ(m.normal_texture.uv_set, 1);
  EXPECT_EQ(m.normal_scale, 0.4f);
  EXPECT_EQ(scene.textures.size(), 1u) << "one image is one texture";
}

TEST(GltfDefaults, VertexColoursWithoutAlphaAreWhole) {
  GlbBuilder b;
  b.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  b.add<float>({0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f}, 5126, "VEC3", 3);
  const Scene scene = load_gltf(b.glb("\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
                                      "{\"POSITION\":0,\"COLOR_0\":1}}]"
                                      "}]"),
                                "test.glb");
  EXPECT_EQ(scene.meshes.at(0).colors.at(1), vec4(0.4f, 0.5f, 0.6f, 1));
}

/// Of a primitive of five or six vertices in the order 4 3 2 1 0 (5), by mode.
std::vector<uvec3> triangles(int mode, const std::vector<std::uint16_t>& indices) {
  GlbBuilder b;
  b.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 3, 0, 2, 5, 1, 9, 7, 4}, 5126, "VEC3", 6);
  b.add(indices, 5123, "SCALAR", indices.size());
  const auto glb =
      b.glb(fmt::format("\"nodes\":[{{\"mesh\":0}}],\"meshes\":[{{\"primitives\":[{{\"attributes\":"
                        "{{\"POSITION\":0}},\"indices\":1,\"mode\":{}}}]}}]",
                        mode));
  return load_gltf(glb, "test.glb").meshes.at(0).triangles;
}

// glTF 2.0, 3.7.2.1: p_i = {v_i, v_(i + 1 + i % 2), v_(i + 2 − i % 2)} of strips, {v_(i+1), v_(i+2), v_0} of
// fans.
TEST(GltfDefaults, StripsAndFansKeepTheOrientationOfEveryTriangle) {
  EXPECT_EQ(triangles(5, {4, 3, 2, 1, 0}), (std::vector<uvec3>{{4, 3, 2}, {3, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(triangles(6, {4, 3, 2, 1, 0}), (std::vector<uvec3>{{3, 2, 4}, {2, 1, 4}, {1, 0, 4}}));
  EXPECT_EQ(triangles(4, {4, 3, 2, 1, 0, 5, 3}), (std::vector<uvec3>{{4, 3, 2}, {1, 0, 5}}))
      << "corners beyond the last whole triangle do not count";
}

TEST(GltfDefaults, InstancesStandWhereTheirAttributesSayBelowTheirNode) {
  GlbBuilder b;
  b.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  b.add<float>({1, 2, 3, 4, 5, 6}, 5126, "VEC3", 2);
  // About (1, −2, 2); sine and cosine of half the angle are 0.6 and 0.8
  b.add<float>({0, 0, 0, 1, 0.2f, -0.4f, 0.4f, 0.8f}, 5126, "VEC4", 2);
  b.add<float>({1, 1, 1, 2, 3, 4}, 5126, "VEC3", 2);
  const Scene scene = load_gltf(
      b.glb("\"nodes\":[{\"name\":\"n\",\"translation\":[10,20,30],\"mesh\":0,\"extensions\":{"
            "\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":1,\"ROTATION\":2,\"SCALE\":3}}},"
            "\"extras\":{\"light_group\":\"g\"}}],"
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"),
      "test.glb");
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].light_group, "g");
  const std::vector<mat4> world = scene::world_matrices(scene);
  const auto place = [&](std::size_t i, const vec3& p) {
    return vec3(world[scene.instances[i].node] * vec4(p, 1));
  };
  EXPECT_EQ(place(0, {1, 1, 1}), vec3(12, 23, 34));
  // Scaled to (2, 3, 4), turned by Rodrigues' formula with sin 0.96 and cos 0.28, moved
  const vec3 axis = vec3(1, -2, 2) / 3.0f, p(2, 3, 4);
  const vec3 turned = 0.28f * p + 0.96f * glm::cross(axis, p) + 0.72f * glm::dot(axis, p) * axis;
  EXPECT_LT(glm::distance(place(1, {1, 1, 1}), vec3(14, 25, 36) + turned), 1e-5f);  // rounding
}

}  // namespace
}  // namespace ssphh::scene_io
