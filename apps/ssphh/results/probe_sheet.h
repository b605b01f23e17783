#pragma once
/// The pictures of `ssphh probe preview`, after the paper's Figures 8 and 9.

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
  std::vector<std::string> rows;  ///< names of the probe of each, or of the neighbour
  image::Image image;             ///< exposed, scene-linear
};

/// One row per probe: equirectangular pictures of width × width/2 of self and, with a hierarchy, of the
/// neighbours' part and the sum. `exposure` [EV] is added to the automatic one, which puts the 99th
/// percentile at 0.8. Throws Error for an empty set, and for a sheet of over 2^28 pixels.
ProbeSheet probe_sheet(const probes::ProbeSet& set, int width, float exposure);

/// How HIER makes S'_i of the probe of that name (Figure 8): a row for each neighbour j it took, strongest
/// first, with S_i, H_{j→i}, S_j, H ⊗ S_j and what S_i and the products so far sum up to, each with its name
/// above it. S_i, S_j and the sum share an exposure. Throws Error for a set without a hierarchy, for another
/// name, for a probe that took no neighbour, and as probe_sheet() does.
ProbeSheet edge_sheet(const probes::ProbeSet& set, const std::string& probe, int width, float exposure);

}  // namespace ssphh::app
