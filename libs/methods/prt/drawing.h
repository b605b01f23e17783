#pragma once
/// Transfer vectors as marks.

#include <span>

#include <ssphh/sketch/sketch.h>

#include "transfer.h"

namespace ssphh::methods::prt {

/// A vertex whose transfer vector is shown.
struct ShownVertex {
  std::uint32_t vertex;
  rays::SurfacePoint at;
};

/// At most one vertex in each cube of edge `spacing` [m] and for each main direction of normals.
std::vector<ShownVertex> shown_vertices(const TransferMesh& mesh, float spacing);

/// A lobe for each: how much of the light from a direction becomes irradiance there, 1 being `size` metres.
sketch::Sketch transfer_drawing(const TransferVectors& transfer, std::span<const ShownVertex> vertices,
                                float size);

}  // namespace ssphh::methods::prt
