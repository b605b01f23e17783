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
  std::vector<std::uint8_t> reached;  ///< bit k: nothing parts the texel's place and its place_within() k
  std::size_t hidden_count = 0;
};

/// A place that sees backs, or hardly anything farther than a texel, is no place that anybody sees: another
/// one of the texel is taken, and where there is none the texel is hidden. Throws Cancelled when asked to
/// stop.
Places find_places(const Texels& texels, const rays::PosedWorld& world, const Control& control = {});

/// Places of a texel over which light that has edges is averaged.
inline constexpr int places_within = 4;
rays::SurfacePoint place_within(const Texels& texels, const Texel& texel, int k);

/// The atlas: irradiance of each texel's place, from which that of a centre outside of the chart follows as
/// the light changes toward it; hidden texels take the mean of those on the chart beside them, or, where
/// these are hidden, too, the light of the nearest place in the world that is lit; gutters that of the
/// chart's rim. `irradiance` is asked of elements of `places.points`. `sharp`, if given, is added as its mean
/// over the places within the texel that are reached: edges of shadows are no stairs. The
/// same bits for any number of threads. Throws Error for places of other texels and for texels that
/// make_texels() did not find, Cancelled when asked to stop.
image::Image light_texels(const Texels& texels, const Places& places, const IrradianceAt& irradiance,
                          const IrradianceAt& sharp = nullptr, const Control& control = {});

/// Bilinear, clamped at the border, as engines filter it; `uv` from the upper left corner.
vec3 sample(const image::Image& atlas, const vec2& uv);

}  // namespace ssphh::lightmap
