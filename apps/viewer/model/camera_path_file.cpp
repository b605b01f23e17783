#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ssphh/core/file.h>

#include "camera_path.h"

namespace ssphh::viewer {
namespace {

using Json = nlohmann::ordered_json;

/// Members of one key, with the place in every message.
class KeyReader {
 public:
  KeyReader(const Json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object.is_object()) throw Error(where_, "is not an object");
    static const char* const known[] = {"name",    "time",         "scene_time", "position",    "rotation",
                                        "look_at", "yfov_degrees", "yheight",    "focus_metres"};
    for (const auto& [name, value] : object.items()) {
      if (std::find(std::begin(known), std::end(known), name) == std::end(known))
        throw Error(where_, fmt::format("unknown member \"{}\"", name),
                    "schemas/camera-path.schema.json lists them");
    }
  }

  bool has(const char* name) const { return object_.contains(name); }

  std::string text(const char* name) const {
    if (!has(name)) return {};
    if (!object_[name].is_string()) throw Error(where_, fmt::format("\"{}\" is not a text", name));
    return object_[name].get<std::string>();
  }

  float number(const char* name) const { return to_float(object_.at(name), name); }

  template <int N>
  std::array<float, N> numbers(const char* name) const {
    if (!has(name)) throw Error(where_, fmt::format("has no \"{}\"", name));
    const Json& array = object_[name];
    if (!array.is_array() || array.size() != N)
      throw Error(where_, fmt::format("\"{}\" is not an array of {} numbers", name, N));
    std::array<float, N> out{};
    for (std::size_t i = 0; i < N; ++i) out[i] = to_float(array[i], name);
    return out;
  }

 private:
  float to_float(const Json& value, const char* name) const {
    if (!value.is_number()) throw Error(where_, fmt::format("\"{}\" is not a number", name));
    const double number = value.get<double>();
    if (!(std::abs(number) < 1e30)) throw Error(where_, fmt::format("\"{}\" is out of range", name));
    return static_cast<float>(number);
  }

  const Json& object_;
  std::string where_;
};

vec3 to_vec3(const std::array<float, 3>& v) {
  return {v[0], v[1], v[2]};
}

CameraKey read_key(const Json& object, const std::string& where) {
  const KeyReader in(object, where);
  CameraKey key;
  key.name = in.text("name");
  if (in.has("time")) key.time = in.number("time");
  if (in.has("scene_time")) key.scene_time = in.number("scene_time");
  const vec3 position = to_vec3(in.numbers<3>("position"));
  if (in.has("look_at") == in.has("rotation"))
    throw Error(where, "needs either \"look_at\" or \"rotation\"", "give one of the two");
  if (in.has("look_at")) {
    const vec3 target = to_vec3(in.numbers<3>("look_at"));
    if (target == position) throw Error(where, "\"look_at\" is the camera's own position");
    key.view = look_at(position, target, key.view.yfov);
  } else {
    const std::array<float, 4> r = in.numbers<4>("rotation");
    const quat q(r[3], r[0], r[1], r[2]);
    if (!(std::abs(glm::length(q) - 1) < 1e-2f))
      throw Error(where, "\"rotation\" is not a unit quaternion x, y, z, w");
    key.view.eye = position;
    // A unit quaternion that was written comes back to the bit.
    key.view.orientation = std::abs(glm::length(q) - 1) < 1e-6f ? q : glm::normalize(q);
  }
  if (in.has("focus_metres")) key.view.focus = in.number("focus_metres");
  if (in.has("yfov_degrees")) key.view.yfov = glm::radians(in.number("yfov_degrees"));
  if (in.has("yheight")) key.view.orthographic = true, key.view.yheight = in.number("yheight");
  if (!(key.view.yfov > 0 && key.view.yfov < pi)) throw Error(where, "\"yfov_degrees\" is not within 0..180");
  if (!(key.view.focus > 0 && key.view.yheight > 0))
    throw Error(where, "\"focus_metres\" and \"yheight\" must be over 0");
  return key;
}

Json write_key(const CameraKey& key) {
  const View& v = key.view;
  const quat& q = v.orientation;
  Json out = {{"name", key.name}, {"time", key.time}};
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
  Json keys = Json::array();
  for (const CameraKey& key : path.keys) keys.push_back(write_key(key));
  return Json{{"keys", std::move(keys)}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

CameraPath camera_path_from_json(std::string_view text, const std::string& where) {
  Json root;
  try {
    root = Json::parse(text);
  } catch (const Json::parse_error& e) {
    throw Error(where, fmt::format("is not JSON: byte {}", e.byte));
  }
  if (!root.is_object() || !root.contains("keys") || !root["keys"].is_array())
    throw Error(where, "has no array \"keys\"", "it is not a camera path (schemas/camera-path.schema.json)");
  CameraPath path;
  for (const Json& object : root["keys"]) {
    const std::string place = fmt::format("{}: keys[{}]", where, path.keys.size());
    CameraKey key = read_key(object, place);
    if (!path.keys.empty()) {
      if (!object.contains("time")) key.time = path.keys.back().time + 2;
      if (!(key.time > path.keys.back().time))
        throw Error(place, "\"time\" is not after that of the key before");
    }
    path.keys.push_back(std::move(key));
  }
  if (path.empty()) throw Error(where, "has no keys");
  return path;
}

CameraPath read_camera_path(const std::filesystem::path& file) {
  return camera_path_from_json(read_text_file(file, std::uint64_t{16} << 20), file.string());
}

void write_camera_path(const std::filesystem::path& file, const CameraPath& path) {
  write_file(file, std::string_view(to_json(path)));
}

}  // namespace ssphh::viewer
