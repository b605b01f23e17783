#pragma once
/// The picture of `ssphh probe preview`, after the paper's Figure 9.

#include <string>
#include <vector>

#include <ssphh/image/image.h>
#include <ssphh/probes/probe_set.h>

namespace ssphh::app {

struct ProbeSheet {
  struct Column {
    std::string name;
    float exposure;  ///< EV
  };
  std::vector<Column> columns;
  image::Image image;  ///< exposed, scene-linear
};

/// One row per probe: equirectangular pictures of width × width/2 of self and, with a hierarchy, of the
/// neighbours' part and the sum. `exposure` [EV] is added to the automatic one, which puts the 99th
/// percentile at 0.8. Throws Error for an empty set, and for a sheet of over 2^28 pixels.
ProbeSheet probe_sheet(const probes::ProbeSet& set, int width, float exposure);

}  // namespace ssphh::app
