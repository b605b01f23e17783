#pragma once
/// A binary tree of clusters of virtual lights (Walter et al., Lightcuts: A Scalable Approach to
/// Illumination, SIGGRAPH 2005).

#include "transfer.h"

namespace ssphh::methods::vpl {

struct LightNode {
  VplCluster cluster;
  int light = 0;              ///< that stands for all: one of them, chosen with probability ∝ its power
  int left = -1, right = -1;  ///< −1: a single light
};

/// Children before their parents, the root last; empty for no lights. Split at the middle of the longest edge
/// in space and, weighed with a quarter of the scene's size, in direction. The choices are the same at every
/// call.
std::vector<LightNode> build_light_tree(std::span<const Vpl> lights);

struct CutLight {
  vec3 irradiance{0};  ///< [W/m²]
  int lights = 0;      ///< in the cut
};

/// Irradiance by a cut through the tree: the cluster with the largest bound on its error is split until no
/// bound exceeds `error` times the sum. Shadow rays begin at `start`.
CutLight gather_cut(std::span<const LightNode> tree, std::span<const Vpl> lights, const Receiver& at,
                    const vec3& start, const rays::PosedWorld& surfaces, const VplParams& params,
                    float error);

}  // namespace ssphh::methods::vpl
