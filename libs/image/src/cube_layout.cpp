#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <ssphh/image/cube_layout.h>
#include <ssphh/image/sphere_map.h>

#include "sphere_resample.h"

namespace ssphh::image {
namespace {

struct Cell {
  int column, row;
  bool turned = false;  // by 180°
};

struct CubeLayout {
  int columns, rows;
  std::array<Cell, 6> cells;  // by face
};

const CubeLayout& cube_layout(Layout layout) {
  static constexpr CubeLayout strip_h{6, 1, {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}}};
  static constexpr CubeLayout strip_v{1, 6, {{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}}};
  static constexpr CubeLayout cross_h{4, 3, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}}};
  static constexpr CubeLayout cross_v{3, 4, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3, true}}}};
  if (layout == Layout::strip_h) return strip_h;
  if (layout == Layout::strip_v) return strip_v;
  if (layout == Layout::cross_h) return cross_h;
  if (layout == Layout::cross_v) return cross_v;
  refuse("layout", "there is none of that number");
}

// Copies a face between its own image and its cell of a layout.
template <class Pixel>
void for_each_cell_pixel(const Cell& cell, int size, const Pixel& pixel) {
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int column = cell.turned ? size - 1 - x : x, row = cell.turned ? size - 1 - y : y;
      pixel(x, y, cell.column * size + column, cell.row * size + row);
    }
  }
}

CubeMap split_faces(const Image& image, Layout layout) {
  const CubeLayout& cube = cube_layout(layout);
  CubeMap out(image.width / cube.columns, image.channels);
  for (std::size_t face = 0; face < 6; ++face) {
    for_each_cell_pixel(cube.cells[face], out.size, [&](int x, int y, int image_x, int image_y) {
      std::copy_n(image.at(image_x, image_y), image.channels, out.faces[face].at(x, y));
    });
  }
  return out;
}

Image join_faces(const CubeMap& cube, Layout layout) {
  const CubeLayout& cells = cube_layout(layout);
  const int channels = cube.faces[0].channels;
  Image out(cells.columns * cube.size, cells.rows * cube.size, channels);
  for (std::size_t face = 0; face < 6; ++face) {
    for_each_cell_pixel(cells.cells[face], cube.size, [&](int x, int y, int image_x, int image_y) {
      std::copy_n(cube.faces[face].at(x, y), channels, out.at(image_x, image_y));
    });
  }
  return out;
}

// Texels at a cube's corner look half as wide as those at a face's centre.
SphereField field_of(const CubeMap& cube) {
  return {[&cube](const vec3& d) { return sample_cube(cube, d); }, 1 / static_cast<float>(cube.size)};
}

SphereField field_of(const Image& image, Layout layout) {
  const auto height = static_cast<float>(image.height);
  if (layout == Layout::equirect)
    return {[&image](const vec3& d) { return sample_equirect(image, d); }, pi / height};
  return {[&image](const vec3& d) { return sample_angular(image, d); }, 2 * pi / height};
}

CubeMap gather_cube(const SphereField& field, int size, const Control& control) {
  CubeMap cube;
  cube.size = size;
  for (int face = 0; face < 6; ++face) {
    const auto place = [face](float u, float v) -> std::optional<WeightedDirection> {
      const vec3 d = cube_direction_unnormalized({face, u, v});
      const float r2 = glm::dot(d, d);
      return WeightedDirection{d, 1 / (r2 * std::sqrt(r2))};
    };
    cube.faces[face] = gather(size, size, 2 / static_cast<float>(size), field, place, control);
  }
  return cube;
}

Image gather_equirect(const SphereField& field, int height, const Control& control) {
  const auto place = [](float u, float v) -> std::optional<WeightedDirection> {
    return WeightedDirection{equirect_direction(u, v), std::sin(pi * v)};
  };
  return gather(2 * height, height, pi / static_cast<float>(height), field, place, control);
}

Image gather_angular(const SphereField& field, int size, const Control& control) {
  const auto place = [](float u, float v) -> std::optional<WeightedDirection> {
    const std::optional<vec3> d = angular_direction(u, v);
    if (!d) return std::nullopt;
    const float r = std::hypot(2 * u - 1, 2 * v - 1);
    return WeightedDirection{*d, r > 1e-6f ? std::sin(pi * r) / r : pi};
  };
  return gather(size, size, 2 * pi / static_cast<float>(size), field, place, control);
}

Image gather_layout(const SphereField& field, Layout layout, int size, const Control& control) {
  if (layout == Layout::equirect) return gather_equirect(field, size, control);
  if (layout == Layout::angular) return gather_angular(field, size, control);
  return join_faces(gather_cube(field, size, control), layout);
}

// The face size of the same resolution, and back.
int face_size(Layout layout, int size) {
  if (layout == Layout::equirect) return std::max(1, size / 2);
  if (layout == Layout::angular) return std::max(1, size / 4);
  return size;
}

int size_for_face(Layout layout, int face) {
  return layout == Layout::equirect ? 2 * face : layout == Layout::angular ? 4 * face : face;
}

}  // namespace

bool is_cube_layout(Layout layout) {
  return layout != Layout::equirect && layout != Layout::angular;
}

int layout_size(const Image& image, Layout layout) {
  require_whole(image, "layout");
  const int columns = is_cube_layout(layout)       ? cube_layout(layout).columns
                      : layout == Layout::equirect ? 2
                                                   : 1;
  const int rows = is_cube_layout(layout) ? cube_layout(layout).rows : 1;
  const int size = image.height / rows;
  if (image.empty() || size * rows != image.height || size * columns != image.width) {
    throw Error("layout",
                fmt::format("an image of {} x {} pixels cannot be of layout {}", image.width, image.height,
                            name_of(layout)),
                fmt::format("its shape is {} : {}", columns, rows));
  }
  return size;
}

CubeMap to_cube(const Image& image, Layout layout, int size, const Control& control) {
  const int own = layout_size(image, layout);
  if (!is_cube_layout(layout)) {
    return gather_cube(field_of(image, layout), size > 0 ? size : face_size(layout, own), control);
  }
  CubeMap cube = split_faces(image, layout);
  return size == 0 || size == own ? cube : gather_cube(field_of(cube), size, control);
}

Image from_cube(const CubeMap& cube, Layout layout, int size, const Control& control) {
  require(cube.size > 0, "cube map", "it is empty");
  for (const Image& face : cube.faces) {
    require_whole(face, "cube map");
    require(face.width == cube.size && face.height == cube.size && face.channels == cube.faces[0].channels,
            "cube map", "its faces are not all squares of its size");
  }
  const int wanted = size > 0 ? size : size_for_face(layout, cube.size);
  if (is_cube_layout(layout) && wanted == cube.size) return join_faces(cube, layout);
  return gather_layout(field_of(cube), layout, wanted, control);
}

Image convert_layout(const Image& image, Layout from, Layout to, int size, const Control& control) {
  const int own = layout_size(image, from);
  if (is_cube_layout(from)) return from_cube(split_faces(image, from), to, size, control);
  const int wanted = size > 0 ? size : size_for_face(to, face_size(from, own));
  if (from == to && wanted == own) return image;
  return gather_layout(field_of(image, from), to, wanted, control);
}

}  // namespace ssphh::image
