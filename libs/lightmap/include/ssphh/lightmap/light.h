#pragma once
/// Light in the texels of an atlas.

#include <functional>

#include <ssphh/image/image.h>
#include <ssphh/lightmap/texels.h>
#include <ssphh/rays/posed_world.h>

namespace ssphh::lightmap {

/// Irradiance [W/m²] at a point of a still surface; called from several threads.
using IrradianceAt = std::function<vec3(const rays::SurfacePoint& at)>;

/// Which place of each texel is lit.
struct Places {
  std::vector<rays::SurfacePoint> points;  ///< of each texel; of one that is hidden its own
  std::vector<std::uint8_t> hidden;        ///< 1: the texel lies within other bodies or right under them
  std::size_t hidden_count = 0;
};

/// A place that sees backs, or hardly anything farther than a texel, is no place that anybody sees: another
/// one of the texel is taken, and where there is none the texel is hidden. Throws Cancelled when asked to
/// stop.
Places find_places(const Texels& texels, const rays::PosedWorld& world, const Control& control = {});

/// The atlas: irradiance of each texel's place, from which that of a centre outside of the chart follows as
/// the light changes toward it; hidden texels take the mean of their neighbours on the chart, those beside
/// light first, and gutters that of the chart's rim. `irradiance` is asked of elements of `places.points`.
/// The same bits for any number of threads. Throws
/// Error for places of other texels and for texels that make_texels() did not find, Cancelled when asked to
/// stop.
image::Image light_texels(const Texels& texels, const Places& places, const IrradianceAt& irradiance,
                          const Control& control = {});

/// Bilinear, clamped at the border, as engines filter it; `uv` from the upper left corner.
vec3 sample(const image::Image& atlas, const vec2& uv);

}  // namespace ssphh::lightmap
