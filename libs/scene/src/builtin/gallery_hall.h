#pragma once
/// The hall that the three galleries share, and its hidden lamps.

#include "builder.h"

namespace ssphh::scene {

/// Material indices of a hall.
struct HallMaterials {
  int floor, ceiling, left, right, front, back;
};

/// Closed hall x −5…5, y 0…4, z −4…4. The camera stands near z = 4 and looks toward −z.
void add_hall(Builder& b, const HallMaterials& materials);

/// Ledge along the left (side = −1) or right (side = 1) wall at y = 2.7 with an upward area light of 1.4 m²
/// on it, which the camera sees from below only.
void add_cove(Builder& b, const std::string& name, float side, int material, const vec3& radiance,
              const std::string& group);

/// Free-standing wall of 0.1 m parallel to x, front side at z, x from x0 to x1.
void add_partition(Builder& b, const std::string& name, float x0, float x1, float z, float height,
                   int material);

/// Plinth of a square base on the floor; returns the height of its top.
float add_plinth(Builder& b, const std::string& name, float x, float z, float side, float height,
                 int material);

}  // namespace ssphh::scene
