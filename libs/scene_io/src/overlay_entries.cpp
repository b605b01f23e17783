#include "overlay_entries.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace ssphh::scene_io {
namespace {

// Rotation whose −z is `direction`, y as near to `up` as it can be.
quat looking_along(const json::Cursor& place, const vec3& direction, const vec3& up) {
  const float length = glm::length(direction);
  if (!(length > 0) || !std::isfinite(length)) place.fail("gives no direction to look in");
  const vec3 z = -direction / length;
  vec3 x = glm::cross(up, z);
  if (glm::length(x) < 1e-4f * glm::length(up))
    x = glm::cross(std::abs(z.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 0, 1), z);
  x = glm::normalize(x);
  return glm::normalize(glm::quat_cast(mat3(x, glm::cross(z, x), z)));
}

}  // namespace

float degrees(const json::Cursor& object, const char* key, float low, float high, float fallback) {
  const auto member = object.find(key);
  return glm::radians(member ? member->number(low, high) : fallback);
}

float positive(const json::Cursor& member) {
  const float value = member.number();
  if (!(value > 0)) member.fail("must be greater than 0");
  return value;
}

int add_overlay_node(scene::Scene& scene, const json::Cursor& entry, const std::string& name) {
  scene::Node node;
  node.name = name;
  if (const auto position = entry.find("position")) node.local.translation = position->vector3();
  const auto up_member = entry.find("up");
  const vec3 up = up_member ? up_member->vector3() : vec3(0, 1, 0);
  if (!(glm::length(up) > 0)) up_member->fail("must not be zero");
  const auto look_at = entry.find("look_at"), direction = entry.find("direction");
  if (look_at && direction) entry.fail("has both \"look_at\" and \"direction\"");
  if (look_at) node.local.rotation = looking_along(*look_at, look_at->vector3() - node.local.translation, up);
  if (direction) node.local.rotation = looking_along(*direction, direction->vector3(), up);
  if (const auto parent = entry.find("node")) {
    const auto found =
        std::ranges::find_if(scene.nodes, [&](const scene::Node& n) { return n.name == parent->text(); });
    if (found == scene.nodes.end()) parent->fail(fmt::format("the scene has no node \"{}\"", parent->text()));
    node.parent = static_cast<int>(found - scene.nodes.begin());
    node.movable = found->movable;
  }
  scene.nodes.push_back(std::move(node));
  return static_cast<int>(scene.nodes.size()) - 1;
}

}  // namespace ssphh::scene_io
