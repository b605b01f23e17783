#pragma once

#include <cstdint>
#include <vector>

namespace ssphh::realtime {

/// Times of one pass. On a GPU gpu_ms is that of some frames ago, for nobody waits for it; on a software
/// renderer both are wall time.
struct PassTime {
  const char* name = "";
  double cpu_ms = 0, gpu_ms = 0;
};

struct FrameStats {
  double cpu_ms = 0;             ///< of the whole draw() call
  std::vector<PassTime> passes;  ///< in the order of drawing; those that had nothing to do are left out
  std::uint64_t draw_calls = 0;
  std::uint64_t triangles = 0;  ///< sent to the renderer, shadows included
  std::uint64_t samples_shaded =
      0;  ///< by the geometry pass, those painted over later included; of some frames ago
  std::uint64_t bytes_uploaded = 0;  ///< since the frame before
  int shadow_maps_drawn = 0;         ///< faces and cascades that were out of date
  int shadow_maps_waiting = 0;       ///< that the next frames will draw
};

}  // namespace ssphh::realtime
