#pragma once
/// A vertex of a path, and the random numbers of what happens there.

#include <ssphh/core/random.h>
#include <ssphh/rays/radiance_source.h>

#include "posed_geometry.h"

namespace ssphh::trace {

/// Random numbers of sample `index` of a pixel. Every vertex has its own dimensions, so what happens at one
/// does not shift those of the next.
struct PathSampler {
  std::uint64_t seed;
  std::uint32_t index;

  SampleSequence camera() const { return {seed, index}; }
  /// The random numbers of a vertex.
  struct Vertex {
    float light, lobe;
    vec2 point, direction;
    float roulette;
  };
  Vertex vertex(int depth) const {
    const auto u = sample_pairs(hash_combine(seed, static_cast<std::uint64_t>(depth) + 1), index);
    return {u[0].x, u[0].y, u[1], u[2], u[3].x};
  }
  /// Of the n-th glass that a path meets: whether it goes straight on, and whether it takes what else glass
  /// does.
  vec2 glass(int n) const {
    return sample_pairs(hash_combine(seed, 0x5eed61a550000000 + static_cast<std::uint64_t>(n)), index)[0];
  }
  /// For light sample i of a vertex.
  PathSampler light(int i) const {
    return i == 0 ? *this : PathSampler{hash_combine(seed, 0xd157a47), index};
  }
  /// For what a surface with a lookup mirrors.
  PathSampler mirrored() const { return {hash_combine(seed, 0x3e1f0110), index}; }
  /// For what panes mirror.
  PathSampler by_panes() const { return {hash_combine(seed, 0x9a4e5), index}; }
  /// What lets the ray pass that leaves a vertex: glass only toward lights, smooth sheets or all of it.
  Passage passage(const PosedGeometry& scene, int vertex, bool shadow, bool all_glass = false,
                  rays::PathSet paths = rays::PathSet::all) const {
    const PassedGlass glass = !shadow || paths == rays::PathSet::diffuse ? PassedGlass::none
                              : all_glass                                ? PassedGlass::all
                                                                         : PassedGlass::smooth_sheets;
    return {scene.filters() ? passage_seed(vertex, shadow) : 0, glass};
  }

 private:
  /// Never 0.
  std::uint64_t passage_seed(int vertex, bool shadow) const {
    const std::uint64_t event =
        (std::uint64_t{index} << 32) | (static_cast<std::uint64_t>(vertex) << 1) | shadow;
    return hash_combine(~seed, event) | 1;
  }
};

/// Where a scattered or camera ray starts, and what MIS needs to know about it.
struct PathVertex {
  vec3 position;           ///< on the surface: lights are sampled from here
  vec3 normal{0};          ///< geometric, toward wo; zero at the camera
  float bsdf_pdf = 0;      ///< of the ray that leaves; 0: nothing else finds the light that it meets
  bool looked_up = false;  ///< a lookup has given its indirect light, and the direct light that it holds
  bool followed = false;   ///< the ray is of its specular lobe alone, and finds what the lookup holds, too
  bool in_pane = false;    ///< it is the mirror image, in a pane, of the vertex before
  /// Then, of the ray that leaves: the specular lobe's share of what the surface reflects of its light.
  vec3 mirrored{0};
};

}  // namespace ssphh::trace
