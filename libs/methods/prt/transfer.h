#pragma once
/// Transfer vectors: how distant light, as spherical harmonics, becomes irradiance at the vertices of a mesh
/// (Sloan, Kautz & Snyder, Precomputed Radiance Transfer for Real-Time Rendering in Dynamic, Low-Frequency
/// Lighting Environments, SIGGRAPH 2002, §4 and §5).

#include <limits>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/sh/coefficients.h>

#include "vertex_rays.h"

namespace ssphh::methods::prt {

struct TransferParams {
  int degree = 4;
  /// Surfaces nearer than this hide light, and reflect it; beyond it a ray sees the distant light [m].
  float reach = std::numeric_limits<float>::infinity();
  int bounces = 0;  ///< Sloan's interreflected transfer; 0: shadowed only
};

/// Irradiance E(v) = Σ_k T[v][k] L[k], from the coefficients L of the distant radiance.
struct TransferVectors {
  int degree = 0;
  std::vector<float> direct;    ///< [vertex · (degree + 1)² + k]: visibility times cosine
  std::vector<vec3> reflected;  ///< likewise, by 1..bounces reflections; empty for bounces 0

  std::size_t stride() const { return static_cast<std::size_t>(sh::coefficient_count(degree)); }
  /// Of vertex v.
  vec3 direct_irradiance(std::size_t v, const sh::RadianceSh& light) const;
  vec3 reflected_irradiance(std::size_t v, const sh::RadianceSh& light) const;
};

/// What lies within a body takes the value of its neighbours. The same input gives the same bits.
TransferVectors find_transfer(const TransferMesh& mesh, const VertexRings& rings, const VertexRays& rays,
                              const TransferParams& params, const Control& control = {});

/// Nothing hides anything: the cosine lobe.
TransferVectors open_transfer(const TransferMesh& mesh, int degree);

}  // namespace ssphh::methods::prt
