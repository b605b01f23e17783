/// Tiles of transport on a farm.

#include <ssphh/core/require.h>
#include <ssphh/farm/farm_bake.h>
#include <ssphh/scene/query.h>

#include "farm_progress.h"
#include "result_cache.h"
#include "unit_key.h"

namespace ssphh::farm {
namespace {

TransportJob job_of(const probes::ProbeSet& set, const probes::Tile& tile, const bake::TiledParams& params,
                    const SceneRef& scene) {
  TransportJob job;
  job.scene = scene;
  job.degree = set.degree;
  job.light_known = params.light_known;
  job.params = bake::params_of_tile(params.transport, tile);
  for (std::uint32_t k = 0; k < tile.own; ++k) {
    const probes::Probe& probe = set.probes[tile.first + k];
    job.places.push_back({probe.position, probe.radius});
  }
  for (const std::uint32_t i : tile.halo)
    job.places.push_back({set.probes[i].position, set.probes[i].radius});
  return job;
}

/// Whether a result answers the job.
bool answers(const TransportJob& job, std::size_t light_groups, const TransportJobResult& r) {
  const std::size_t count = job.places.size();
  if (r.degree != job.degree || r.light_groups.size() != light_groups || r.edges.size() != count)
    return false;
  if (r.light.size() != (job.light_known ? 0 : count)) return false;
  for (const auto& groups : r.light)
    if (groups.size() != light_groups) return false;
  for (const auto& edges : r.edges)
    if (!edges.empty() && (!job.params.viz || static_cast<std::size_t>(edges.back().from) >= count))
      return false;
  return r.records.has_value() == (job.params.records.points > 0) &&
         (!r.records || r.records->groups.size() == light_groups);
}

/// As the tile's set would be, had it been baked here.
probes::ProbeSet set_of(probes::ProbeSet set, const TransportJob& job, TransportJobResult&& r) {
  probes::GeneratorInfo& g = set.generator;
  const bake::TransportBakeParams& p = job.params;
  g.directions = p.transport.directions;
  g.link_rays = p.transport.link_rays;
  g.surfel_size = r.surfel_size;
  if (!job.light_known) {
    g.op = p.op;
    g.gen = probes::GenMode::full;
    g.viz = probes::VizMethod::none;
    set.light_groups.clear();
    for (std::string& name : r.light_groups) set.light_groups.push_back({std::move(name), vec3(1)});
  }
  if (p.viz) {
    g.viz = probes::VizMethod::links;
    g.viz_source = p.viz_params.source;
  }
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    if (!job.light_known) set.probes[i].groups = std::move(r.light[i]);
    set.probes[i].edges = std::move(r.edges[i]);
  }
  set.surface = std::move(r.records);
  probes::merge_groups(set);
  return set;
}

}  // namespace

void FarmCrew::run_tiles(
    const probes::ProbeSet& set, std::span<const probes::Tile> tiles, std::span<const std::size_t> which,
    const bake::TiledParams& params,
    const std::function<void(std::size_t, probes::ProbeSet, bake::TransportBakeReport)>& done,
    const Control& control) {
  if (which.empty()) return;
  require(done != nullptr, "the farm's tiles", "nobody takes what is done");
  ScenePackage package = pack_scene(scene_);
  const SceneRef scene{package.id, package.manifest.size(), scene::light_hash(scene_), time_};
  const std::size_t light_groups = scene::light_groups(scene_).size();
  FarmProgress progress(control, "bake", which.size(), "tiles");
  report_.units += which.size();
  const auto job = [&](std::size_t t) { return job_of(set, tiles[t], params, scene); };
  const auto take = [&](std::size_t t, TransportJobResult&& result) {
    bake::TransportBakeReport took = std::move(result.report);
    done(t, set_of(probes::set_of_tile(set, tiles[t]), job(t), std::move(result)), std::move(took));
  };

  std::vector<std::size_t> left;
  for (const std::size_t t : which) {
    auto known = find_result(options_.results, unit_key(job(t)));
    auto* result = known ? std::get_if<TransportJobResult>(&known->data) : nullptr;
    if (result && answers(job(t), light_groups, *result)) {
      take(t, std::move(*result));
    } else {
      left.push_back(t);
    }
  }
  report_.cached += which.size() - left.size();
  progress.cached(which.size() - left.size());
  if (left.empty()) return;

  const BlobServer server(options_.broker, std::move(package));
  UnitGroup units;
  units.count = left.size();
  units.most_per_job = 1;
  units.body = [&](std::span<const std::size_t> unit) {
    return encode_job(job(left[unit.front()]), options_.content);
  };
  units.done = [&](std::span<const std::size_t> unit, JobResult result) {
    const std::size_t t = left[unit.front()];
    auto* baked = std::get_if<TransportJobResult>(&result.data);
    if (!baked || !answers(job(t), light_groups, *baked))
      throw Error("worker " + result.stats.worker, "its result does not answer the job");
    keep_result(options_.results, unit_key(job(t)), {*baked, {}});
    take(t, std::move(*baked));
  };
  dispatch(
      options_, {units}, report_,
      [&](std::size_t finished, const FarmReport& report) { progress.finished(finished, report); }, control);
}

}  // namespace ssphh::farm
