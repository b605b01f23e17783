#pragma once
/// What glossy surfaces mirror of the environment: its radiance seen through the specular lobe, by direction
/// and roughness (the split-sum approximation of Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013
/// course).

#include <array>

#include <ssphh/scene/scene.h>

#include "tile_atlas.h"

namespace ssphh::realtime {

inline constexpr std::array<float, 8> environment_roughness = {0, 0.1f, 0.2f, 0.3f, 0.45f, 0.6f, 0.8f, 1};

/// A tile for each of environment_roughness, in the directions of the environment's image before its
/// rotation: the mean of the radiance by the GGX lobe of that roughness seen along its normal, weighted by
/// the cosine. Radiance above what a half holds is cut.
TileAtlas environment_tiles(const scene::Environment& environment);

}  // namespace ssphh::realtime
