#include <algorithm>
#include <limits>

#include <ssphh/image/cube_map.h>

#include "bilinear.h"

namespace ssphh::image {
namespace {

vec3 neighbour_texel(const CubeMap& cube, int face, int x, int y) {
  // The centre of the texel beyond the edge, seen from the cube's centre, falls into the right texel of its
  // neighbour.
  const float scale = 1.0f / static_cast<float>(cube.size);
  const vec3 d = cube_direction_unnormalized(
      {face, (static_cast<float>(x) + 0.5f) * scale, (static_cast<float>(y) + 0.5f) * scale});
  const CubePoint p = cube_point(d);
  const auto texel = [&](float s) {
    return std::clamp(static_cast<int>(s * static_cast<float>(cube.size)), 0, cube.size - 1);
  };
  return cube.faces[p.face].rgb(texel(p.s), texel(p.t));
}

}  // namespace

vec3 cube_texel(const CubeMap& cube, int face, int x, int y) {
  require(cube.size > 0 && face >= 0 && face < 6, "cube map", "there is no such face");
  const int last = cube.size - 1;
  const int cx = std::clamp(x, 0, last), cy = std::clamp(y, 0, last);
  const bool out_x = cx != x, out_y = cy != y;
  if (!out_x && !out_y) return cube.faces[face].rgb(x, y);
  if (out_x != out_y) return neighbour_texel(cube, face, x, y);
  return (cube.faces[face].rgb(cx, cy) + neighbour_texel(cube, face, x, cy) +
          neighbour_texel(cube, face, cx, y)) /
         3.0f;
}

CubeMap cube_of_views(std::span<const Image> pictures) {
  require(pictures.size() == 6, "cube map", "it has six faces");
  CubeMap cube(pictures[0].width);
  for (std::size_t f = 0; f < 6; ++f) {
    const Image& picture = pictures[f];
    require(picture.width == cube.size && picture.height == cube.size && cube.size > 0, "cube map",
            "its pictures must be square and of one size");
    require(picture.channels >= 3, "cube map", "its pictures are grey");
    for (int y = 0; y < cube.size; ++y)
      for (int x = 0; x < cube.size; ++x) cube.faces[f].set_rgb(x, y, picture.rgb(cube.size - 1 - x, y));
  }
  return cube;
}

vec3 sample_cube(const CubeMap& cube, const vec3& direction) {
  require(cube.size > 0, "cube map", "it is empty");
  if (!is_finite(direction)) return vec3(std::numeric_limits<float>::quiet_NaN());
  const CubePoint p = cube_point(direction);
  const auto size = static_cast<float>(cube.size);
  return bilinear(BilinearTap(p.s * size, p.t * size),
                  [&](int x, int y) { return cube_texel(cube, p.face, x, y); });
}

}  // namespace ssphh::image
