#pragma once
/// How the sphere around a point is laid out in one image, and the way from each layout to each other.
///
/// - `equirect`, 2 × 1: polar coordinates, see sphere_map.h
/// - `strip-h`, 6 × 1: faces +X −X +Y −Y +Z −Z from left to right
/// - `strip-v`, 1 × 6: the same from top to bottom
/// - `cross-h`, 4 × 3: rows [. +Y . .] [−X +Z +X −Z] [. −Y . .]
/// - `cross-v`, 3 × 4: rows [. +Y .] [−X +Z +X] [. −Y .] [. −Z .], −Z turned by 180°
/// - `angular`, 1 × 1: angular map, see sphere_map.h; black outside the disc
///
/// Faces have OpenGL's orientation (ssphh::CubeFace); faces that touch in a cross touch on the cube. Strips
/// and crosses of the same face size hold the same numbers, and converting among them is exact. Every other
/// way resamples: each new pixel is the mean of the old image's bilinear interpolation over the pixel's solid
/// angle (a grid of samples at least three times as fine as the old pixels), so that light is neither gained
/// nor lost (a sun of one pixel: within 2 %). Resampled images have 3 channels.

#include <ssphh/core/control.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/image/cube_map.h>

namespace ssphh::image {

enum class Layout { equirect, strip_h, strip_v, cross_h, cross_v, angular };
constexpr auto enum_table(Layout) {
  using enum Layout;
  return std::to_array<EnumName<Layout>>({{equirect, "equirect"},
                                          {strip_h, "strip-h"},
                                          {strip_v, "strip-v"},
                                          {cross_h, "cross-h"},
                                          {cross_v, "cross-v"},
                                          {angular, "angular"}});
}

/// Whether the layout is a rearrangement of cube faces.
bool is_cube_layout(Layout layout);

/// Height in pixels of a layout's basic square: of a face in a strip or cross, of the whole image otherwise.
/// Throws Error when the image's shape is not the layout's.
int layout_size(const Image& image, Layout layout);

/// `size` is the face size; 0 stands for the image's own (strips, crosses) or a quarter of its turn: width/4.
CubeMap to_cube(const Image& image, Layout layout, int size = 0, const Control& control = {});

/// `size` is as in layout_size; 0 stands for the cube's own (strips, crosses), twice it (equirect) or four
/// times it (angular), which keep the resolution at the horizon and the centre.
Image from_cube(const CubeMap& cube, Layout layout, int size = 0, const Control& control = {});

/// Each to each in at most one resampling; `size` is of the new image, 0 keeps the resolution as above.
Image convert_layout(const Image& image, Layout from, Layout to, int size = 0, const Control& control = {});

}  // namespace ssphh::image
