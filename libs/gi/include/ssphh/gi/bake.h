#pragma once
/// GEN and VIZ of a whole set, one probe after the other, with progress, cancellation and resume.

#include <filesystem>

#include <ssphh/gi/probe_set.h>
#include <ssphh/gi/viz.h>
#include <ssphh/scene/radiance_source.h>

namespace ssphh::gi {

struct BakeParams {
  GenMode gen = GenMode::full;  ///< local overrides path.max_depth with 1
  scene::PathParams path;       ///< of GEN; VIZ uses the same depth and samples
  int face_size = 64;           ///< texels along a cube face
  bool keep_light = false;      ///< no GEN: VIZ alone, beside the light that the set holds
  bool viz = true;              ///< false: the set's edges stay as they are
  VizParams viz_params;
};

/// What a bake took: not part of the set, which must not depend on timing.
struct BakeReport {
  double gen_seconds = 0, viz_seconds = 0;  ///< those of a resumed run's earlier parts included
  std::uint64_t rays = 0;
  std::size_t resumed = 0;  ///< probe stages taken from the checkpoint
  std::vector<std::string> warnings;
};

/// Fills the set that INIT made: GEN per light group, then VIZ. Warns about probes without light or inside a
/// body, and about P over 1. With a `checkpoint` path every finished probe is appended to that file, so that
/// the same call after a Cancelled or a killed process continues there and gives the same bits; the caller
/// removes it once the set is safe on disk. A checkpoint of another scene or other parameters is replaced.
/// Throws Error for parameters out of range, an empty set, and light that is to be kept but is of other
/// groups.
ProbeSet bake(const scene::RadianceSource& source, ProbeSet set, const BakeParams& params,
              const std::filesystem::path& checkpoint, BakeReport& report, const Control& control = {});

}  // namespace ssphh::gi
