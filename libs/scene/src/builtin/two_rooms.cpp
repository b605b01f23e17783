#include <vector>

#include "builder.h"
#include "scenes.h"

namespace ssphh::scene {
namespace {

// Room A is x −4.075…−0.075, room B x 0.075…4.075; both y 0…3, z −2…2. The wall between them is 0.15 m thick,
// with a doorway z −0.45…0.45, y 0…2.1.
constexpr float wall = 0.15f, half_wall = wall / 2, far = 4 + half_wall;
constexpr float height = 3, depth = 2;
constexpr float door_half = 0.45f, door_height = 2.1f;

using Corners = std::vector<vec3>;

/// Inner skin of the room on the side sign·x > 0, without the doorway's reveal. Every piece shares whole
/// edges with its neighbours.
void add_room(Builder& b, const std::string& name, float sign, int walls, int floor, int ceiling,
              int end_wall) {
  const float inner = sign * half_wall, outer = sign * far;
  // Written for +x; seen from the other side the pieces must turn.
  const auto piece = [&](const std::string& part, const Corners& corners, std::vector<uvec3> triangles,
                         int material) {
    if (sign < 0) {
      for (uvec3& t : triangles) std::swap(t.y, t.z);
    }
    b.add(name + " " + part, make_polygon(corners, triangles), material);
  };
  const std::vector<uvec3> quad{{0, 1, 2}, {0, 2, 3}};
  piece("floor",
        {{inner, 0, depth},
         {outer, 0, depth},
         {outer, 0, -depth},
         {inner, 0, -depth},
         {inner, 0, -door_half},
         {inner, 0, door_half}},
        {{0, 1, 5}, {5, 1, 2}, {5, 2, 4}, {4, 2, 3}}, floor);
  piece("ceiling",
        {{inner, height, -depth}, {outer, height, -depth}, {outer, height, depth}, {inner, height, depth}},
        quad, ceiling);
  piece("end wall", {{outer, 0, depth}, {outer, height, depth}, {outer, height, -depth}, {outer, 0, -depth}},
        quad, end_wall);
  piece("back wall",
        {{inner, 0, -depth}, {outer, 0, -depth}, {outer, height, -depth}, {inner, height, -depth}}, quad,
        walls);
  piece("front wall", {{outer, 0, depth}, {inner, 0, depth}, {inner, height, depth}, {outer, height, depth}},
        quad, walls);
  piece("door wall",
        {{inner, 0, -depth},
         {inner, height, -depth},
         {inner, height, depth},
         {inner, 0, depth},
         {inner, 0, door_half},
         {inner, door_height, door_half},
         {inner, door_height, -door_half},
         {inner, 0, -door_half}},
        {{0, 1, 6}, {0, 6, 7}, {1, 2, 5}, {1, 5, 6}, {2, 3, 4}, {2, 4, 5}}, walls);
}

/// Floor, lintel and sides of the doorway.
void add_reveal(Builder& b, int walls, int floor) {
  const float x = half_wall, z = door_half, y = door_height;
  b.add("doorway floor", make_quad({-x, 0, z}, {2 * x, 0, 0}, {0, 0, -2 * z}), floor);
  b.add("doorway lintel", make_quad({-x, y, -z}, {2 * x, 0, 0}, {0, 0, 2 * z}), walls);
  b.add("doorway north", make_quad({-x, 0, -z}, {2 * x, 0, 0}, {0, y, 0}), walls);
  b.add("doorway south", make_quad({x, 0, z}, {-2 * x, 0, 0}, {0, y, 0}), walls);
}

/// The leaf lies on room B's side of the wall and overlaps the opening by 5 cm at the sides and above, so
/// that nothing passes when it is shut. It turns about its edge away from the wall, which keeps it off the
/// wall on the whole way.
void add_door(Builder& b, int material) {
  const float thickness = 0.04f, overlap = 0.05f, width = 2 * (door_half + overlap);
  const int hinge = b.node("door", at({half_wall + thickness, 0, -door_half - overlap}));
  b.add_at(hinge, "door leaf", make_box({-thickness, 0, 0}, {0, door_height + overlap, width}), material);
  const quat open = glm::angleAxis(glm::radians(100.0f), vec3(0, 1, 0));
  Animation animation;
  animation.name = "open";
  animation.channels.push_back({.node = hinge,
                                .path = AnimationPath::rotation,
                                .interpolation = Interpolation::linear,
                                .times = {0, 1},
                                .values = {{0, 0, 0, 1}, {open.x, open.y, open.z, open.w}}});
  b.scene().animations.push_back(std::move(animation));
}

}  // namespace

Scene make_two_rooms() {
  Builder b("two-rooms");
  const int walls = b.matte("wall", vec3(0.7f));
  const int floor = b.matte("floor", {0.7f, 0.62f, 0.5f});
  const int ceiling = b.matte("ceiling", vec3(0.8f));
  const int end_a = b.matte("end wall A", {0.7f, 0.45f, 0.35f});
  const int end_b = b.matte("end wall B", {0.4f, 0.5f, 0.7f});
  const int wood = b.matte("door", {0.5f, 0.35f, 0.22f});

  add_room(b, "room A", -1, walls, floor, ceiling, end_a);
  add_room(b, "room B", 1, walls, floor, ceiling, end_b);
  add_reveal(b, walls, floor);
  b.add("outside", make_box({-far - wall, -wall, -depth - wall}, {far + wall, height + wall, depth + wall}),
        walls);
  add_door(b, wood);
  b.point_light("lamp", {-2.4f, 2.5f, 0.5f}, {1, 0.9f, 0.75f}, 4);

  b.camera("room-a", {-3.8f, 1.6f, 0.9f}, {0, 1.2f, -0.1f}, 50);
  b.camera("room-b", {3.8f, 1.6f, -1.3f}, {0, 1.2f, 0.3f}, 50);
  b.sphl("A west", {-3.1f, 1.5f, -0.9f});
  b.sphl("A east", {-1.2f, 1.4f, 0.9f});
  b.sphl("doorway", {-0.05f, 1.2f, 0});
  b.sphl("B west", {1.3f, 1.4f, 0.9f});
  b.sphl("B middle", {1.6f, 1.5f, -0.9f});
  b.sphl("B east", {3.1f, 1.5f, 0.5f});
  return b.finish();
}

}  // namespace ssphh::scene
