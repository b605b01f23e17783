#pragma once
/// Virtual point lights as marks.

#include <span>

#include <ssphh/methods/vpl/virtual_lights.h>
#include <ssphh/sketch/sketch.h>

namespace ssphh::methods::vpl {

/// A ball for each light, in the colour of its power, whose area grows with the power between a quarter and
/// four times the mean's; and a line along its normal. `size` is the radius of one of mean power [m].
sketch::Sketch photons_drawing(std::span<const Vpl> lights, float size);

}  // namespace ssphh::methods::vpl
