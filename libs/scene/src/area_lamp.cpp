#include <array>
#include <cmath>

#include <ssphh/scene/area_lamp.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {
namespace {

constexpr int disc_corners = 34;  // of 32 triangles, as many as have a closed form

Mesh rectangle_mesh(const vec2& size) {
  return make_quad(vec3(-0.5f * size, 0), vec3(0, size.y, 0), vec3(size.x, 0, 0));
}

constexpr double corner_step = 2 * pi_d / disc_corners;

/// From the middle to the corners of a polygon that has one area with the circle.
float disc_reach(float radius) {
  return static_cast<float>(static_cast<double>(radius) * std::sqrt(corner_step / std::sin(corner_step)));
}

Mesh disc_mesh(float radius) {
  const auto reach = static_cast<double>(disc_reach(radius));
  std::array<vec3, disc_corners> corners;
  std::array<uvec3, disc_corners - 2> triangles;
  for (int i = 0; i < disc_corners; ++i)
    corners[i] = vec3(glm::dvec3(reach * std::cos(corner_step * i), -reach * std::sin(corner_step * i), 0));
  // Between the sides in turn, not from one corner: no slivers
  unsigned low = 0, high = disc_corners - 1;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (i % 2 == 0) {
      triangles[i] = {low, low + 1, high};
      ++low;
    } else {
      triangles[i] = {low, high - 1, high};
      --high;
    }
  }
  return make_polygon(corners, triangles);
}

/// The rotation that takes one unit vector to another the shortest way.
mat3 shortest_turn(const vec3& from, const vec3& to) {
  const vec3 axis = glm::cross(from, to);
  const float cosine = glm::dot(from, to);
  if (cosine < -0.9999f) {  // half a turn about whatever is across
    const vec3 across = Frame::around(from).x;
    return 2.0f * glm::outerProduct(across, across) - mat3(1);
  }
  const mat3 cross(vec3(0, axis.z, -axis.y), vec3(-axis.z, 0, axis.x), vec3(axis.y, -axis.x, 0));
  return mat3(1) + cross + cross * cross / (1 + cosine);
}

}  // namespace

bool is_area_lamp(LightType type) {
  return type == LightType::rectangle || type == LightType::disc;
}

float lamp_area(const Light& light) {
  if (light.type == LightType::rectangle) return light.size.x * light.size.y;
  return light.type == LightType::disc ? pi * light.radius * light.radius : 0;
}

float lamp_reach(const Light& light) {
  switch (light.type) {
    case LightType::sphere:
    case LightType::sphl:
      return light.radius;
    case LightType::rectangle:
      return 0.5f * glm::length(light.size);
    case LightType::disc:
      // Of the polygon's corners
      return disc_reach(light.radius);
    case LightType::point:
    case LightType::spot:
    case LightType::directional:
      break;
  }
  return 0;
}

Mesh area_lamp_mesh(const Light& light) {
  if (!(lamp_area(light) > 0)) return {};
  return light.type == LightType::disc ? disc_mesh(light.radius) : rectangle_mesh(light.size);
}

mat4 area_lamp_pose(const mat4& world) {
  const vec3 back(world[2]);
  const float length = glm::length(back);
  const vec3 z = length > 0 ? back / length : vec3(0, 0, 1);
  const vec3 across = vec3(world[1]) - glm::dot(vec3(world[1]), z) * z;
  const float height = glm::length(across);
  const vec3 y = height > 0 ? across / height : Frame::around(z).y;
  return {vec4(glm::cross(y, z), 0), vec4(y, 0), vec4(z, 0), vec4(vec3(world[3]), 1)};
}

mat4 aimed_area_lamp(const mat4& world, const vec3& direction) {
  const mat4 pose = area_lamp_pose(world);
  const mat3 turned = shortest_turn(-vec3(pose[2]), glm::normalize(direction)) * mat3(pose);
  return area_lamp_pose({vec4(turned[0], 0), vec4(turned[1], 0), vec4(turned[2], 0), pose[3]});
}

Scene area_lamps_as_meshes(Scene scene, float time) {
  const std::vector<mat4> world = world_matrices(scene, time);
  for (const Light& light : scene.lights) {
    if (!is_area_lamp(light.type)) continue;
    Material glow;
    glow.name = light.name;
    glow.base_color = vec3(0), glow.specular = 0;
    glow.emission = light.color * light.intensity;
    Mesh mesh = area_lamp_mesh(light);
    mesh.name = light.name;
    mesh.material = static_cast<int>(scene.materials.size());
    Node node;
    node.name = light.name;
    node.matrix = area_lamp_pose(light.node < 0 ? mat4(1) : world[light.node]);
    scene.instances.push_back({static_cast<int>(scene.meshes.size()), static_cast<int>(scene.nodes.size()),
                               -1, light_group(light)});
    scene.materials.push_back(std::move(glow));
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.push_back(std::move(node));
  }
  std::erase_if(scene.lights, [](const Light& light) { return is_area_lamp(light.type); });
  return scene;
}

}  // namespace ssphh::scene
