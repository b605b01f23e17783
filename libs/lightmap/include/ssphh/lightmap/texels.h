#pragma once
/// The places on surfaces that texels of an atlas stand for.

#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/lightmap/layout.h>
#include <ssphh/rays/surface_point.h>

namespace ssphh::lightmap {

/// A triangle in the world and in the atlas.
struct Face {
  std::array<vec3, 3> position, normal;  ///< world [m]; shading normals, unit
  vec3 front{0};                         ///< geometric normal of its front side, unit
  std::array<vec2, 3> at;                ///< in texels, as PlacedChart::texel
  std::uint8_t open = 0;                 ///< as FlatTriangle::open
  bool moves = false;                    ///< it is of a body that an animation moves
};

struct Texel {
  std::uint32_t index = 0;  ///< row · width + column
  std::uint32_t face = 0;
  vec3 share{1, 0, 0};  ///< of the face's corners
  vec2 way{0};          ///< from its place to its centre, in texels; 0 inside of the chart
};

/// Texels of each chart, one chart after another: all whose bilinear filter the chart touches. Where a centre
/// lies outside of the chart, its place is the chart's nearest point; places lie at least a tenth of a texel
/// inside of the border.
struct Texels {
  int width = 0, height = 0;
  std::vector<Face> faces;
  std::vector<Texel> texels;
  std::vector<std::size_t> first;   ///< of each chart, and the end
  std::vector<PlacedChart> places;  ///< of each chart
};

/// `charts` and `layout` are of this scene and time. Throws Error where they cannot be, Cancelled when asked
/// to stop.
Texels make_texels(const scene::Scene& scene, float time, std::span<const Chart> charts, const Layout& layout,
                   const Control& control = {});

/// A place of a texel's face, `step` texels from the texel's own as far as the face reaches, and the shading
/// normal there.
rays::SurfacePoint place_of(const Texels& texels, const Texel& texel, const vec2& step = vec2(0));

}  // namespace ssphh::lightmap
