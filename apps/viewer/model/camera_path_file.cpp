#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/json_cursor.h>

#include "camera_path.h"

namespace ssphh::viewer {
namespace {

CameraKey read_key(const json::Cursor& in) {
  in.members({"position"}, {"name", "time", "scene_time", "rotation", "look_at", "yfov_degrees", "yheight",
                            "focus_metres"});
  CameraKey key;
  key.name = in.text_or("name");
  key.time = in.number_or("time", key.time);
  if (in.has("scene_time")) key.scene_time = in["scene_time"].number();
  const vec3 position = in["position"].vector3();
  if (in.has("look_at") == in.has("rotation"))
    in.fail("needs either \"look_at\" or \"rotation\"", "give one of the two");
  if (in.has("look_at")) {
    const vec3 target = in["look_at"].vector3();
    if (target == position) in["look_at"].fail("is the camera's own position");
    key.view = look_at(position, target, key.view.yfov);
  } else {
    const vec4 r = in["rotation"].vector4();
    const quat q(r.w, r.x, r.y, r.z);
    if (!(std::abs(glm::length(q) - 1) < 1e-2f)) in["rotation"].fail("is not a unit quaternion x, y, z, w");
    key.view.eye = position;
    // A unit quaternion that was written comes back to the bit.
    key.view.orientation = std::abs(glm::length(q) - 1) < 1e-6f ? q : glm::normalize(q);
  }
  if (in.has("focus_metres")) key.view.focus = in["focus_metres"].number();
  if (in.has("yfov_degrees")) key.view.yfov = glm::radians(in["yfov_degrees"].number());
  if (in.has("yheight")) key.view.orthographic = true, key.view.yheight = in["yheight"].number();
  if (!(key.view.yfov > 0 && key.view.yfov < pi)) in["yfov_degrees"].fail("is not within 0..180");
  if (!(key.view.focus > 0)) in["focus_metres"].fail("must be over 0");
  if (!(key.view.yheight > 0)) in["yheight"].fail("must be over 0");
  return key;
}

json::Value write_key(const CameraKey& key) {
  const View& v = key.view;
  const quat& q = v.orientation;
  json::Value out = {{"name", key.name}, {"time", key.time}};
  if (key.scene_time) out["scene_time"] = *key.scene_time;
  out["position"] = {v.eye.x, v.eye.y, v.eye.z};
  out["rotation"] = {q.x, q.y, q.z, q.w};
  if (v.orthographic) {
    out["yheight"] = v.yheight;
  } else {
    out["yfov_degrees"] = glm::degrees(v.yfov);
  }
  out["focus_metres"] = v.focus;
  return out;
}

}  // namespace

std::string to_json(const CameraPath& path) {
  json::Value keys = json::Value::array();
  for (const CameraKey& key : path.keys) keys.push_back(write_key(key));
  return json::print({{"keys", std::move(keys)}}, 2) + "\n";
}

CameraPath camera_path_from_json(std::string_view text, const std::string& where) {
  const json::Value document = json::parse(text, where);
  const json::Cursor root(document, where);
  if (!root.is_object() || !root.has("keys") || !root["keys"].is_array())
    root.fail("has no array \"keys\"", "it is not a camera path (schemas/camera-path.schema.json)");
  const json::Cursor keys = root["keys"];
  CameraPath path;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    CameraKey key = read_key(keys[i]);
    if (!path.keys.empty()) {
      if (!keys[i].has("time")) key.time = path.keys.back().time + 2;
      if (!(key.time > path.keys.back().time)) keys[i].fail("\"time\" is not after that of the key before");
    }
    path.keys.push_back(std::move(key));
  }
  if (path.empty()) root.fail("has no keys");
  return path;
}

CameraPath read_camera_path(const std::filesystem::path& file) {
  return camera_path_from_json(read_text_file(file, std::uint64_t{16} << 20), file.string());
}

void write_camera_path(const std::filesystem::path& file, const CameraPath& path) {
  write_file(file, std::string_view(to_json(path)));
}

}  // namespace ssphh::viewer
