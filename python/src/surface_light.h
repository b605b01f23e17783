#pragma once

#include <functional>
#include <vector>

#include <ssphh/rays/radiance_source.h>

#include "arrays.h"

namespace ssphh::python {

/// Irradiance at each point, N×3, on all threads.
FloatArray irradiance_of(const rays::IndirectLight& light, const std::vector<rays::SurfacePoint>& points,
                         const py::object& progress);

/// Direct and indirect irradiance, N×3 each, of what `trace` finds.
py::tuple traced_at(const py::object& progress,
                    const std::function<std::vector<rays::IrradianceEstimate>(const Control&)>& trace);

}  // namespace ssphh::python
