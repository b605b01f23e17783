#pragma once
/// Jobs of the farm and their results: plain data. A result is a pure function of its job, whoever computes
/// it: job.scene.light names the scene, engine_id() the program.

#include <string>
#include <variant>
#include <vector>

#include <ssphh/bake/bake.h>
#include <ssphh/bake/tiled_transport.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/trace/render_state.h>

namespace ssphh::farm {

/// Which scene, and where its parts are to be had.
struct SceneRef {
  Hash128 package;  ///< ScenePackage::id; its parts are served by blob_service(package)
  std::uint64_t manifest_bytes = 0;
  Hash128 light;  ///< scene::light_hash of the scene, which the worker checks
  float time = 0;

  friend bool operator==(const SceneRef&, const SceneRef&) = default;
};

/// Where VIZ looks for a probe.
struct ProbeSphere {
  vec3 position{0};     ///< world, metres
  float radius = 0.1f;  ///< of the emitter sphere of VIZ, metres

  friend bool operator==(const ProbeSphere&, const ProbeSphere&) = default;
};

/// What finds the light of probes: the path tracer of this program, or Blender's.
enum class Renderer { path, cycles };
constexpr auto enum_table(Renderer) {
  using enum Renderer;
  return std::to_array<EnumName<Renderer>>({{path, "path"}, {cycles, "cycles"}});
}

/// GEN or VIZ of some probes of a set.
struct ProbeJob {
  SceneRef scene;
  Renderer renderer = Renderer::path;
  bake::BakeStage stage = bake::BakeStage::gen;
  int degree = 9;
  int face_size = 64;
  rays::PathParams path;       ///< `seed` is the set's; each probe derives its own from it and its index
  bake::VizParams viz_params;  ///< VIZ: which edges, and whether with T_{j→i}
  std::vector<std::uint32_t> probes;  ///< indices in the set, ascending
  /// GEN: the places of `probes`, in that order. VIZ: those of the whole set.
  std::vector<ProbeSphere> places;
};

/// Probes that light a render's first hits.
struct ProbeLighting {
  Hash128 probes;  ///< blob: a binary probe file, served beside the scene
  std::uint64_t bytes = 0;
  probes::LookupSpec lookup;  ///< its layer is `sum` or `self`
};

/// Tiles of a picture: REF, and G-buffers where `layers` ask for what is seen instead of its light.
struct TileJob {
  SceneRef scene;
  trace::RenderParams params;  ///< `tile` is not used
  std::vector<trace::Tile> tiles;
  std::vector<trace::RenderLayer> layers;  ///< each once, in the order of their table
  std::optional<ProbeLighting> lighting;
};

/// Light by transport of one tile of a set (bake::bake_tile).
struct TransportJob {
  SceneRef scene;
  int degree = 9;
  bool light_known = false;  ///< edges and records alone
  /// Of operator `surfel`, without fitted weights; `bounce` and `fit_params` stay at home.
  bake::TransportBakeParams params;
  std::vector<ProbeSphere> places;  ///< the tile's own probes, then those of its halo
};

using Job = std::variant<ProbeJob, TileJob, TransportJob>;

enum class JobKind { gen, viz, ref, transport };
constexpr auto enum_table(JobKind) {
  using enum JobKind;
  return std::to_array<EnumName<JobKind>>(
      {{gen, "gen"}, {viz, "viz"}, {ref, "ref"}, {transport, "transport"}});
}

JobKind kind_of(const Job& job);

struct ProbeJobResult {
  bake::BakeStage stage = bake::BakeStage::gen;
  int degree = 9;
  std::vector<bake::ProbeStageResult> probes;  ///< in the order of the job
};

struct TileResult {
  trace::Tile tile;
  /// Sums over the passes, images of the tile's size; those that were not asked for are empty.
  trace::RenderState state;
};

struct TileJobResult {
  std::vector<TileResult> tiles;  ///< in the order of the job
};

/// What the tile's probes got, in the order of the job's places.
struct TransportJobResult {
  int degree = 9;
  std::vector<std::string> light_groups;
  float surfel_size = 0;                               ///< of the network, metres
  std::vector<std::vector<probes::GroupLight>> light;  ///< [place][light group]; none where it was known
  std::vector<std::vector<probes::Edge>> edges;        ///< [place], `from` counts the places
  std::optional<probes::SurfaceRecords> records;
  bake::TransportBakeReport report;
};

/// What the job took: no part of the result.
struct JobStats {
  double seconds = 0;
  std::uint64_t rays = 0;
  std::string worker;
};

struct JobResult {
  std::variant<ProbeJobResult, TileJobResult, TransportJobResult> data;
  JobStats stats;
};

/// Limits of one job, checked when it is read.
namespace job_limits {
inline constexpr std::size_t units = 4096;    ///< probes or tiles
inline constexpr std::size_t places = 65536;  ///< of a set
inline constexpr std::size_t tile_places = 16384;
inline constexpr int picture_size = 65536;  ///< pixels along an edge
inline constexpr int tile_size = 1024;
inline constexpr std::uint64_t samples = std::uint64_t{1} << 40;  ///< paths of one job
}  // namespace job_limits

/// Throws Error for numbers outside their ranges: what no client may send.
void validate(const Job& job);

}  // namespace ssphh::farm
