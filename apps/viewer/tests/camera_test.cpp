#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "json_schema.h"
#include "model/camera_path.h"
#include "places.h"
#include "temp_dir.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

void expect_near(const vec3& a, const vec3& b, float tolerance) {
  EXPECT_LT(glm::distance(a, b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(ViewCamera, LooksAtItsTarget) {
  for (const vec3& target : {vec3(3, 0, 0), vec3(0, 5, 0), vec3(0, -5, 0), vec3(-1, 2, 4)}) {
    const View view = look_at({0.5f, 1, 0.25f}, target, 1);
    expect_near(view.center(), target, 1e-5f);
    EXPECT_NEAR(view.right().y, 0, 1e-6f) << "the horizon is level";
    EXPECT_GE(view.up().y, -1e-6f);
  }
}

TEST(ViewCamera, ASceneCameraComesBackTheSame) {
  scene::CameraPose pose;
  pose.world = mat4(2.0f);  // a scaled node
  pose.world[3] = vec4(1, 2, 3, 1);
  pose.camera.yfov = 0.7f;
  const scene::CameraPose back = pose_of(view_of(pose, 2));
  EXPECT_EQ(vec3(back.world[3]), vec3(1, 2, 3));
  expect_near(vec3(back.world[2]), {0, 0, 1}, 1e-6f);
  EXPECT_EQ(back.camera.yfov, 0.7f);
}

TEST(ViewCamera, TurnsLeftAndUpAndStopsBeforeThePole) {
  const View ahead = look_at({0, 0, 0}, {0, 0, -1}, 1);
  expect_near(turned(ahead, pi / 2, 0).forward(), {-1, 0, 0}, 1e-6f);
  expect_near(turned(ahead, 0, pi / 4).forward(), {0, std::sqrt(0.5f), -std::sqrt(0.5f)}, 1e-6f);
  EXPECT_NEAR(turned(ahead, 0, 10).forward().y, std::sin(glm::radians(89.0f)), 1e-6f);
}

TEST(ViewCamera, OrbitKeepsTheCenterAndItsDistance) {
  const View view = look_at({4, 2, 1}, {1, 1, 1}, 1);
  const View after = orbited(view, 0.7f, -0.3f);
  expect_near(after.center(), view.center(), 1e-5f);
  EXPECT_NEAR(glm::distance(after.eye, after.center()), view.focus, 1e-5f);
  EXPECT_GT(glm::distance(after.eye, view.eye), 0.5f);
  const View nearer = dollied(view, 0.5f);
  expect_near(nearer.center(), view.center(), 1e-5f);
  EXPECT_NEAR(glm::distance(nearer.eye, nearer.center()), 0.5f * view.focus, 1e-5f);
}

TEST(ViewCamera, FramedShowsAllCornersOfABox) {
  scene::Bounds box;
  box.add({-3, 0, -1}), box.add({5, 2, 1});
  for (const float aspect : {0.5f, 1.0f, 2.0f}) {
    for (const bool orthographic : {false, true}) {
      View view = look_at({0, 0, 0}, {1, -2, 3}, 0.9f);
      view.orthographic = orthographic;
      view = framed(view, box, aspect);
      for (int corner = 0; corner < 8; ++corner) {
        const vec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                     corner & 4 ? box.max.z : box.min.z);
        const vec3 seen = project(view, p, aspect);
        EXPECT_GT(seen.z, 0);
        EXPECT_TRUE(seen.x >= 0 && seen.x <= 1 && seen.y >= 0 && seen.y <= 1);
      }
    }
  }
}

TEST(ViewCamera, APixelsRayGoesThroughWhatIsProjectedThere) {
  for (const bool orthographic : {false, true}) {
    View view = look_at({1, 2, 3}, {0, 0.5f, -1}, 0.8f);
    view.orthographic = orthographic;
    const vec2 at(0.2f, 0.9f);
    const scene::RayQuery ray = pixel_ray(view, at, 1.6f);
    const vec3 seen = project(view, ray.origin + 3.0f * ray.direction, 1.6f);
    EXPECT_NEAR(seen.x, at.x, 1e-5f);
    EXPECT_NEAR(seen.y, at.y, 1e-5f);
    EXPECT_NEAR(glm::length(ray.direction), 1, 1e-6f);
  }
}

/// A camera on the parabola p(t) = a + b t + c t², keyed at uneven times.
CameraPath parabola(const std::vector<float>& times) {
  CameraPath path;
  for (const float t : times) {
    CameraKey key;
    key.time = t;
    key.view =
        look_at(vec3(1, 2, 3) + t * vec3(0.5f, -1, 2) + t * t * vec3(0.25f, 0.1f, -0.3f), {0, 0, 0}, 1);
    path.keys.push_back(key);
  }
  return path;
}

TEST(CameraPath, FollowsAParabolaExactly) {
  // Every tangent is that of a parabola through three keys, so the spline has no error on one.
  const CameraPath path = parabola({-1, 0.5f, 1, 3, 3.5f});
  for (float t = -1; t <= 3.5f; t += 0.125f) {
    const vec3 truth = vec3(1, 2, 3) + t * vec3(0.5f, -1, 2) + t * t * vec3(0.25f, 0.1f, -0.3f);
    expect_near(at(path, t).view.eye, truth, 2e-5f);
  }
}

TEST(CameraPath, PassesItsKeysAndStaysAtItsEnds) {
  CameraPath path = parabola({0, 1, 4});
  path.keys[1].view.eye = {7, 7, 7};
  for (const CameraKey& key : path.keys) EXPECT_EQ(at(path, key.time), key);
  EXPECT_EQ(at(path, -5).view, path.keys.front().view);
  EXPECT_EQ(at(path, 9).view, path.keys.back().view);
  EXPECT_FLOAT_EQ(path.duration(), 4);
}

TEST(CameraPath, IsSmoothAtItsKeys) {
  CameraPath path = parabola({0, 1, 4, 5});
  path.keys[1].view.eye = {7, 7, 7}, path.keys[2].view.eye = {0, 3, 1};
  const float h = 1e-2f;
  for (const float t : {1.0f, 4.0f}) {
    const vec3 before = (at(path, t).view.eye - at(path, t - h).view.eye) / h;
    const vec3 after = (at(path, t + h).view.eye - at(path, t).view.eye) / h;
    // Velocity is continuous; what differs is the acceleration over h.
    EXPECT_LT(glm::distance(before, after), 0.05f * glm::length(before) + 0.5f);
  }
}

TEST(CameraPath, TurnsTheShortWayAtConstantSpeed) {
  CameraPath path;
  append(path, {"a", 0, {}, look_at({0, 0, 0}, {0, 0, -1}, 1)});
  append(path, {"b", 0, {}, look_at({0, 0, 0}, {1, 0, 0}, 1)});
  path.keys[1].view.orientation *= -1.0f;  // the same orientation
  const float right = glm::radians(22.5f);
  expect_near(at(path, 0.5f).view.forward(), {std::sin(right), 0, -std::cos(right)}, 1e-5f);
}

TEST(CameraPath, ScenePosesGoAlongOnlyWhereKeysHaveThem) {
  CameraPath path = parabola({0, 1, 2});
  EXPECT_FALSE(at(path, 0.5f).scene_time);
  path.keys[0].scene_time = 0, path.keys[1].scene_time = 1;
  EXPECT_FLOAT_EQ(*at(path, 0.25f).scene_time, 0.25f);
  EXPECT_FLOAT_EQ(*at(path, 1.5f).scene_time, 1);
}

TEST(CameraPathFile, ComesBackToTheBitAndFitsItsSchema) {
  CameraPath path = parabola({0, 0.1f, 2.7f});
  path.keys[0].name = "door \"A\"";
  path.keys[1].scene_time = 0.3f;
  path.keys[2].view.orthographic = true;
  for (CameraKey& key : path.keys) key.view.yfov = glm::radians(50.0f);
  path.keys[2].view.yfov = View{}.yfov;  // an orthographic view has none
  const test::TempDir dir;
  write_camera_path(dir / "path.json", path);
  const CameraPath back = read_camera_path(dir / "path.json");
  ASSERT_EQ(back.keys.size(), path.keys.size());
  for (std::size_t i = 0; i < path.keys.size(); ++i) {
    EXPECT_EQ(back.keys[i].view.eye, path.keys[i].view.eye);
    EXPECT_EQ(back.keys[i].view.orientation, path.keys[i].view.orientation);
    EXPECT_NEAR(back.keys[i].view.yfov, path.keys[i].view.yfov, 1e-6f);  // degrees in the file
    EXPECT_EQ(back.keys[i].scene_time, path.keys[i].scene_time);
    EXPECT_EQ(back.keys[i].name, path.keys[i].name);
  }
  EXPECT_THAT(test::schema_errors(test::source_dir() / "schemas/camera-path.schema.json",
                                  read_text_file(dir / "path.json")),
              testing::IsEmpty());
}

TEST(CameraPathFile, NamesWhatIsWrongAndWhere) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      camera_path_from_json(text, "p.json");
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_THAT(message("{"), HasSubstr("p.json: is not JSON"));
  EXPECT_THAT(message("[]"), HasSubstr("no array \"keys\""));
  EXPECT_THAT(message(R"({"keys": []})"), HasSubstr("has no keys"));
  EXPECT_THAT(message(R"({"keys": [7]})"), HasSubstr("keys[0]: is not an object"));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0,0], "look": 1}]})"),
              HasSubstr("unknown member \"look\""));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0,0]}]})"), HasSubstr("look_at"));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0], "look_at": [1,0,0]}]})"), HasSubstr("array of 3"));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0,1e39], "look_at": [1,0,0]}]})"),
              HasSubstr("out of range"));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0,0], "rotation": [1,1,0,0]}]})"),
              HasSubstr("unit quaternion"));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0,0], "look_at": [1,0,0], "time": 1},
                                   {"position": [0,0,0], "look_at": [1,0,0], "time": 1}]})"),
              HasSubstr("keys[1]: \"time\" is not after"));
}

}  // namespace
}  // namespace ssphh::viewer
