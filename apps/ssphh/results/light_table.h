#pragma once
/// Spherical functions in rows and columns, as equirectangular pictures.

#include <string>
#include <vector>

#include <ssphh/image/image.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::app {

struct LightColumn {
  std::vector<const sh::RadianceSh*> lights;  ///< of each row
  std::size_t exposed_as = 0;                 ///< the column by which its automatic exposure goes
  std::vector<std::string> labels = {};       ///< above each picture; none: there is no room for them
};

struct LightTable {
  std::vector<float> exposures;  ///< EV of each column
  image::Image image;            ///< exposed, scene-linear; what is negative is black
};

/// Pictures of width × width/2. Columns are equally long and all have labels, or none has. `exposure` [EV] is
/// added to the automatic ones, which put the 99th percentile of the brightest channel at 0.8. Throws Error
/// for a table of over 2^28 pixels.
LightTable light_table(const std::vector<LightColumn>& columns, int width, float exposure);

}  // namespace ssphh::app
