#pragma once

#include <ssphh/lightmap/chart.h>

namespace ssphh::lightmap {

/// Turns and shifts a chart such that the rectangle of least area around it begins at 0 and is no higher than
/// wide, and sets its size. One of the rectangle's edges lies along one of the chart's convex hull (Freeman &
/// Shapira, 1975).
void lay_along_axes(Chart& chart);

}  // namespace ssphh::lightmap
