#pragma once
/// HIER: S'_i = S_i ⊕ Σ_j H_{j→i} ⊗ S_j over the strongest neighbours (paper §3, Algorithm 1). What ⊗ can
/// mean, and what each meaning is worth, is in libs/methods/ssphh/README.md:
///   coefficient  (1/√4π) H[k]·S_j[k]: the paper's; depends on the axes of the scene
///   raw          H[k]·S_j[k]: the same without the factor, which makes two constants multiply right
///   mean         H[k]·S_j[0]/√4π: H keeps its directions, S_j gives only its mean
///   matrix       T_{j→i} S_j: exact for SPHLs that are lights; needs a bake with the transfer matrices

#include <optional>

#include <ssphh/core/contraction.h>
#include <ssphh/probes/probe_set.h>

namespace ssphh::probes {

struct HierParams {
  HierOperator op = HierOperator::coefficient;
  int neighbors = -1;   ///< N′: at most so many neighbours per probe, those with the largest P; −1: all
  float threshold = 0;  ///< and only those with P above it, which may exceed 1 (VizSource)

  friend bool operator==(const HierParams&, const HierParams&) = default;
};

/// Indices into probe.edges of the neighbours that HIER uses, by P descending, ties by index of the
/// neighbour.
std::vector<int> select_neighbors(const Probe& probe, const HierParams& params);

/// sum ⊕= H_{j→i} ⊗ S_j: what one neighbour, whose light is `source`, adds. All are of one degree, and
/// `matrix` needs the edge's matrix: unchecked, as hier() has looked.
void add_neighbor(sh::RadianceSh& sum, const Edge& edge, const sh::RadianceSh& source, HierOperator op);

/// Adds the neighbours' light to every probe: fills set.hierarchy. Memory of an existing hierarchy is used
/// again, so that a call per frame takes little more than lists of edges. S_j is `self`: emitters seen
/// directly and reflected light. Returns the number of edges used. Throws Error, and leaves the set as it
/// was, for parameters out of range, for `matrix` on a set baked without matrices, for groups that were not
/// merged, and for edges that name no probe or are not of the set's degree.
std::size_t hier(ProbeSet& set, const HierParams& params);

/// Bounds of the spectral radius of HIER by `mean`: the factor by which one more application would shrink the
/// probes' means. None for the other operators, whose entries have either sign, so that no such bound is
/// cheap.
std::optional<Contraction> hier_contraction(const ProbeSet& set, const HierParams& params);

}  // namespace ssphh::probes
