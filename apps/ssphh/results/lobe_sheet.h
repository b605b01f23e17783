#pragma once
/// The pictures of `ssphh sh plot`, after the paper's Figure 2: spherical functions as lobes, blue where they
/// are positive and orange where they are negative, on white, without perspective.

#include <ssphh/core/control.h>
#include <ssphh/image/image.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::app {

/// All Y_lm up to a degree: row l from the top, m from −l to l with m = 0 in the middle. Each is as large as
/// its cell of `size` × `size` pixels lets it be. Seen from 20° above the equator, 60° from +x toward −y;
/// the pole, +z, is up.
image::Image basis_sheet(int degree, int size, const Control& control = {});

/// The luminance of a function in a picture of `size` × `size` pixels; seen likewise with the world's +y up:
/// from 60° from +z toward −x.
image::Image lobe_picture(const sh::RadianceSh& light, int size, const Control& control = {});

}  // namespace ssphh::app
