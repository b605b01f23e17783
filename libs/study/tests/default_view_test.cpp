#include <algorithm>
#include <memory>
#include <span>

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>
#include <ssphh/study/default_view.h>

#include "stage.h"
#include "triangle_source.h"

namespace ssphh::study {
namespace {

using scene::CameraPose;
using scene::Scene;

const vec3 half(3, 1.3f, 2);

/// A room of 6 by 2.6 by 4 m, seen from inside, with a table; its lamp is a part of the ceiling.
Scene furnished_room(float size = 1, bool lit = true) {
  Scene s;
  s.materials = {test::matte(vec3(0.8f)), test::matte(vec3(0.5f)), test::matte(vec3(0))};
  if (lit) s.materials[2].emission = vec3(5);
  test::add_mesh(s, scene::flipped(scene::make_box(-size * half, size * half)), 0);
  test::add_mesh(s, scene::make_box(size * vec3(1, -1.3f, 0), size * vec3(2, -0.5f, 1)), 1);
  test::add_mesh(s, scene::make_quad(size * vec3(-2, 1.29f, -1), size * vec3(3, 0, 0), size * vec3(0, 0, 2)),
                 2);
  return s;
}

CameraPose view_of(const Scene& scene) {
  return default_view(scene, test::TriangleSource(scene));
}
vec3 eye_of(const CameraPose& pose) {
  return vec3(pose.world[3]);
}
bool is_within(const vec3& p, const vec3& most) {
  return glm::all(glm::lessThan(glm::abs(p), most));
}

/// Whether a picture as wide as high shows the point.
bool shows(const CameraPose& pose, const vec3& point) {
  const vec3 p(glm::inverse(pose.world) * vec4(point, 1));
  const float reach = -p.z * std::tan(0.5f * pose.camera.yfov);
  return p.z < 0 && std::abs(p.x) <= reach && std::abs(p.y) <= reach;
}
bool shows_box(const CameraPose& pose, const vec3& most) {
  for (int corner = 0; corner < 8; ++corner) {
    if (!shows(pose, most * vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1)))
      return false;
  }
  return true;
}

TEST(DefaultView, StandsInARoomAndLooksAcrossIt) {
  const CameraPose pose = view_of(furnished_room());
  const vec3 eye = eye_of(pose), forward(-pose.world[2]);
  EXPECT_TRUE(is_within(eye, half));
  EXPECT_NEAR(eye.y, -1.3f + 1.56f, 0.01f) << "six tenths of the height, which is less than 1.6 m";
  EXPECT_LT(std::abs(forward.y), 0.2f);
  const vec3 ahead = eye + 2.5f * forward;
  EXPECT_TRUE(is_within(vec3(ahead.x, 0, ahead.z), half)) << "no wall before the camera";
  EXPECT_TRUE(shows(pose, {1.5f, -0.5f, 0.5f})) << "the table";
}

TEST(DefaultView, DoesNotStandWhereNoLightGets) {
  EXPECT_TRUE(shows_box(view_of(furnished_room(1, false)), half));
}

/// The scene with a lamp that is no surface and lights all of it alike.
class LampSource : public test::TriangleSource {
 public:
  LampSource(const Scene& scene, const vec3& irradiance) : TriangleSource(scene), irradiance_(irradiance) {}
  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::unique_ptr<rays::DirectLight> direct_light(std::span<const scene::LightState>, std::span<const mat4>,
                                                  const scene::EnvironmentState&) const override {
    return std::make_unique<Even>(irradiance_);
  }

 private:
  struct Even final : rays::DirectLight {
    explicit Even(const vec3& of) : irradiance_(of) {}
    void irradiance(int, std::span<const rays::SurfacePoint>, std::span<vec3> out) const override {
      std::ranges::fill(out, irradiance_);
    }
    vec3 irradiance_;
  };
  vec3 irradiance_;
  std::vector<std::string> groups_ = {"lamp"};
};

TEST(DefaultView, StandsWhereALampLightsInWhateverColour) {
  const Scene room = furnished_room(1, false);
  for (const vec3& color : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)})
    EXPECT_TRUE(is_within(eye_of(default_view(room, LampSource(room, color))), half));
  EXPECT_FALSE(is_within(eye_of(default_view(room, LampSource(room, vec3(0)))), half));
}

TEST(DefaultView, StandsBeforeThings) {
  Scene thing = furnished_room();
  thing.meshes[0] = scene::make_box(-half, half);
  thing.meshes[0].material = 0;
  const CameraPose pose = view_of(thing);
  EXPECT_TRUE(shows_box(pose, half));
  EXPECT_GT(eye_of(pose).y, half.y) << "from above";
  EXPECT_GT(eye_of(pose).z, half.z) << "from in front";
  EXPECT_FALSE(shows_box(pose, 1.2f * half)) << "no farther than needed";
  EXPECT_TRUE(shows_box(view_of(furnished_room(0.1f)), 0.1f * half)) << "a box may be hollow: it is no room";
}

TEST(DefaultView, AWideGroundChangesNothingMuch) {
  Scene s = furnished_room();
  test::add_mesh(s, scene::make_quad({-120, -1.31f, 120}, {240, 0, 0}, {0, 0, -240}), 1);
  EXPECT_TRUE(is_within(eye_of(view_of(s)), half));
}

/// A closed hall with a strip of light along its ceiling.
Scene hall(const vec3& reach) {
  Scene s;
  s.materials = {test::matte(vec3(0.8f)), test::matte(vec3(0))};
  s.materials[1].emission = vec3(5);
  test::add_mesh(s, scene::flipped(scene::make_box(-reach, reach)), 0);
  const vec3 strip = reach * vec3(0.98f, 0.96f, 0.4f);
  test::add_mesh(s, scene::make_quad({-strip.x, strip.y, -strip.z}, {2 * strip.x, 0, 0}, {0, 0, 2 * strip.z}),
                 1);
  return s;
}

TEST(DefaultView, StandsInATunnelToo) {
  const vec3 long_half(435, 2.5f, 3);
  const CameraPose pose = view_of(hall(long_half));
  EXPECT_TRUE(is_within(eye_of(pose), long_half));
  EXPECT_NEAR(eye_of(pose).y, -2.5f + 1.6f, 0.01f);
  EXPECT_GT(std::abs(pose.world[2].x), 0.8f) << "along it";
}

TEST(DefaultView, KeepsAFiftiethOfWhatItSeesAwayFromWalls) {
  // One sees six times the height far, 30 m: 0.6 m from either wall, in a fifth of the places at least.
  for (const float width : {1.7f, 2.5f, 4.0f}) {
    const vec3 eye = eye_of(view_of(hall({20, 2.5f, 0.5f * width})));
    EXPECT_LT(std::abs(eye.z), 0.5f * width - 0.58f) << width;
    EXPECT_LT(std::abs(eye.x), 20 - 0.58f) << width;
  }
  EXPECT_GT(eye_of(view_of(hall({20, 2.5f, 0.65f}))).z, 1) << "there is no such place";
}

TEST(DefaultView, StandsAsHighAsAPersonInALargeHallToo) {
  for (const float size : {30.0f, 190.0f})
    EXPECT_NEAR(eye_of(view_of(hall(size * half))).y, size * -1.3f + 1.6f, 0.1f);
  // Of 2.6 times 195 = 507 m nobody knows the unit: six tenths of the height.
  EXPECT_NEAR(eye_of(view_of(hall(195.0f * half))).y, 195 * (-1.3f + 1.56f), 0.2f);
}

TEST(DefaultView, OfWhatHangsOnNoNodeIsTheOneOfANodeAtTheOrigin) {
  const Scene room = furnished_room();
  Scene loose = room;
  for (scene::Instance& instance : loose.instances) instance.node = -1;
  EXPECT_EQ(default_view(loose, test::TriangleSource(room)).world, view_of(room).world);
}

TEST(DefaultView, IsTheSameForTheSameScene) {
  EXPECT_EQ(view_of(furnished_room()).world, view_of(furnished_room()).world);
}

TEST(DefaultView, WhatHasNoTrianglesIsLookedAtFromTheOrigin) {
  EXPECT_EQ(view_of(Scene()).world, mat4(1));
}

}  // namespace
}  // namespace ssphh::study
