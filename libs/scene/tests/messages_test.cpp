/// What is meant where nobody says anything, and what is said of what cannot be.

#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>

#include "error_message.h"
#include "not_finite.h"

namespace ssphh::scene {
namespace {

using ssphh::test::message_of;

using test::infinity;

TEST(SceneMessages, OfBodies) {
  const std::vector<vec3> corners = {vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)};
  const std::vector<uvec3> one = {{0, 1, 2}}, beyond = {{0, 1, 3}}, none;
  EXPECT_EQ(message_of([&] { make_polygon(corners, one); }), "no error");
  EXPECT_EQ(message_of([&] { make_polygon(corners, none); }), "polygon: it needs 3 corners and a triangle");
  EXPECT_EQ(message_of([&] { make_polygon(std::span(corners).first(2), one); }),
            "polygon: it needs 3 corners and a triangle");
  EXPECT_EQ(message_of([&] { make_polygon(corners, beyond); }),
            "polygon: a triangle names a corner that is not there");
  EXPECT_EQ(message_of([] { make_sphere(1, 3, 2); }), "no error");
  for (const auto& counts : {std::pair{2, 2}, {3, 1}}) {
    EXPECT_EQ(message_of([&] { make_sphere(1, counts.first, counts.second); }),
              "sphere: it needs at least 3 segments and 2 rings");
  }
  EXPECT_EQ(message_of([] { make_torus(1, 0.1f, 3, 3); }), "no error");
  for (const auto& counts : {std::pair{2, 3}, {3, 2}}) {
    EXPECT_EQ(message_of([&] { make_torus(1, 0.1f, counts.first, counts.second); }),
              "torus: it needs at least 3 segments and 3 sides");
    EXPECT_EQ(message_of([&] {
                make_tube([](float t) { return vec3(t, 0, 0); }, false, 1, counts.first, counts.second);
              }),
              "tube: it needs at least 3 segments and 3 sides");
  }
  EXPECT_EQ(message_of([] { make_tube(nullptr, false, 1, 3, 3); }), "tube: it has no curve");
  const std::vector<vec2> profile = {{0, 0}, {1, 1}, {0, 2}};
  const auto lathe = [](std::vector<vec2> points, int segments) {
    return message_of([&] { make_lathe(points, segments); });
  };
  EXPECT_EQ(lathe(profile, 3), "no error");
  EXPECT_EQ(lathe(profile, 2), "lathe: it needs at least 3 points and 3 segments");
  EXPECT_EQ(lathe({{0, 0}, {0, 1}}, 3), "lathe: it needs at least 3 points and 3 segments");
  EXPECT_EQ(lathe({{1, 0}, {1, 1}, {0, 2}}, 3), "lathe: its profile must begin and end at radius 0");
  EXPECT_EQ(lathe({{0, 0}, {1, 1}, {1, 2}}, 3), "lathe: its profile must begin and end at radius 0");
  EXPECT_EQ(lathe({{0, 0}, {1, 1}, {1, 1}, {0, 2}}, 3), "lathe: two points of its profile are one");
}

TEST(SceneMessages, OfQuestions) {
  Scene scene = make_builtin("cornell");
  const std::vector<mat4> few;
  EXPECT_EQ(message_of([&] { world_bounds(scene, few); }), "scene: there is not one matrix for each node");
  EXPECT_EQ(message_of([] { light_group_index({}, "x"); }), "light groups: there are none");
  EXPECT_EQ(message_of([] { make_builtin("x"); }),
            "builtin:x: no such built-in scene (there are: cornell, furnace, box, two-rooms, court, "
            "gallery1, gallery2, "
            "gallery3, house, ajar, tunnel, torch, car, fishtank, town, random)");
  scene = Scene();
  EXPECT_EQ(message_of([&] { find_camera(scene, "c"); }),
            "scene: has no camera \"c\" (it has no cameras; leave the name out for a view of the whole)");
  scene.name = "hall";
  scene.cameras.resize(2);
  scene.cameras[0].name = "a", scene.cameras[1].name = "b";
  EXPECT_EQ(message_of([&] { find_camera(scene, "c"); }), "hall: has no camera \"c\" (its cameras: a, b)");
  EXPECT_EQ(find_camera(scene, "b").name, "b");
  EXPECT_EQ(find_camera(scene, "").name, "a");
}

TEST(SceneMessages, OfTheSky) {
  const auto said = [](const std::function<void(SunSkyParams&)>& change) {
    SunSkyParams params;
    params.width = 4;
    change(params);
    return message_of([&] {
      Scene scene;
      add_sun_sky(scene, params);
    });
  };
  EXPECT_EQ(said([](auto& p) { p.elevation = 0; }), "no error");
  EXPECT_EQ(said([](auto& p) { p.elevation = pi / 2; }), "no error");
  EXPECT_EQ(said([](auto& p) { p.elevation = -0.5f; }),
            "sun and sky: elevation: -0.5 is out of range (Preetham's model knows 0 to π/2 (90°); the "
            "physical sky has dusk and night, too)");
  EXPECT_EQ(said([](auto& p) { p.elevation = 1.75f; }),
            "sun and sky: elevation: 1.75 is out of range (Preetham's model knows 0 to π/2 (90°); the "
            "physical sky has dusk and night, too)");
  EXPECT_EQ(said([](auto& p) { p.turbidity = 1.7f; }), "no error");
  EXPECT_EQ(said([](auto& p) { p.turbidity = 10; }), "no error");
  EXPECT_EQ(said([](auto& p) { p.turbidity = 1.5f; }),
            "sun and sky: turbidity: 1.5 is out of range (the model knows 1.7 to 10)");
  EXPECT_EQ(said([](auto& p) { p.turbidity = 10.5f; }),
            "sun and sky: turbidity: 10.5 is out of range (the model knows 1.7 to 10)");
  EXPECT_EQ(said([](auto& p) { p.azimuth = infinity; }),
            "sun and sky: azimuth: inf is out of range (give an angle)");
  EXPECT_EQ(said([](auto& p) { p.ground_albedo.x = infinity; }),
            "sun and sky: ground albedo: inf is out of range (give numbers from 0 to 1)");
  EXPECT_EQ(said([](auto& p) { p.width = 3; }), "sun and sky: width: 3 is out of range (4 to 16384 pixels)");
  EXPECT_EQ(said([](auto& p) { p.width = 16385; }),
            "sun and sky: width: 16385 is out of range (4 to 16384 pixels)");
}

/// What is said of a scene of one of everything, with a fault in it.
std::string said_of(const std::function<void(Scene&)>& fault) {
  Scene s;
  s.textures.push_back({"t", 2, 1, std::vector<std::uint8_t>(8)});
  s.materials.resize(1);
  s.materials[0].name = "m";
  s.meshes.push_back(make_box(vec3(0), vec3(1)));
  s.meshes[0].name = "b", s.meshes[0].material = 0;
  s.nodes.resize(2);
  s.nodes[0].name = "n", s.nodes[1].parent = 0;
  s.instances.push_back({0, 0, -1, {}});
  s.cameras.resize(1), s.lights.resize(1), s.sphls.resize(1);
  s.cameras[0].name = "c", s.lights[0].name = "l", s.sphls[0].name = "s";
  s.animations.push_back(
      {"a", {{1, AnimationPath::scale, Interpolation::linear, {0, 1}, {vec4(1), vec4(2)}}}});
  s.environment.emplace();
  fault(s);
  return message_of([&] { validate(s); });
}

TEST(SceneMessages, OfIndicesAndSizes) {
  EXPECT_EQ(said_of([](Scene&) {}), "no error");
  EXPECT_EQ(said_of([](Scene& s) { s.textures[0].height = 0; }), "texture 0 \"t\": has 2×0 texels");
  EXPECT_EQ(said_of([](Scene& s) { s.textures[0].rgba.pop_back(); }),
            "texture 0 \"t\": 7 bytes instead of 8");
  EXPECT_EQ(said_of([](Scene& s) { s.materials[0].normal_texture.texture = 1; }),
            "material 0 \"m\": refers to texture 1 of 1");
  EXPECT_EQ(said_of([](Scene& s) { s.materials[0].base_color_texture.uv_set = 2; }),
            "material 0 \"m\": uses texture coordinates 2");
  EXPECT_EQ(said_of([](Scene& s) { s.materials[0].base_color_texture.uv_set = -1; }),
            "material 0 \"m\": uses texture coordinates -1");
  EXPECT_EQ(said_of([](Scene& s) { s.meshes[0].material = 1; }), "mesh 0 \"b\": refers to material 1 of 1");
  EXPECT_EQ(said_of([](Scene& s) { s.meshes[0].normals.pop_back(); }),
            "mesh 0 \"b\": 23 normals for 24 positions");
  EXPECT_EQ(said_of([](Scene& s) { s.meshes[0].tangents.resize(25); }),
            "mesh 0 \"b\": 25 tangents for 24 positions");
  EXPECT_EQ(said_of([](Scene& s) { s.meshes[0].colors.resize(1); }),
            "mesh 0 \"b\": 1 colours for 24 positions");
  EXPECT_EQ(said_of([](Scene& s) { s.meshes[0].uvs[1].resize(1); }),
            "mesh 0 \"b\": 1 texture coordinates for 24 positions");
  EXPECT_EQ(said_of([](Scene& s) {
              s.meshes[0].triangles[3] = {1, 24, 2};
            }),
            "mesh 0 \"b\": triangle 3 refers to vertex 24 of 24");
  EXPECT_EQ(said_of([](Scene& s) { s.nodes[1].parent = 1; }),
            "node 1: has parent 1; parents stand before their children");
  EXPECT_EQ(said_of([](Scene& s) { s.nodes[0].parent = -2; }),
            "node 0 \"n\": has parent -2; parents stand before their children");
  EXPECT_EQ(said_of([](Scene& s) { s.instances[0].mesh = 1; }), "instance 0: refers to mesh 1 of 1");
  EXPECT_EQ(said_of([](Scene& s) { s.instances[0].mesh = -1; }), "instance 0: refers to mesh -1 of 1");
  EXPECT_EQ(said_of([](Scene& s) { s.instances[0].material = -2; }),
            "instance 0: refers to material -2 of 1");
  EXPECT_EQ(said_of([](Scene& s) { s.instances[0].node = 2; }), "instance 0: refers to node 2 of 2");
  EXPECT_EQ(said_of([](Scene& s) { s.cameras[0].node = 2; }), "camera 0 \"c\": refers to node 2 of 2");
  EXPECT_EQ(said_of([](Scene& s) { s.lights[0].node = -2; }), "light 0 \"l\": refers to node -2 of 2");
  EXPECT_EQ(said_of([](Scene& s) { s.sphls[0].node = 2; }), "SPHL 0 \"s\": refers to node 2 of 2");
  const std::string channel = "animation 0 \"a\" channel 0: ";
  EXPECT_EQ(said_of([](Scene& s) { s.animations[0].channels[0].node = -1; }),
            channel + "refers to node -1 of 2");
  EXPECT_EQ(said_of([](Scene& s) { s.animations[0].channels[0].times.clear(); }), channel + "has no keys");
  EXPECT_EQ(said_of([](Scene& s) { s.animations[0].channels[0].values.pop_back(); }),
            channel + "1 values for 2 keys");
  EXPECT_EQ(
      said_of([](Scene& s) { s.animations[0].channels[0].interpolation = Interpolation::cubic_spline; }),
      channel + "2 values for 2 keys");
}

TEST(SceneMessages, OfNumbers) {
  EXPECT_EQ(said_of([](Scene& s) { s.materials[0].base_color.y = NAN; }),
            "material 0 \"m\": base colour is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.materials[0].emission.z = infinity; }),
            "material 0 \"m\": emission is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.materials[0].alpha_cutoff = NAN; }),
            "material 0 \"m\": a parameter is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.materials[0].normal_texture.scale.y = NAN; }),
            "material 0 \"m\": texture transform is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.meshes[0].positions[7].x = NAN; }),
            "mesh 0 \"b\": position 7 is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.meshes[0].uvs[0][5].y = NAN; }),
            "mesh 0 \"b\": texture coordinate 5 is not finite");
  EXPECT_EQ(said_of([](Scene& s) {
              s.meshes[0].colors.resize(24);
              s.meshes[0].colors[4].w = NAN;
            }),
            "mesh 0 \"b\": colour 4 is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.nodes[0].local.translation.y = NAN; }),
            "node 0 \"n\": translation is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.nodes[0].local.scale.z = NAN; }), "node 0 \"n\": scale is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.nodes[0].local.rotation.w = NAN; }),
            "node 0 \"n\": rotation is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.nodes[0].matrix = mat4(NAN); }), "node 0 \"n\": matrix is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.nodes[0].matrix = mat4(2); }), "node 0 \"n\": matrix is not affine");
  const std::string channel = "animation 0 \"a\" channel 0: ";
  EXPECT_EQ(said_of([](Scene& s) { s.animations[0].channels[0].times[0] = NAN; }),
            channel + "a key's time is not finite");
  for (const float time : {0.0f, -1.0f, infinity})
    EXPECT_EQ(said_of([&](Scene& s) { s.animations[0].channels[0].times[1] = time; }),
              channel + "times do not increase");
  EXPECT_EQ(said_of([](Scene& s) { s.animations[0].channels[0].values[1].w = NAN; }),
            channel + "a key's value is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.cameras[0].aspect = NAN; }),
            "camera 0 \"c\": a parameter is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.cameras[0].yfov = 4; }),
            "camera 0 \"c\": yfov is 4 rad (it must lie between 0 and π)");
  EXPECT_EQ(said_of([](Scene& s) { s.cameras[0].orthographic = true, s.cameras[0].yheight = 0; }),
            "camera 0 \"c\": has no height");
  EXPECT_EQ(said_of([](Scene& s) { s.lights[0].color.x = NAN; }), "light 0 \"l\": colour is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.lights[0].range = NAN; }), "light 0 \"l\": a parameter is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.lights[0].type = LightType::sphere; }),
            "light 0 \"l\": sphere of radius 0 m (give it a radius above 0)");
  EXPECT_EQ(said_of([](Scene& s) { s.lights[0].type = LightType::disc; }),
            "light 0 \"l\": disc of radius 0 m (give it a radius above 0)");
  EXPECT_EQ(said_of([](Scene& s) {
              s.lights[0].type = LightType::rectangle, s.lights[0].size = {2, 0};
            }),
            "light 0 \"l\": rectangle of 2 × 0 m (give it a width and a height above 0)");
  EXPECT_EQ(said_of([](Scene& s) { s.sphls[0].radius = 0; }),
            "SPHL 0 \"s\": radius is 0 m (give it a radius above 0)");
  const std::string environment = "environment 0 \"environment\": ";
  EXPECT_EQ(said_of([](Scene& s) { s.environment->color.y = NAN; }), environment + "colour is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.environment->rotation = NAN; }), environment + "rotation is not finite");
  EXPECT_EQ(said_of([](Scene& s) { s.environment->equirect = image::Image(4, 2, 2); }),
            environment + "image of 4×2×2 has 16 values");
  EXPECT_EQ(said_of([](Scene& s) {
              s.environment->equirect = image::Image(4, 2);
              s.environment->equirect.pixels[23] = NAN;
            }),
            environment + "image holds a value that is not finite");
}

}  // namespace
}  // namespace ssphh::scene
