#include "model/camera_path.h"

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "error_message.h"
#include "expect_near.h"
#include "json_schema.h"
#include "places.h"
#include "temp_dir.h"

namespace ssphh::viewer {
namespace {

using test::expect_near;
using testing::HasSubstr;

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

TEST(CameraPath, OfTwoKeysIsALine) {
  CameraPath path = parabola({1, 3});
  path.keys[0].view.eye = {0, 0, 0}, path.keys[1].view.eye = {4, 8, -2};
  expect_near(at(path, 1.5f).view.eye, {1, 2, -0.5f}, 1e-6f);
  EXPECT_EQ(path.duration(), 2);
  EXPECT_EQ(CameraPath{}.duration(), 0);
}

TEST(CameraPath, AnglesAndDistancesGoLinearly) {
  CameraPath path = parabola({0, 2, 4});
  path.keys[1].view.yfov = 0.5f, path.keys[1].view.focus = 2, path.keys[1].view.yheight = 1;
  path.keys[2].view.yfov = 0.9f, path.keys[2].view.focus = 10, path.keys[2].view.yheight = 3;
  const CameraKey key = at(path, 2.5f);
  EXPECT_EQ(key.time, 2.5f);
  EXPECT_NEAR(key.view.yfov, 0.6f, 1e-6f);
  EXPECT_NEAR(key.view.focus, 4, 1e-6f);
  EXPECT_NEAR(key.view.yheight, 1.5f, 1e-6f);
}

TEST(CameraPath, KeysAreAppendedTwoSecondsApart) {
  CameraPath path;
  CameraKey key;
  key.time = 17;
  append(path, key), append(path, key), append(path, key, 0.5f);
  EXPECT_EQ(path.keys[0].time, 0);
  EXPECT_EQ(path.keys[1].time, 2);
  EXPECT_EQ(path.keys[2].time, 2.5f);
}

TEST(CameraPathFile, ComesBackToTheBitAndFitsItsSchema) {
  CameraPath path = parabola({0, 0.1f, 2.7f});
  path.keys[0].name = "door \"A\"";
  path.keys[1].scene_time = 0.3f;
  path.keys[2].view.orthographic = true, path.keys[2].view.yheight = 3.5f;
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
    EXPECT_EQ(back.keys[i].time, path.keys[i].time);
    EXPECT_EQ(back.keys[i].view.focus, path.keys[i].view.focus);
    EXPECT_EQ(back.keys[i].view.orthographic, path.keys[i].view.orthographic);
    EXPECT_EQ(back.keys[i].view.yheight, path.keys[i].view.yheight);
    EXPECT_EQ(back.keys[i].scene_time, path.keys[i].scene_time);
    EXPECT_EQ(back.keys[i].name, path.keys[i].name);
  }
  EXPECT_THAT(test::schema_errors(test::source_dir() / "schemas/camera-path.schema.json",
                                  read_text_file(dir / "path.json")),
              testing::IsEmpty());
}

std::string message(const std::string& text) {
  return test::message_of([&] { camera_path_from_json(text, "p.json"); });
}
/// Of a key with these members beside a place and a target.
std::string message_of_key(const std::string& members) {
  return message(R"({"keys": [{"position": [1, 2, 3], "look_at": [1, 2, 0], )" + members + "}]}");
}

TEST(CameraPathFile, WhatIsLeftOutHasItsDefault) {
  const CameraPath path = camera_path_from_json(
      R"({"keys": [{"position": [1, 2, 3], "look_at": [1, 2, 0]},
                   {"position": [0, 0, 0], "rotation": [0, 0, 0, 1]},
                   {"position": [0, 0, 0], "look_at": [0, 1, 0], "time": 7, "yfov_degrees": 30},
                   {"position": [0, 0, 0], "look_at": [0, 1, 0], "yheight": 4, "focus_metres": 6}]})",
      "p.json");
  const std::vector<CameraKey>& keys = path.keys;
  EXPECT_EQ(keys[0].time, 0);
  EXPECT_EQ(keys[1].time, 2) << "two seconds after the one before";
  EXPECT_EQ(keys[2].time, 7);
  EXPECT_EQ(keys[3].time, 9);
  EXPECT_EQ(keys[0].name, "");
  EXPECT_FALSE(keys[0].scene_time);
  EXPECT_EQ(keys[0].view, look_at({1, 2, 3}, {1, 2, 0}, View{}.yfov));
  EXPECT_EQ(keys[1].view, View{});
  EXPECT_NEAR(keys[2].view.yfov, pi / 6, 1e-6f);
  EXPECT_TRUE(keys[3].view.orthographic);
  EXPECT_EQ(keys[3].view.yheight, 4);
  EXPECT_EQ(keys[3].view.focus, 6);
}

TEST(CameraPathFile, ARotationIsAUnitQuaternionToAHundredth) {
  const auto rotation = [](const char* numbers) {
    return R"({"keys": [{"position": [0, 0, 0], "rotation": [)" + std::string(numbers) + "]}]}";
  };
  const CameraPath path = camera_path_from_json(rotation("0, 1.009, 0, 0"), "p.json");
  EXPECT_EQ(path.keys[0].view.orientation, quat(0, 0, 1, 0)) << "made one";
  for (const char* bad : {"0, 1.011, 0, 0", "0, 0, 0, 0.989"})
    EXPECT_THAT(message(rotation(bad)), HasSubstr("not a unit quaternion")) << bad;
}

TEST(CameraPathFile, NumbersHaveLimits) {
  EXPECT_EQ(message_of_key(R"("yfov_degrees": 179.9)"), "no error");
  for (const char* bad : {"0", "-1", "180"})
    EXPECT_THAT(message_of_key(R"("yfov_degrees": )" + std::string(bad)),
                HasSubstr("p.json: keys[0].yfov_degrees: is not within 0..180"));
  for (const char* member : {"focus_metres", "yheight"}) {
    EXPECT_EQ(message_of_key("\"" + std::string(member) + "\": 0.001"), "no error");
    for (const char* bad : {"0", "-1"})
      EXPECT_THAT(message_of_key("\"" + std::string(member) + "\": " + bad), HasSubstr("must be over 0"));
  }
  EXPECT_EQ(message_of_key(R"("time": -3e38)"), "no error");
  EXPECT_THAT(message_of_key(R"("time": -4e38)"), HasSubstr("keys[0].time: -4e+38 is too large"));
}

TEST(CameraPathFile, NamesWhatIsWrongAndWhere) {
  EXPECT_THAT(message("{"), HasSubstr("p.json: is not valid JSON"));
  EXPECT_THAT(message_of_key(R"("name": 7)"), HasSubstr("keys[0].name: must be a string"));
  EXPECT_THAT(message_of_key(R"("time": "1")"), HasSubstr("keys[0].time: must be a number"));
  EXPECT_THAT(message_of_key(R"("rotation": [0, 0, 0, 1])"), HasSubstr("give one of the two"));
  EXPECT_THAT(message(R"({"keys": [{"look_at": [0,0,0]}]})"), HasSubstr("\"position\" is missing"));
  EXPECT_THAT(message(R"({"keys": [{"position": [1,2,3], "look_at": [1,2,3]}]})"),
              HasSubstr("the camera's own position"));
  EXPECT_THAT(message(R"({"keys": {}})"), HasSubstr("no array \"keys\""));
  EXPECT_THAT(message("[]"), HasSubstr("no array \"keys\""));
  EXPECT_THAT(message(R"({"keys": []})"), HasSubstr("has no keys"));
  EXPECT_THAT(message(R"({"keys": [7]})"), HasSubstr("keys[0]: must be an object"));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0,0], "look": 1}]})"),
              HasSubstr("unknown member \"look\""));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0,0]}]})"), HasSubstr("look_at"));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0], "look_at": [1,0,0]}]})"),
              HasSubstr("keys[0].position: must have 3 elements"));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0,1e39], "look_at": [1,0,0]}]})"),
              HasSubstr("keys[0].position[2]: 1e+39 is too large"));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0,0], "rotation": [1,1,0,0]}]})"),
              HasSubstr("unit quaternion"));
  EXPECT_THAT(message(R"({"keys": [{"position": [0,0,0], "look_at": [1,0,0], "time": 1},
                                   {"position": [0,0,0], "look_at": [1,0,0], "time": 1}]})"),
              HasSubstr("keys[1]: \"time\" is not after"));
}

}  // namespace
}  // namespace ssphh::viewer
