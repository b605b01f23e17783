#include "gallery_hall.h"

namespace ssphh::scene {
namespace {

constexpr float half_width = 5, hall_height = 4, half_depth = 4;

}  // namespace

void add_hall(Builder& b, const HallMaterials& m) {
  const float x = half_width, y = hall_height, z = half_depth;
  b.add("floor", make_quad({-x, 0, z}, {2 * x, 0, 0}, {0, 0, -2 * z}), m.floor);
  b.add("ceiling", make_quad({-x, y, -z}, {2 * x, 0, 0}, {0, 0, 2 * z}), m.ceiling);
  b.add("back wall", make_quad({-x, 0, -z}, {2 * x, 0, 0}, {0, y, 0}), m.back);
  b.add("front wall", make_quad({x, 0, z}, {-2 * x, 0, 0}, {0, y, 0}), m.front);
  b.add("left wall", make_quad({-x, 0, z}, {0, 0, -2 * z}, {0, y, 0}), m.left);
  b.add("right wall", make_quad({x, 0, -z}, {0, 0, 2 * z}, {0, y, 0}), m.right);
}

void add_cove(Builder& b, const std::string& name, float side, int material, const vec3& radiance,
              const std::string& group) {
  const float wall = side * half_width, edge = side * (half_width - 0.45f);
  b.add(name + " ledge", make_box({glm::min(wall, edge), 2.7f, -3.95f}, {glm::max(wall, edge), 2.78f, 3.95f}),
        material);
  // A rim keeps the strip out of sight and its light off the floor.
  const float inner = side * (half_width - 0.43f);
  b.add(name + " rim",
        make_box({glm::min(edge, inner), 2.78f, -3.95f}, {glm::max(edge, inner), 2.88f, 3.95f}), material);
  const float left = glm::min(side * (half_width - 0.1f), side * (half_width - 0.3f));
  b.add_emitter(name, group, make_quad({left, 2.79f, 3.5f}, {0.2f, 0, 0}, {0, 0, -7}), radiance);
}

void add_partition(Builder& b, const std::string& name, float x0, float x1, float z, float height_above_floor,
                   int material) {
  b.add(name, make_box({x0, 0, z - 0.1f}, {x1, height_above_floor, z}), material);
}

float add_plinth(Builder& b, const std::string& name, float x, float z, float side, float top, int material) {
  const float h = side / 2;
  b.add(name, make_box({x - h, 0, z - h}, {x + h, top, z + h}), material);
  return top;
}

}  // namespace ssphh::scene
