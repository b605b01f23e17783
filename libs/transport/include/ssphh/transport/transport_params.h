#pragma once
/// What transport may be told, apart from what does it.

#include <cstddef>
#include <vector>

#include <ssphh/core/vectors.h>
#include <ssphh/probes/tiles.h>
#include <ssphh/probes/weight_params.h>

namespace ssphh::transport {

/// Irradiance with one float of padding: 16 bytes, one load.
using Irradiance4 = vec4;

/// What a TransportNetwork (network.h) may be told.
struct TransportParams {
  int directions = 384;  ///< rays per probe
  /// Edge of a surfel [m]; 0: the scene's radius over `surfels_per_radius`, but at most the largest of these:
  /// a quarter of the probes' median distance or 0.5 m, whichever is less; an eighth of that distance less
  /// 0.5 m, where nothing is of a person's size; a 30,000th of the scene's length.
  float surfel_size = 0;
  int link_rays = 128;  ///< cosine rays per surfel
  int samples = 8;      ///< points per surfel at which direct light is found, 1..32
  float surfels_per_radius = 20;
  /// Where one size for all would make more surfels than about this, they grow with the distance of probes
  /// (surfel_sizes.h).
  int most_surfels = 100000;
  bool grow = false;  ///< they do so however few one size makes: beyond what probes see, too, lies a city

  friend bool operator==(const TransportParams&, const TransportParams&) = default;
};

/// What a Solver (solve.h) may be told.
struct SolveParams {
  float tolerance = 1e-3f;  ///< largest residual of a surfel, relative to its E + 1e-3 · (the largest E)
  int max_iterations = 300;
  /// Where a bounce keeps nearly all light it adds little to what is far from its end: converged is then only
  /// what `error` puts within the tolerance as well.
  bool settle = false;
};
struct SolveReport {
  int iterations = 0;
  float residual = 0;  ///< as `tolerance`, before the last iteration
  float error = 1;     ///< share of all light that is missing at most
  bool converged = true;
};

/// What a BounceOperator (bounce.h), B, may be told.
struct BounceParams {
  probes::WeightParams weights{.method = probes::WeightMethod::trilinear};
  int irradiance_degree = 2;  ///< bands of the probes' irradiance that surfaces look up
  int applications = 0;       ///< of B; 0: until it changes no probe by more than the tolerance
  float tolerance = 1e-3f;    ///< of a probe's band 0, relative to the largest one's
  int max_iterations = 200;
};

/// What a room or a flat needs.
inline constexpr int usual_records = 16384;
inline constexpr std::size_t most_records = std::size_t{1} << 16;

/// What a SurfaceGather (surface_gather.h) may be told.
struct GatherParams {
  int points = 0;   ///< of gather_where_needed(): 1..65536; 0: none
  int rays = 1024;  ///< per point, 4..65536
  /// Where things move: poses of the scene's animations, evenly spaced from the first to the last, in which
  /// light asks for points, beside the present one; below 2: that alone. A bake looks at no other.
  int poses = 5;
  /// Light groups whose direct light is kept at the points, too, each once: as many rays per point and
  /// emitter.
  std::vector<int> baked = {};
  probes::TileBox within = {};  ///< gather_where_needed() chooses points in here alone

  friend bool operator==(const GatherParams&, const GatherParams&) = default;
};

}  // namespace ssphh::transport
