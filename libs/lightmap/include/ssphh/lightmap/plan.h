#pragma once
/// From a scene to charts that lie in an atlas.

#include <ssphh/lightmap/layout.h>

namespace ssphh::lightmap {

struct Plan {
  /// That was given; where texels are not all alike, wide triangles of it are cut. Charts, layout and
  /// with_lightmap() are of this one.
  scene::Scene scene;
  Charts charts;
  Layout layout;
};

/// Charts of a scene, laid out. Where the smallest atlas of those that `layout` lets choose cannot give every
/// surface the density that it asks for (none: 8 texels per metre), what is far from whatever stands before
/// it gets wider texels: a plain around a house, and not its rooms (48 texels to the distance, 64 times as
/// wide at most); a note says so. Charts that follow a file's own coordinates are left as they are. Throws as
/// make_charts() and lay_out(), and where nothing has a chart an Error with the reasons.
Plan plan_lightmap(scene::Scene scene, float time, const ChartParams& charts = {},
                   const LayoutParams& layout = {}, const Control& control = {});

}  // namespace ssphh::lightmap
