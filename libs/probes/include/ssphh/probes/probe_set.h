#pragma once
/// Spherical-harmonics lights (SPHLs) of a scene and the light exchanged between them: plain data, what a
/// bake makes and a probe file holds. S_i, H_{j→i}, P_ij and T_{j→i} as in libs/methods/ssphh/README.md.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/hash.h>
#include <ssphh/core/vectors.h>
#include <ssphh/probes/baseline.h>
#include <ssphh/probes/fitted_points.h>
#include <ssphh/probes/surface_records.h>
#include <ssphh/rays/path_set.h>
#include <ssphh/scene/light_mode.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/sh/operators.h>

namespace ssphh::probes {

/// What found the light of a set: `path`: GEN, path tracing at each probe; `surfel`: light transport between
/// surfels; `bounce`: the same with the probes as the only unknowns.
enum class LightOperator { path, surfel, bounce };
constexpr auto enum_table(LightOperator) {
  using enum LightOperator;
  return std::to_array<EnumName<LightOperator>>({{path, "path"}, {surfel, "surfel"}, {bounce, "bounce"}});
}

/// What found the edges between the probes: nothing did; `path`: VIZ, path tracing at each probe; `links`:
/// the links between surfels of a transport network.
enum class VizMethod { none, path, links };
constexpr auto enum_table(VizMethod) {
  using enum VizMethod;
  return std::to_array<EnumName<VizMethod>>({{none, "none"}, {path, "path"}, {links, "links"}});
}

/// How bright the emitter of VIZ is, a sphere that shines alike in all directions: total intensity 1 (the
/// paper's L̂: I = 1 W/sr, radiance 1/(π r²), so that H and P hardly depend on its radius r), or radiance 1.
enum class VizSource { intensity, radiance };
constexpr auto enum_table(VizSource) {
  using enum VizSource;
  return std::to_array<EnumName<VizSource>>({{intensity, "intensity"}, {radiance, "radiance"}});
}

/// Radiance of the emitter [W sr⁻¹ m⁻²], its radius in metres.
float emitter_radiance(VizSource source, float radius);

/// What the GEN cube maps hold: every bounce up to max_depth, or direct light only (max_depth 1), so that
/// HIER does not count the neighbours' light a second time.
enum class GenMode { full, local };
constexpr auto enum_table(GenMode) {
  using enum GenMode;
  return std::to_array<EnumName<GenMode>>({{full, "full"}, {local, "local"}});
}

/// What ⊗ means in S'_i = S_i ⊕ Σ_j H_{j→i} ⊗ S_j (see hier.h).
enum class HierOperator { coefficient, mean, matrix, raw };
constexpr auto enum_table(HierOperator) {
  using enum HierOperator;
  return std::to_array<EnumName<HierOperator>>(
      {{coefficient, "coefficient"}, {mean, "mean"}, {matrix, "matrix"}, {raw, "raw"}});
}

/// How a set was made. `gen` to `face_size` tell of the paths of GEN and VIZ, as far as `op` and `viz` say
/// that there were any; light and edges of other operators have every bounce.
struct GeneratorInfo {
  LightOperator op = LightOperator::path;
  VizMethod viz = VizMethod::none;
  VizSource viz_source = VizSource::intensity;
  GenMode gen = GenMode::full;
  int max_depth = 3;  ///< of GEN, as the next two
  int passes = 1;
  int spp = 16;
  rays::PathSet viz_paths = rays::PathSet::all;
  int viz_max_depth = 3;
  int viz_passes = 1;
  int viz_spp = 16;
  int face_size = 64;
  std::uint64_t seed = 0;
  int directions = 0;     ///< rays per probe of the transport network; 0: there was none
  float surfel_size = 0;  ///< of the network, metres
  int link_rays = 0;      ///< of the network, cosine rays per surfel
  std::string scene;      ///< name, for people
  Hash128 scene_hash;     ///< scene::light_hash
  float time = 0;         ///< pose of the scene, seconds

  friend bool operator==(const GeneratorInfo&, const GeneratorInfo&) = default;
};

/// A light group: lamps that are switched, dimmed or coloured together.
struct LightGroup {
  std::string name;
  vec3 scale{1};  ///< c_g, relative to the bake
  /// `baked`: surfaces that look the set up get the group's direct light from it, too, and from nowhere else;
  /// `diffuse`: those that look up its records.
  scene::LightMode mode = scene::LightMode::realtime;

  friend bool operator==(const LightGroup&, const LightGroup&) = default;
};

/// What SPHL j, a sphere that shines alike in all directions (VizSource), gives at probe i: an edge i ← j of
/// the hierarchy.
struct Edge {
  int from = -1;  ///< j
  /// P_ij ≥ 0: mean over directions of the radiance seen at i (Rec.709 luminance). With a sphere of radiance
  /// 1 it is the share of that radiance, about 1 at most.
  float transfer = 0;
  sh::RadianceSh h;  ///< H_{j→i}
  /// T_{j→i} of radiance that the sphere gives off, whatever the source of H; both degrees that of the set;
  /// or empty.
  sh::TransferMatrix matrix;

  friend bool operator==(const Edge& a, const Edge& b) {
    return a.from == b.from && a.transfer == b.transfer && a.h == b.h && a.matrix.values == b.matrix.values;
  }
};

/// P_ij = H_{j→i}[0]/√4π as Rec.709 luminance. Not clamped.
float transfer_coefficient(const sh::RadianceSh& h);

/// S_i^g as baked, in two fields so that no light is counted twice.
struct GroupLight {
  /// Path depth 0: the group's emitters seen directly; empty: zero. Of a baked group also lamps that are
  /// points or parallel light, which no ray can see.
  sh::RadianceSh emitted;
  sh::RadianceSh reflected;  ///< depth 1..max_depth: what surfaces that also get direct light may look up

  friend bool operator==(const GroupLight&, const GroupLight&) = default;
};

struct Probe {
  std::string name;
  vec3 position{0};     ///< world, metres
  float radius = 0.1f;  ///< of the emitter sphere of VIZ, metres
  std::vector<GroupLight> groups;
  /// What surfaces look up, Σ_g c_g reflected_g, and of baked groups c_g emitted_g: derived by merge_groups,
  /// not stored in files.
  sh::RadianceSh reflected;
  sh::RadianceSh self;      ///< S_i = Σ_g c_g (emitted_g + reflected_g): likewise
  std::vector<Edge> edges;  ///< only P > 0, ascending `from`; perhaps only the strongest ones

  friend bool operator==(const Probe&, const Probe&) = default;
};

/// Result of HIER for every probe, and what it was computed with.
struct Hierarchy {
  HierOperator op = HierOperator::coefficient;
  int neighbors = -1;                    ///< N′; −1: all
  float threshold = 0;                   ///< only edges with P above it
  std::vector<sh::RadianceSh> neighbor;  ///< Σ_j H_{j→i} ⊗ S_j
  std::vector<sh::RadianceSh> sum;       ///< S'_i = self ⊕ neighbor: derived, not stored in files

  friend bool operator==(const Hierarchy&, const Hierarchy&) = default;
};

struct ProbeSet {
  int degree = 9;  ///< of every function in the set
  GeneratorInfo generator;
  std::vector<LightGroup> light_groups;
  std::vector<Probe> probes;
  std::optional<Hierarchy> hierarchy;
  std::optional<FittedPoints> fitted;     ///< of surface points that stand still in the pose of the bake
  std::optional<SurfaceRecords> surface;  ///< light at such points, every bounce, whatever the probes hold
  std::optional<Baseline> baseline;       ///< by which an update tells what has changed

  friend bool operator==(const ProbeSet&, const ProbeSet&) = default;
};

/// A set without light: a probe at each of the places, in their order. Throws Error for a degree outside
/// 0..10, for a position that is not finite and for a radius that is not positive.
ProbeSet dark_set(std::span<const scene::ProbePlace> places, int degree);

/// Recomputes `reflected` and `self` of every probe, and the light of surface records, from their groups and
/// the scales. Throws Error, and leaves the set as it was, for a degree outside 0..10, for functions of
/// another, for more groups than the set's, and for records that are not whole.
void merge_groups(ProbeSet& set);

/// Switches, dims or recolours a lamp without a bake: sets the group's scale, merges again and drops the
/// hierarchy, which must be computed anew. Throws Error that lists the groups when `group` is unknown, or for
/// a scale outside 0..1e6.
void relight(ProbeSet& set, const std::string& group, const vec3& scale);

/// Names of the groups whose direct light surfaces look up: whoever draws with the set leaves theirs out.
std::vector<std::string> baked_groups(const ProbeSet& set);

/// Names of the `diffuse` groups whose direct light is in the records: whoever draws with records leaves
/// theirs out, too, but for what mirrors the environment.
std::vector<std::string> mirrored_groups(const ProbeSet& set);

/// What emitters of mirrored_groups() send straight to each probe: light that things that move look up where
/// others have records, but for mirrors, and still surfaces without a record half of it (still_share_of_sky).
/// Empty: there are no such groups.
std::vector<sh::RadianceSh> light_beside_records(const ProbeSet& set);
/// Finds it in the memory that `light` has.
void light_beside_records(const ProbeSet& set, std::vector<sh::RadianceSh>& light);

/// Number of edges stored in the set.
std::size_t edge_count(const ProbeSet& set);

}  // namespace ssphh::probes
