#pragma once
/// Voxels as marks.

#include <span>

#include <ssphh/methods/vct/pyramid.h>
#include <ssphh/sketch/sketch.h>

namespace ssphh::methods::vct {

/// A box for each of these voxels of level 0, a little smaller than it, with the radiance that it shows to
/// each side; a side that shows nothing has the mean of the others.
sketch::Sketch voxels_drawing(const Pyramid& voxels, std::span<const VoxelKey> keys);

}  // namespace ssphh::methods::vct
