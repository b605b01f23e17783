#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/farm/farm_bake.h>
#include <ssphh/scene/query.h>

#include "farm_progress.h"
#include "result_cache.h"
#include "unit_key.h"

namespace ssphh::farm {
namespace {

using bake::BakeStage;
using bake::ProbeStage;
using bake::ProbeStageResult;

/// The probes' own places for GEN, all of them for VIZ.
ProbeJob job_of(const ProbeJob& all, std::vector<std::uint32_t> probes) {
  ProbeJob job = all;
  if (job.stage == BakeStage::gen) {
    job.places.clear();
    for (const std::uint32_t probe : probes) job.places.push_back(all.places[probe]);
  }
  job.probes = std::move(probes);
  return job;
}

/// Whether a result answers the probes that were asked for.
bool answers(const ProbeJob& all, std::span<const ProbeStage> stages, std::size_t light_groups,
             const ProbeJobResult& result) {
  if (result.stage != all.stage || result.degree != all.degree || result.probes.size() != stages.size())
    return false;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const ProbeStageResult& r = result.probes[i];
    if (r.done != stages[i]) return false;
    if (all.stage == BakeStage::gen && r.groups.size() != light_groups) return false;
    for (const probes::Edge& edge : r.edges) {
      const auto from = static_cast<std::size_t>(edge.from);
      if (from >= all.places.size() || from == r.done.probe) return false;
      if (edge.matrix.values.empty() == all.viz_params.matrix) return false;
    }
  }
  return true;
}

}  // namespace

void FarmCrew::run(const probes::ProbeSet& set, const bake::BakeParams& params,
                   std::span<const ProbeStage> stages, const std::function<void(ProbeStageResult)>& done,
                   const Control& control) {
  if (stages.empty()) return;
  require(done != nullptr, "the farm's bake", "nobody takes what is done");
  for (const ProbeStage& stage : stages) {
    if (stage.probe >= set.probes.size())
      throw Error("the farm's bake",
                  fmt::format("there is no probe {} of {}", stage.probe, set.probes.size()));
  }
  if (set.probes.size() > job_limits::places)
    throw Error("the farm", fmt::format("bakes at most {} probes", job_limits::places));
  ScenePackage package = pack_scene(scene_);
  const SceneRef scene{package.id, package.manifest.size(), scene::light_hash(scene_), time_};
  FarmProgress progress(control, "bake", stages.size(), "probe steps");
  report_.units += stages.size();

  struct Group {
    ProbeJob all;
    std::vector<ProbeStage> left;
  };
  std::vector<Group> groups;
  for (const BakeStage stage : {BakeStage::gen, BakeStage::viz})
    groups.emplace_back().all = job_of_set(set, params.viz_params, stage, scene);
  for (Group& group : groups) group.all.renderer = options_.renderer;
  // Which version of another renderer made a result is not known: none of theirs is kept.
  DiskCache* const results = options_.renderer == Renderer::path ? options_.results : nullptr;
  const std::size_t light_groups = set.light_groups.size();

  // Take what is known.
  std::size_t cached = 0;
  for (const ProbeStage& stage : stages) {
    Group& group = groups[stage.stage == BakeStage::viz];
    auto known = find_result(results, unit_key(group.all, stage.probe));
    auto* result = known ? std::get_if<ProbeJobResult>(&known->data) : nullptr;
    if (result && answers(group.all, std::span(&stage, 1), light_groups, *result)) {
      done(std::move(result->probes[0]));
      ++cached;
    } else {
      group.left.push_back(stage);
    }
  }
  report_.cached += cached;
  progress.cached(cached);
  if (cached == stages.size()) return;

  const BlobServer server(options_.broker, std::move(package));
  std::vector<UnitGroup> work;
  for (Group& group : groups) {
    UnitGroup& units = work.emplace_back();
    units.count = group.left.size();
    units.body = [this, &group](std::span<const std::size_t> which) {
      std::vector<std::uint32_t> probes;
      for (const std::size_t i : which) probes.push_back(group.left[i].probe);
      return encode_job(job_of(group.all, std::move(probes)), options_.content);
    };
    units.done = [results, &group, &done, light_groups](std::span<const std::size_t> which,
                                                        JobResult result) {
      const auto asked = std::span(group.left).subspan(which.front(), which.size());
      auto* probes = std::get_if<ProbeJobResult>(&result.data);
      if (!probes || !answers(group.all, asked, light_groups, *probes))
        throw Error("worker " + result.stats.worker, "its result does not answer the job");
      for (ProbeStageResult& probe : probes->probes) {
        keep_result(results, unit_key(group.all, probe.done.probe),
                    {ProbeJobResult{group.all.stage, group.all.degree, {probe}}, {}});
        done(std::move(probe));
      }
    };
  }
  dispatch(
      options_, work, report_,
      [&](std::size_t units, const FarmReport& report) { progress.finished(units, report); }, control);
}

}  // namespace ssphh::farm
