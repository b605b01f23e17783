#pragma once

#include <vector>

#include <ssphh/rays/radiance_source.h>

#include "arrays.h"

namespace ssphh::python {

/// Irradiance at each point, N×3, on all threads.
FloatArray irradiance_of(const rays::IndirectLight& light, const std::vector<rays::SurfacePoint>& points,
                         const py::object& progress);

}  // namespace ssphh::python
