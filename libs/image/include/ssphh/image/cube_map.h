#pragma once
/// Cube maps: six square faces in the order and orientation of ssphh::CubeFace.

#include <array>
#include <span>

#include <ssphh/core/sphere.h>
#include <ssphh/image/image.h>

namespace ssphh::image {

struct CubeMap {
  int size = 0;
  std::array<Image, 6> faces;

  CubeMap() = default;
  explicit CubeMap(int size_, int channels = 3) : size(size_) {
    for (Image& face : faces) face = Image(size_, size_, channels);
  }
};

/// Colour of texel (x, y) of a face, which may lie up to one texel outside: then it is the texel of the
/// neighbouring face there, and beyond a corner, where there is none, the mean of the three texels that meet.
vec3 cube_texel(const CubeMap& cube, int face, int x, int y);

/// The cube map of six pictures by cameras of 90 degrees within it, in the order of its faces and with their
/// down: each is mirrored, for faces are seen from outside. Throws Error where they are not square, of one
/// size and of at least three channels.
CubeMap cube_of_views(std::span<const Image> pictures);

/// Bilinear without seams at the edges; `direction` of any length but zero.
vec3 sample_cube(const CubeMap& cube, const vec3& direction);

}  // namespace ssphh::image
