#pragma once
/// Cube maps: six square faces in the order and orientation of ssphh::CubeFace.

#include <array>

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

}  // namespace ssphh::image
