#pragma once
/// Probe sets as cooked files, which a shipped program looks up in place (ssphh/runtime/runtime.h,
/// docs/cooked-files.md).

#include <cstddef>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/scene.h>

namespace ssphh::cook {

/// The scene in which a set was baked, and rays in it.
struct CookScene {
  const scene::Scene& scene;
  const rays::TransportSource& source;
};

struct CookParams {
  /// Texels of a side of the six faces by which a probe is known to be hidden, 8 to 256; 0: all are seen.
  int sight_size = 32;
  /// Points of surfaces are those of this set, which has the same probes: its cooked file and this one can be
  /// swapped. Bakes choose their points by their light. None: the set's own.
  const probes::ProbeSet* places = nullptr;
};

struct Cooked {
  std::vector<std::byte> bytes;  ///< the file
  std::size_t points = 0;        ///< of surfaces, with light of their own
  std::size_t cells = 0;         ///< with lists of these
  std::size_t entries = 0;       ///< of all lists
  std::size_t sight_bytes = 0, list_bytes = 0, light_bytes = 0;
  std::vector<std::string> lost;  ///< what of the set a cooked file does not carry, one line each
};

/// The set's light as its default lookup (probes::IrradianceLookup) takes it, each light group apart:
/// irradiance of the probes, deringed by the window that their sum needs at the set's scales (a group that is
/// off: by its own); records of surfaces, or irradiance at fitted points, and the lists of those that light
/// each cell. Sight and lists are of the scene in the pose of the bake; without a scene there are neither. A
/// hierarchy's neighbours are within. Throws Error as probes::surface_light and prepare_surfaces do, and for
/// more than 65535 probes; Cancelled when asked to stop.
Cooked cook(const probes::ProbeSet& set, const CookScene* scene, const CookParams& params = {},
            const Control& control = {});

}  // namespace ssphh::cook
