#pragma once
/// Parts of a scene whose errors `ssphh measure` tells apart.

#include <string>
#include <vector>

#include <ssphh/rays/radiance_source.h>
#include <ssphh/scene/query.h>
#include <ssphh/study/leak.h>

namespace ssphh::app {

struct NamedBox {
  std::string name;
  scene::Bounds box;  ///< [m]
};

/// "NAME=x0,y0,z0,x1,y1,z1". Throws Error for anything else, and for the names of the regions that every
/// scene has.
NamedBox read_named_box(const std::string& text);

/// Throws Error for a name that comes twice.
void require_different_names(const std::vector<NamedBox>& boxes);

struct MeasuredRegion {
  std::string name;
  std::vector<rays::SurfacePoint> points;  ///< not empty
  study::TruthAtPoints truth;              ///< at these
};

/// `inside` and `outside` (study::inside), those of them that hold any of the points.
std::vector<MeasuredRegion> inside_and_outside(const rays::TransportSource& source,
                                               const std::vector<rays::SurfacePoint>& points,
                                               const study::TruthAtPoints& truth, float time);

}  // namespace ssphh::app
